// Hard cases of distances that are none, of where objects are, and of what must not depend on it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "sharp.h"
#include "support/tool.h"
#include "support/vdb_files.h"

#include <limits>

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using glm::ivec3;
using volume::VolumeTest;

namespace {

const Body kBall = ballBody({16.2, 15.7, 16.1}, 11);
const dvec3 kAlong(0.3, -1, 0.2);

const std::string kRender =
    "render in.vdb -o out.exr --eye 4,4,40 --target 4,4,4 --ortho 8 --size 4x4 --background 1";

Look lookAt(const Bodies& bodies, int pixels = 12) {
    return {bodies.volume(), alongTo(kAlong, dvec3(16), 26, {pixels, pixels})};
}

/// A number from a voxel's place, in [−1, 1], that no neighbour's tells.
double noise(const dvec3& x) {
    const double s = std::sin(glm::dot(glm::floor(x), dvec3(12.9898, 78.233, 37.719))) * 43758.5453;
    return 2 * (s - std::floor(s)) - 1;
}

class HardSharpValue : public VolumeTest {
protected:
    /// An object in a file of 8³ voxels, with one voxel of its distances set otherwise.
    void spoil(const std::string& name, float value) const {
        auto distances = floats(name, -0.5f, 3);
        distances.setLevelSet();
        distances.set({1, 2, 3}, value);
        vdb("in.vdb", {floats("ior"), distances});
    }
};

} // namespace

TEST_F(HardSharpValue, ADistanceThatIsNoNumberIsRefusedByGridAndVoxel) {
    for (const char* name : {"sdf", "sdf.glass"})
        for (const float value :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            spoil(name, value);
            refused(65, {"in.vdb", std::string("'") + name + "'", "voxel (1, 2, 3)"},
                    kRender + " --boundary sharp", folder);
        }
    spoil("sdf", 1);
    const Ran ran = run(kRender + " --boundary sharp", folder);
    EXPECT_EQ(ran.status, 0) << ran.said;
}

TEST_F(HardSharpValue, DistancesOfAnotherTypeAreRefused) {
    vdb("in.vdb", {floats("ior"), vectors("sdf", {1, 1, 1})});
    refused(65, {"in.vdb", "'sdf'", "float"}, kRender, folder);
    refused(65, {"in.vdb", "'sdf'", "float"}, kRender + " --boundary sharp", folder);
}

TEST_F(HardSharpValue, SharpBoundariesWithoutObjectsAreRefused) {
    vdb("in.vdb", {floats("ior")});
    refused(65, {"in.vdb", "'sdf'"}, kRender + " --boundary sharp", folder);
}

TEST_F(HardSharpValue, SixtyFiveObjectsAreRefused) {
    for (const int count : {64, 65}) {
        std::vector<volume::VdbGrid> grids{floats("ior")};
        for (int i = 0; i < count; ++i) {
            auto distances = floats("sdf.n" + std::to_string(i), -0.5f, 3);
            distances.setLevelSet();
            grids.push_back(distances);
            grids.push_back(floats("ior.n" + std::to_string(i)));
        }
        vdb("in.vdb", grids);
        if (count == 65) {
            refused(65, {"in.vdb", "65 objects", "at most 64"}, kRender, folder);
        } else {
            const Ran ran = run(kRender, folder);
            EXPECT_EQ(ran.status, 0) << ran.said;
            std::filesystem::remove(folder / "out.exr");
        }
    }
}

TEST_F(HardSharpValue, ThreadsAndRunsDoNotChangeABit) {
    const Bodies bodies{.all = {kBall, ballBody({13, 17, 15}, 5, 1.2)}};
    write(bodies.volume(), "in.vdb");
    std::string first;
    for (const char* threads : {"1", "1", "2"}) {
        // By a file of options: the picture's history has the command line.
        putBytes("run.cfg", std::string("threads=") + threads + "\n");
        const Ran ran = run("render in.vdb -o out.exr --config run.cfg --eye 40,30,60 "
                            "--target 16,16,16 --fov 30 --size 48x32 --background 1 "
                            "--aov exit_direction,transmittance",
                            folder);
        EXPECT_EQ(ran.status, 0) << ran.said;
        const std::string bytes = bytesOf("out.exr");
        if (first.empty()) first = bytes;
        EXPECT_EQ(bytes, first) << threads << " threads";
    }
}

TEST(HardSharpDistance, NoneWithinReachIsNoObject) {
    // All outside, by whatever distance: nothing is there. All within: it fills the domain, whose
    // faces do not refract.
    for (const double distance : {1e-3, 0.5, 3.0, 1e6, -1e-3, -0.5, -3.0, -1e6}) {
        SCOPED_TRACE(distance);
        const Look look = lookAt({.all = {{[=](dvec3) { return distance; }}}});
        expectSky(look);
        EXPECT_EQ(look.counter("boundaries_met"), 0);
        for (int i = 0; i < 12; ++i)
            EXPECT_LT(radiansBetween(look.direction(i, i), kAlong), 3e-7); // floats
    }
}

TEST(HardSharpDistance, HostileOnesMakeNoLightAndNoEndlessRay) {
    // Those that contradict themselves are refused.
    int refused = 0;
    const std::pair<const char*, std::function<double(dvec3)>> cases[] = {
        {"nothing", [](dvec3) { return 0.0; }},
        {"noise", [](dvec3 x) { return noise(x); }},
        {"noise of a thousandth", [](dvec3 x) { return 1e-3 * noise(x); }},
        {"noise of a million", [](dvec3 x) { return 1e6 * noise(x); }},
        {"a chessboard",
         [](dvec3 x) {
             const ivec3 p(x);
             return (p.x + p.y + p.z) % 2 == 0 ? 1.0 : -1.0;
         }},
        {"a sign alone", [](dvec3 x) { return kBall.distance(x) < 0 ? -1.0 : 1.0; }},
        {"a sign alone, tiny", [](dvec3 x) { return kBall.distance(x) < 0 ? -1e-6 : 1e-6; }},
        {"a square",
         [](dvec3 x) {
             const double d = kBall.distance(x);
             return d * std::abs(d);
         }},
        {"a distance without sign", [](dvec3 x) { return std::abs(kBall.distance(x)); }},
        {"a jump", [](dvec3 x) { return kBall.distance(x) + (x.x > 16 ? 3 : 0); }},
    };
    for (const auto& [name, distance] : cases)
        for (const bool two : {false, true}) {
            SCOPED_TRACE(std::string(name) + (two ? ", beside another" : ""));
            Bodies bodies{.all = {{distance}}};
            if (two) bodies.all.push_back(ballBody({10, 20, 12}, 6, 1.3));
            // Where zeros are everywhere a ray may use up its steps, which is told.
            try {
                expectSky(lookAt(bodies), 1, true);
            } catch (const DataError&) {
                ++refused;
            }
        }
    EXPECT_LT(refused, 12); // of 20
}

TEST(HardSharpDistance, TheWrongWayRoundABallIsAHoleInGlass) {
    // Which is what it is: a bubble, in glass that fills the domain.
    const Body hole{[](dvec3 x) { return -kBall.distance(x); }};
    const Look found = lookAt({.all = {hole}});
    expectSky(found);
    Body bubble = kBall;
    bubble.index = 1;
    const Look wanted = lookAt({.all = {bubble}, .around = 1.5});
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x)
            EXPECT_NEAR(found.at("transmittance.R", x, y), wanted.at("transmittance.R", x, y),
                        1e-4); // the same zeros, by coefficients of the other sign
}

TEST(HardSharpDistance, AMultipleOfADistanceHasTheSameZeros) {
    // Files of other programs have voxels, or half a unit, in place of units. How far a leap may go
    // is told wrongly; where the boundary is, and which way it faces, is not. Among several objects
    // a leap twice too long may end well behind a boundary, and miss it: no light is made of that.
    const Look wanted = lookAt({.all = {kBall}});
    for (const double scale : {0.5, 0.8, 1.25, 2.0})
        for (const bool two : {false, true}) {
            SCOPED_TRACE(testing::Message() << scale << (two ? ", beside another" : ""));
            Bodies bodies{.all = {kBall}, .halfWidth = 4 * std::max(scale, 1.0), .scale = scale};
            if (two) bodies.all.push_back(ballBody({1, 31, 1}, 2, 1)); // out of every ray's way
            const Look found = lookAt(bodies);
            expectSky(found);
            for (int y = 0; y < 12 && !(two && scale > 1.5); ++y)
                for (int x = 0; x < 12; ++x)
                    EXPECT_LT(radiansBetween(found.direction(x, y), wanted.direction(x, y)),
                              0.01 * kPi / 180) // the bar of the requirements
                        << x << " " << y;
        }
}

TEST(HardSharpDistance, ANarrowBandIsEnough) {
    // Splines reach two voxels to either side: from a band of three on the zero is not felt by the
    // band's end. With less the boundary is rougher; no light is made.
    const Look wanted = lookAt({.all = {kBall}});
    for (const double band : {1.0, 1.5, 2.0, 3.0, 4.0}) {
        SCOPED_TRACE(band);
        const Look found = lookAt({.all = {kBall}, .halfWidth = band});
        expectSky(found);
        for (int y = 0; y < 12 && band >= 3; ++y)
            for (int x = 0; x < 12; ++x)
                EXPECT_LT(radiansBetween(found.direction(x, y), wanted.direction(x, y)),
                          0.01 * kPi / 180); // the bar of the requirements
    }
}

TEST(HardSharpPlace, NeitherUnitNorPlaceChangesThePicture) {
    const auto look = [](double h, const dmat4& placed) {
        const auto at = [&](const dvec3& p) { return dvec3(placed * glm::dvec4(h * p, 1)); };
        const Params params = sharply(perspective(at({50, 24, 45}), at(dvec3(16)), 30, {12, 12},
                                                  dmat3(placed) * dvec3(0, 1, 0)));
        Look made(Bodies{.all = {kBall}, .voxelSize = h, .placed = placed}.volume(), params);
        expectSky(made);
        return made;
    };
    const Look wanted = look(1, dmat4(1));
    const auto same = [&](const Look& found, const dmat3& turned, double tolerance) {
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) {
                EXPECT_NEAR(found.at("R", x, y), wanted.at("R", x, y), 2e-3); // a dim branch
                // At the rim a ray is turned by more than it is off.
                if (wanted.at("transmittance.R", x, y) < 0.8) continue;
                EXPECT_LT(radiansBetween(found.direction(x, y), turned * wanted.direction(x, y)),
                          tolerance)
                    << x << " " << y;
            }
    };
    // Distances in other units round otherwise: 1e-7 of a few voxels.
    for (const double h : {2e-5, 1e-3, 1e6}) same(look(h, dmat4(1)), dmat3(1), 1e-5);
    // Ten thousand voxels off the origin, turned: cameras and places are doubles until they are
    // voxels.
    const dmat4 far = glm::rotate(glm::translate(dmat4(1), dvec3(1e4, -2e4, 1.5e4)), 1.1,
                                  glm::normalize(dvec3(1, 2, -1)));
    same(look(1, far), dmat3(far), 1e-5);
    same(look(1e-3, glm::translate(dmat4(1), dvec3(1e3))), dmat3(1), 1e-5);
}

TEST(HardSharpBooks, TwoRunsAreTheSameBytes) {
    const Bodies bodies{.all = {kBall, ballBody({13, 17, 15}, 5, 1.2)}};
    const Look a = lookAt(bodies, 40), b = lookAt(bodies, 40);
    EXPECT_EQ(a.picture.pixels, b.picture.pixels);
    EXPECT_EQ(a.stats.counters, b.stats.counters);
}

TEST(HardSharpBooks, DeeperIsNeverDarker) {
    // Every boundary more that a ray may meet adds light, and none is made.
    double before = 0;
    for (const int depth : {1, 2, 3, 4, 8, 16, 64}) {
        Params params = alongTo(kAlong, dvec3(16), 20, {12, 12});
        params.maxDepth = depth;
        const Look look(Bodies{.all = {kBall}}.volume(), params);
        expectSky(look);
        double sum = 0;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) sum += look.at("R", x, y);
        EXPECT_GE(sum, before * (1 - 1e-6)) << depth; // floats
        before = sum;
    }
}

RC_GTEST_PROP(HardSharpBooks, AnyObjectsShowASkyButForWhatIsDropped, ()) {
    Bodies bodies{.all = {}, .around = drawn(0.8, 2)};
    const int count = *rc::gen::inRange(1, 7);
    for (int i = 0; i < count; ++i) {
        const dvec3 centre(drawn(4, 28), drawn(4, 28), drawn(4, 28));
        const int priority = *rc::gen::inRange(-1, 2);
        const double n = drawn(0.5, 3), radius = drawn(3, 12);
        if (*rc::gen::inRange(0, 2) == 0)
            bodies.all.push_back(ballBody(centre, radius, n, priority));
        else
            bodies.all.push_back(boxBody(centre - radius * dvec3(0.5, 0.7, 0.4),
                                         centre + radius * dvec3(0.6, 0.4, 0.7), n, priority));
    }
    const Look look(bodies.volume(), alongTo(drawnDirection(), dvec3(16), 34, {12, 12}));
    expectSky(look);
}

RC_GTEST_PROP(HardSharpBooks, AHotGlassAsHotAsItsSkyIsNotSeen, ()) {
    // Several objects, each of its own index and depth: what absorbs, shines.
    Bodies bodies{.all = {}};
    const int count = *rc::gen::inRange(2, 6);
    std::vector<double> sigmas;
    for (int i = 0; i < count; ++i) {
        bodies.all.push_back(ballBody({drawn(6, 26), drawn(6, 26), drawn(6, 26)}, drawn(4, 12),
                                      drawn(0.7, 2.5), *rc::gen::inRange(-1, 2)));
        sigmas.push_back(drawnByMagnitude(1e-5, 10));
    }
    volume::Volume volume = bodies.volume();
    for (int i = 0; i < count; ++i) {
        const std::string name = "B" + std::to_string(i);
        const double n = bodies.all[static_cast<size_t>(i)].index;
        const double sigma = sigmas[static_cast<size_t>(i)];
        volume.putConstant("absorption." + name, glm::vec3(static_cast<float>(sigma)));
        volume.putConstant("emission." + name, glm::vec3(static_cast<float>(sigma * n * n)));
    }
    const Look look(std::move(volume), alongTo(drawnDirection(), dvec3(16), 34, {12, 12}));
    expectSky(look);
}
