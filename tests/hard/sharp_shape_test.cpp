// Hard cases of what sharp boundaries bound: thin walls, edges, objects that touch, eyes in them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sharp.h"
#include "support/scratch.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

/// What lies within `thickness` voxels of a plane.
Body wall(const dvec3& point, const dvec3& normal, double thickness, double index = 1.5) {
    const dvec3 n = glm::normalize(normal);
    return {[=](dvec3 x) { return std::abs(glm::dot(x - point, n)) - 0.5 * thickness; }, index};
}

/// What two half-spaces have in common, with an edge of that angle through `point` along z. Beyond
/// the edge this is less than the distance, as files made by a plain maximum have it.
Body wedge(const dvec3& point, double angle) {
    const dvec3 a(std::sin(0.5 * angle), std::cos(0.5 * angle), 0);
    const dvec3 b(a.x, -a.y, 0);
    return {[=](dvec3 x) { return std::max(glm::dot(x - point, a), glm::dot(x - point, b)); }};
}

const Body kBox = boxBody({9, 9, 9}, {23, 23, 23});

} // namespace

TEST(HardSharpShape, WallsOfTwoVoxelsAndMoreArePlates) {
    // The bar of the requirements from seven voxels on. A spline of the distance is felt three
    // voxels off and more: in a thinner wall the crease in its middle turns its faces, each
    // otherwise. What was found, by half as much again: a fiftieth of a degree for five, half of
    // one to a whole for three, two to five at the least that a distance can tell.
    for (const auto& [thickness, degrees] :
         {std::pair(9.0, 0.01), {7.0, 0.01}, {5.0, 0.03}, {3.0, 1.4}, {2.0, 8.0}})
        for (const dvec3& normal : {dvec3(0, 1, 0), dvec3(0.3, 1, 0.2), dvec3(1, 1, 1)})
            for (const double n : {1.5, 2.42}) {
                SCOPED_TRACE(testing::Message() << thickness << " voxels of " << n);
                const dvec3 u = glm::normalize(normal);
                const dvec3 d = glm::normalize(across(u) - 1.2 * u);
                const Look look(
                    Bodies{.all = {wall({24.2, 23.9, 24.1}, u, thickness, n)}, .size = ivec3(48)}
                        .volume(),
                    alongTo(d, dvec3(24), 8, {5, 5}));
                expectSky(look);
                for (int y = 0; y < 5; ++y)
                    for (int x = 0; x < 5; ++x) {
                        EXPECT_LT(radiansBetween(look.direction(x, y), d), degrees * kPi / 180);
                        // Fresnel's shares hardly change with the angle there.
                        EXPECT_NEAR(look.at("transmittance.R", x, y),
                                    std::pow(fresnelThrough(1, n, -glm::dot(d, u)), 2),
                                    1e-3 * std::max(degrees, 0.1));
                    }
            }
}

TEST(HardSharpShape, ThinnerWallsMakeNoLight) {
    // A distance has no two boundaries within two voxels: what such a wall looks like is open, but
    // not that light is neither made nor lost.
    for (const double thickness : {1.5, 1.0, 0.5, 0.1, 0.0, -0.5})
        for (const dvec3& normal : {dvec3(0, 1, 0), dvec3(0.3, 1, 0.2), dvec3(1, 1, 1)}) {
            SCOPED_TRACE(thickness);
            const Look look(Bodies{.all = {wall({16.2, 15.9, 16.1}, normal, thickness)}}.volume(),
                            alongTo({0.4, -1, 0.3}, dvec3(16), 24, {16, 16}));
            expectSky(look);
        }
}

TEST(HardSharpShape, EdgesAndCornersTakeAnyRay) {
    // Through the middle of edges and corners, and a hair off them.
    const dvec3 corner(23), edge(23, 23, 16);
    for (const dvec3& target : {corner, edge, dvec3(9), dvec3(23, 16, 9)})
        for (const dvec3& d : {dvec3(-1), dvec3(-1, -1, 0), dvec3(0, 0, -1), dvec3(-1, 1, 0),
                               dvec3(-0.3, -1, 0.2), dvec3(1, -1, 1e-3)})
            for (const double height : {1e-3, 0.1, 6.0}) {
                SCOPED_TRACE(testing::Message() << height << " along " << d.x << " " << d.y << " "
                                                << d.z << " to " << target.x);
                const Look look(Bodies{.all = {kBox}}.volume(), alongTo(d, target, height, {7, 7}));
                expectSky(look);
            }
    for (const double angle : {10.0, 45.0, 90.0}) {
        const Look look(Bodies{.all = {wedge({20, 16, 16}, angle * kPi / 180)}}.volume(),
                        alongTo({-0.2, -1, 0.1}, {16, 16, 16}, 20, {24, 24}));
        expectSky(look);
    }
    // A crease that points inwards: two boxes as one object.
    const Body other = boxBody({15, 4, 13}, {29, 18, 27});
    const Body both{[=](dvec3 x) { return std::min(kBox.distance(x), other.distance(x)); }};
    for (const dvec3& d : {dvec3(-1), dvec3(0.2, 1, -0.3)}) {
        const Look look(Bodies{.all = {both}}.volume(), alongTo(d, dvec3(18), 20, {24, 24}));
        expectSky(look);
    }
}

TEST(HardSharpShape, RaysAlongFacesAndEdges) {
    // In the plane of a face, along an edge, and as little beside them as a camera's floats are.
    for (const double off : {0.0, 1e-6, -1e-6, 1e-4, -1e-4, 1e-2, -1e-2})
        for (const dvec3& eye : {dvec3(-5, 23 + off, 16.3), dvec3(-5, 23 + off, 23 + off),
                                 dvec3(-5, 9 - off, 9), dvec3(-5, 16, 23 + off)}) {
            SCOPED_TRACE(testing::Message() << off << " beside " << eye.y << " " << eye.z);
            const Look look(Bodies{.all = {kBox}}.volume(), rayFrom(eye, {1, 0, 0}));
            expectSky(look);
            EXPECT_NEAR(look.at("R"), 1, 5e-3); // mirrored or passed: a few dim branches are not
        }
}

TEST(HardSharpShape, EyesInObjectsAndOnTheirBoundaries) {
    const Bodies bodies{.all = {kBox}};
    struct Place {
        dvec3 eye;
        bool within;
    };
    for (const Place& place : {Place{{16, 16, 16}, true},
                               {{22.9, 16, 16}, true},
                               {{9.01, 16, 17}, true},
                               {{23.01, 16, 16}, false},
                               {{8.9, 8.9, 8.9}, false},
                               {{0, 0, 0}, false},
                               {{32, 5, 7}, false}})
        for (const dvec3& towards : {dvec3(16.2, 16.1, 40), dvec3(-3, 2, 5)}) {
            SCOPED_TRACE(testing::Message() << place.eye.x << " " << place.eye.y);
            const Look look(bodies.volume(), sharply(perspective(place.eye, towards, 70, {9, 9})));
            expectSky(look, place.within ? 1.5 : 1);
        }
    // Exactly on a face: every ray is on the side that it heads into.
    for (const dvec3& eye : {dvec3(23, 16, 16), dvec3(16, 9, 16)})
        for (const dvec3& towards : {dvec3(40, 17, 18), dvec3(3, 15, 14)}) {
            const Look look(bodies.volume(), sharply(perspective(eye, towards, 50, {5, 5}), 32));
            const dvec3 outward = eye.x == 23 ? dvec3(1, 0, 0) : dvec3(0, -1, 0);
            const dvec3 ahead = glm::normalize(towards - eye);
            if (glm::dot(ahead, outward) > std::sin(0.7)) // all of them, corners included
                expectSky(look, 1);
            else if (glm::dot(ahead, outward) < -std::sin(0.7))
                expectSky(look, 1.5);
            for (int i = 0; i < 25; ++i) EXPECT_LT(look.at("R", i % 5, i / 5), 2.25 * (1 + 1e-5));
        }
}

TEST(HardSharpShape, TheDomainsFaceCutsAnObjectOpen) {
    // A ray that starts on that face within the object has not been refracted there: it goes on as
    // it came, with L/n², to the boundary within.
    const Bodies bodies{.all = {ballBody({0, 16, 16}, 12.3)}};
    const Look look(bodies.volume(), alongTo({1, 0, 0}, {0, 16, 16}, 22, {12, 12}));
    expectSky(look);
    int within = 0;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
            const double off = 22.0 / 12 * std::hypot(x - 5.5, y - 5.5) / 12.3;
            if (off > 0.6) continue; // total reflection begins at 1/1.5
            ++within;
            const double c = std::sqrt(1 - off * off);
            EXPECT_NEAR(look.at("transmittance.R", x, y), fresnelThrough(1.5, 1, c), 1e-4);
            EXPECT_NEAR(radiansBetween(look.direction(x, y), {1, 0, 0}),
                        std::asin(1.5 * off) - std::asin(off), 0.01 * kPi / 180); // the bar
        }
    EXPECT_GT(within, 20);
    // An eye beyond that face, and one on it.
    for (const double back : {0.0, 3.0})
        expectSky(Look(bodies.volume(), rayFrom({-back, 18, 15}, {1, 0.1, 0.2})),
                  back > 0 ? 1 : 1.5);
}

TEST(HardSharpShape, ObjectsThatTouchOverlapOrCoincide) {
    const dvec3 d = glm::normalize(dvec3(0.3, -1, 0.2));
    const auto look = [&](const std::vector<Body>& bodies) {
        Look made(Bodies{.all = bodies}.volume(), alongTo(d, dvec3(16), 22, {16, 16}));
        expectSky(made);
        return made;
    };
    const auto same = [](const Look& a, const Look& b) {
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                // At the rim a ray is turned by more than it is off.
                if (a.at("transmittance.R", x, y) < 0.8) continue;
                EXPECT_NEAR(a.at("transmittance.R", x, y), b.at("transmittance.R", x, y), 1e-4);
                EXPECT_LT(radiansBetween(a.direction(x, y), b.direction(x, y)),
                          0.01 * kPi / 180) // the bar of the requirements
                    << x << " " << y;
                EXPECT_NEAR(a.at("R", x, y), b.at("R", x, y), 2e-3); // one dim branch of each kind
            }
    };
    // An object twice over is that object; of two that coincide the one that wins is seen alone.
    const Body ball = ballBody({16.2, 15.7, 16.1}, 11);
    const Look once = look({ball});
    same(once, look({ball, ball}));
    same(once, look({ballBody({16.2, 15.7, 16.1}, 11, 2.4, -1), ball}));
    same(once, look({ball, ballBody({16.2, 15.7, 16.1}, 11, 2.4, -1)}));
    // Under another that rules all of it, and within another of its index, an object is none.
    same(once, look({ballBody({15, 16, 17}, 6, 2.4, -1), ball}));
    // Touching in a point, in a face, overlapping, one beyond the other by a hair.
    look({ballBody({16, 9, 16}, 7), ballBody({16, 23, 16}, 7, 1.3)});
    for (const double gap : {0.0, 1e-6, 1e-4, -1e-4, 1e-2, -1e-2, 0.3, -0.3, 1.0, -1.0})
        look({boxBody({6, 4, 6}, {26, 15.5, 26}), boxBody({6, 15.5 + gap, 6}, {26, 27, 26}, 1.34)});
    // Three round one edge, four round a point.
    look({boxBody({4, 4, 4}, {16, 16, 28}), boxBody({16, 4, 4}, {28, 16, 28}, 1.7),
          boxBody({4, 16, 4}, {28, 28, 28}, 1.3)});
}

TEST(HardSharpShape, BoundariesThatCrossTrapNoRay) {
    // Two balls that cross, and two under an object that rules them both: near the circle where
    // their boundaries meet, what is close to a ray is not beyond what it meets.
    const Body box = boxBody({2, 2, 2}, {30, 30, 30}, 1.8, 1);
    for (const Bodies& bodies :
         {Bodies{.all = {ballBody({12, 16, 16}, 9, 2.4), ballBody({20, 16, 16}, 8, 1.2)}},
          Bodies{.all = {ballBody({16, 16, 16}, 10), ballBody({20, 16, 16}, 8, 1.2)}},
          Bodies{.all = {ballBody({16, 16, 16}, 10), ballBody({20, 16, 16}, 8, 1.2), box}}}) {
        const Look look(bodies.volume(), alongTo({0.3, -1, 0.2}, dvec3(16), 30, {100, 100}));
        expectSky(look);
    }
}

TEST(HardSharpShape, ATreeOfManyBranchesIsNotTrapped) {
    // Every one of a hundred branches is short; only all of them together take many steps.
    const Bodies bodies{.all = {ballBody({16, 16, 16}, 14, 2.4), ballBody({14, 16, 16}, 8, 1.1),
                                ballBody({13, 16, 17}, 5, 2)}};
    Params params = alongTo({0.3, -1, 0.2}, dvec3(16), 26, {24, 24});
    params.maxDepth = 32;
    expectSky(Look(bodies.volume(), params));
}

TEST(HardSharpShape, SixtyFourLayersAndNoSixtyFifth) {
    // Half-spaces nested in each other, each as high as its number says and winning over those
    // before: layers of 2.5 voxels on a ground, as many boundaries as layers.
    const auto layers = [](int count) {
        std::vector<Body> all;
        for (int i = 0; i < count; ++i)
            all.push_back(halfSpace({0, 166.1 - 2.5 * i, 0}, {0, 1, 0},
                                    i % 2 == 0 ? 1.5 : 1.4 + 0.002 * i, i));
        return Bodies{.all = all, .size = {100, 170, 24}};
    };
    const dvec3 d = glm::normalize(dvec3(0.5, -1, 0.1));
    const Bodies most = layers(64);
    Params params = alongTo(d, {14, 166, 5}, 1e-3);
    params.maxDepth = 64;
    const Look look(most.volume(), params);
    expectSky(look);
    const double n = most.all.back().index, along = std::hypot(d.x, d.z);
    double before = 1, through = 1;
    for (const Body& layer : most.all) {
        through *=
            fresnelThrough(before, layer.index, std::sqrt(1 - along * along / (before * before)));
        before = layer.index;
    }
    EXPECT_NEAR(look.at("transmittance.R"), through, 1e-4);
    const dvec3 wanted(d.x / n, -std::sqrt(1 - along * along / (n * n)), d.z / n);
    EXPECT_LT(radiansBetween(look.direction(), wanted), 0.01 * kPi / 180); // the bar
    expectError(ExitStatus::data, {"65 objects", "at most 64"},
                [&] { Look(layers(65).volume(), params); });
}

TEST(HardSharpShape, LongAndThinDomains) {
    // A wall across, and one all along.
    for (const ivec3& size : {ivec3(1000, 3, 3), ivec3(3, 3, 1000), ivec3(7, 300, 5)})
        for (int axis = 0; axis < 3; ++axis) {
            SCOPED_TRACE(testing::Message()
                         << size.x << " x " << size.y << " x " << size.z << " along " << axis);
            dvec3 d(0.01, 0.013, -0.007);
            d[axis] = 1;
            dvec3 normal(0);
            normal[size.x > 7 ? 0 : size.y > 7 ? 1 : 2] = 1;
            const dvec3 middle = 0.5 * dvec3(size);
            const Look look(Bodies{.all = {wall(middle, normal, 60)}, .size = size}.volume(),
                            alongTo(d, middle, 0.1, {3, 3}));
            expectSky(look);
            EXPECT_LT(look.at("path_length.V", 1, 1), 1.02 * glm::length(dvec3(size)));
        }
}

TEST(HardSharpShape, RaysSentBackArriveWhereTheyCameFrom) {
    // The transmitted path is the same from either end.
    struct Scene {
        const char* name;
        Bodies bodies;
    };
    Bodies graded{.all = {ballBody({16.2, 15.7, 16.1}, 12)}};
    graded.graded = [](dvec3 p) { return 1.6 + 0.01 * (p.x - 16) + 0.1 * std::sin(0.3 * p.y); };
    for (const Scene& scene :
         {Scene{"ball", {.all = {ballBody({16.2, 15.7, 16.1}, 12)}}},
          {"nested", {.all = {ballBody({16.2, 15.7, 16.1}, 13), ballBody({15, 16, 17}, 6, 1.2)}}},
          {"box", {.all = {kBox}}},
          {"graded", graded}})
        for (const dvec3& d : {dvec3(0.2, -1, 0.3), dvec3(1, 0.1, 0)})
            for (const double off : {1.0, 4.0}) {
                SCOPED_TRACE(testing::Message() << scene.name << " " << d.x << " " << off);
                const dvec3 in = glm::normalize(d);
                const dvec3 start = dvec3(16) + off * across(in) - 40.0 * in;
                Params params = rayFrom(start, in);
                params.integrator = Integrator::sharma; // exact enough to be turned round
                const Look there(scene.bodies.volume(), params);
                const dvec3 out = there.direction();
                Params reversed = rayFrom(there.place() + 2.0 * out, -out);
                reversed.integrator = params.integrator;
                const Look back(scene.bodies.volume(), reversed);
                // Floats of a place are 2e-6 voxels, turned by a few tenths of a radian a voxel.
                EXPECT_LT(radiansBetween(back.direction(), -in), 2e-5);
                EXPECT_LT(glm::length(glm::cross(back.place() - start, in)), 1e-3);
                EXPECT_NEAR(back.at("optical_path_length.V"), there.at("optical_path_length.V"),
                            1e-2);
                EXPECT_NEAR(back.at("transmittance.R"), there.at("transmittance.R"), 1e-4);
            }
}
