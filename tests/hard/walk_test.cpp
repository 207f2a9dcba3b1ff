// Hard cases of a walk's geometry: along axes, faces, edges, corners; from anywhere to anywhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr int kSize = 8;

volume::Volume glow() {
    TestVolume scene{ivec3(kSize)};
    scene.constantVector("emission", dvec3(0.25));
    return scene.take();
}

/// How much of the line from `eye` on lies in the box.
double chord(const dvec3& eye, const dvec3& d) {
    double enter = 0, leave = 1e9;
    for (int c = 0; c < 3; ++c) {
        if (d[c] == 0) {
            if (eye[c] < 0 || eye[c] > kSize) return 0;
            continue;
        }
        const double a = -eye[c] / d[c], b = (kSize - eye[c]) / d[c];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return std::max(leave - enter, 0.0);
}

/// One ray; its length and what it gathers along it are those of the chord.
void expectChord(const dvec3& eye, const dvec3& d) {
    SCOPED_TRACE(testing::Message() << "from " << eye.x << " " << eye.y << " " << eye.z << " along "
                                    << d.x << " " << d.y << " " << d.z);
    const Look look(glow(), parallel(eye, eye + d, 1e-3, {1, 1}, across(d)));
    const double length = chord(eye, d);
    // Floats of 8 voxels over a dozen steps; a ray is thought to have left 1e-3 of a step early.
    EXPECT_NEAR(look.at("path_length.V"), length, 1e-5 * kSize + 1e-3);
    EXPECT_NEAR(look.at("R"), 0.25 * look.at("path_length.V"), 1e-5);
    EXPECT_EQ(look.counter("trapped"), 0);
}

/// A box in which nothing happens.
TestVolume emptiness(ivec3 size = ivec3(kSize)) {
    return std::move(TestVolume(size).constant("ior", 1));
}

} // namespace

TEST(HardWalk, RaysAlongAxesFacesEdgesAndCornersHaveTheirExactLength) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            dvec3 d(0);
            d[axis] = side;
            // In a voxel's middle, on its face, on its edge; on the domain's face and edge.
            for (const double u : {3.5, 3.0, 0.0, 8.0})
                for (const double v : {4.5, 4.0, 0.0, 8.0}) {
                    dvec3 eye(0);
                    eye[(axis + 1) % 3] = u;
                    eye[(axis + 2) % 3] = v;
                    eye[axis] = side > 0 ? -5 : 13;
                    expectChord(eye, d);
                }
        }
    // Through corners of voxels, along diagonals of faces and of the domain.
    for (const dvec3& d : {dvec3(1, 1, 1), dvec3(-1, 1, 1), dvec3(1, 1, 0), dvec3(0, -1, 1)})
        for (const dvec3& through : {dvec3(4), dvec3(3, 4, 4), dvec3(4, 4, 3.5)}) {
            const dvec3 unit = glm::normalize(d);
            expectChord(through - 20.0 * unit, unit);
        }
}

TEST(HardWalk, TheEyeMayBeInTheVolumeOnAFaceOrInACorner) {
    for (const dvec3& eye : {dvec3(4.2, 3.1, 5.7), dvec3(4, 4, 4), dvec3(0, 4, 4), dvec3(8, 3, 2),
                             dvec3(0, 0, 0), dvec3(8, 8, 8), dvec3(0, 8, 4)})
        for (const dvec3& towards : {dvec3(4, 4, 4.5), dvec3(7, 1, 2), dvec3(-3, 4, 4), dvec3(9)})
            expectChord(eye, glm::normalize(towards - eye));
}

RC_GTEST_PROP(HardWalk, AnyRayHasTheLengthOfItsChord, ()) {
    const dvec3 eye = 4.0 + drawnByMagnitude(0.1, 1e5) * drawnDirection();
    const dvec3 target(drawn(0, 8), drawn(0, 8), drawn(0, 8));
    RC_PRE(glm::length(target - eye) > 1e-3);
    const double fov = 2 * std::atan(5 / std::max(glm::length(target - eye), 5.0)) * 180 / kPi;
    const Params params = perspective(eye, target, fov, {16, 16}, across(target - eye));
    const Look look(glow(), params);
    int met = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            // The direction as written: of 2e-7 off at 1e5 voxels, 0.02 voxels at the box.
            const dvec3 d = look.direction(x, y), place = look.place(x, y);
            if (look.at("path_length.V", x, y) == 0) continue;
            ++met;
            const bool inside =
                chord(eye, d) > 0 && glm::all(glm::lessThan(glm::abs(eye - 4.0), dvec3(4)));
            // Back from where it left, whose floats are of the box, to the eye or the box's face.
            const double back = chord(place, -d);
            const double length = inside ? std::min(back, glm::length(place - eye)) : back;
            RC_ASSERT(std::abs(look.at("path_length.V", x, y) - length) < 2e-3);
            RC_ASSERT(std::abs(look.at("R", x, y) - 0.25 * look.at("path_length.V", x, y)) < 2e-5);
        }
    RC_ASSERT(met > 0);
}

TEST(HardWalk, ABeamAlongDiagonalsFillsEveryVoxelAlike) {
    // Through edges and corners of voxels, where two and three faces are met at once.
    for (const dvec3& way : {dvec3(1, 1, 0), dvec3(-1, 0, 1), dvec3(1, 1, 1), dvec3(1, -1, -1),
                             dvec3(2, 1, 0), dvec3(1, 1e-7, 0), dvec3(1, -1e-4, 1e-4)}) {
        SCOPED_TRACE(testing::Message() << way.x << " " << way.y << " " << way.z);
        const lightsim::Lit lit(emptiness().volume(),
                                lightsim::paramsOf({lightsim::beam(way)}, 1 << 16));
        double worst = 0;
        forEachVoxel(ivec3(kSize),
                     [&](ivec3 p) { worst = std::max(worst, std::abs(lit.fluence(p) - 1)); });
        // A thousand pixels a voxel, less those its outline cuts, 130 in rows that all lie in or
        // out together when the way is an even one.
        EXPECT_LT(worst, 0.07);
        EXPECT_NEAR(lit.total(), kSize * kSize * kSize, 5e-3 * kSize * kSize * kSize); // outline
        const double shadow = kSize * kSize *
                              (std::abs(way.x) + std::abs(way.y) + std::abs(way.z)) /
                              glm::length(way);
        EXPECT_NEAR(lit.stats.energy.entered[0], shadow, 0.01 * shadow); // as above
    }
}

TEST(HardWalk, SixPhotonsFromTheMiddleRunStraightAlongTheGrid) {
    // One each way, each of a sixth of the power, from a voxel's corner, the middle of its edge, of
    // its face, and its centre: through edges, faces and middles of voxels.
    for (const ivec3& size : {ivec3(8), ivec3(8, 8, 9), ivec3(8, 9, 9), ivec3(9)}) {
        SCOPED_TRACE(testing::Message() << size.x << " " << size.y << " " << size.z);
        const dvec3 place = 0.5 * dvec3(size);
        const lightsim::Lit lit(emptiness(size).volume(),
                                lightsim::paramsOf({lightsim::lamp(place)}, 6));
        EXPECT_EQ(lit.counter("photons"), 6);
        // To both faces along each of the axes: the sum of the box's edges.
        const double wanted = 4 * kPi / 6 * (size.x + size.y + size.z);
        EXPECT_NEAR(lit.total(), wanted, 1e-4 * wanted); // floats, fixed point
        EXPECT_NEAR(lit.stats.energy.escaped[0], 4 * kPi, 1e-5 * 4 * kPi);
    }
}

TEST(HardWalk, ALampOnAFaceEdgeOrCornerLightsItsShareOfTheSphere) {
    struct Case {
        dvec3 place;
        double share;
    };
    // On it, and by as little off it as a file's decimals or a light rig's floats leave.
    for (const Case& c : {Case{{4, 4, 0}, 0.5}, Case{{8, 4.3, 2.2}, 0.5}, Case{{4, 0, 8}, 0.25},
                          Case{{0, 0, 0}, 0.125}, Case{{8, 0, 8}, 0.125}, Case{{4, 4, -1e-6}, 0.5},
                          Case{{8.00001, 4.3, 2.2}, 0.5}}) {
        SCOPED_TRACE(testing::Message() << c.place.x << " " << c.place.y << " " << c.place.z);
        const lightsim::Lit lit(emptiness().volume(),
                                lightsim::paramsOf({lightsim::lamp(c.place)}, 1 << 16));
        const double wanted = 4 * kPi * c.share;
        // Of some hundred pixels an edge of its view one row may be in or out, on each of four
        // sides.
        EXPECT_NEAR(lit.stats.energy.entered[0], wanted, 0.04 * wanted);
        EXPECT_NEAR(lit.stats.energy.escaped[0], lit.stats.energy.entered[0], 1e-4 * wanted);
    }
}

RC_GTEST_PROP(HardWalk, ALampAnywhereInsideSendsItsPowerToTheFaces, ()) {
    const auto coordinate = [] { return *rc::gen::inRange(1, 16) * 0.5; }; // on faces and centres
    const dvec3 place(coordinate(), coordinate(), coordinate());
    const lightsim::Lit lit(emptiness().volume(),
                            lightsim::paramsOf({lightsim::lamp(place)}, 1 << 13));
    const double power = 4 * kPi;
    RC_ASSERT(std::abs(lit.stats.energy.entered[0] - power) < 1e-5 * power); // floats
    RC_ASSERT(std::abs(lit.stats.energy.escaped[0] - power) < 1e-4 * power);
    // ∫ r(ω) dω over the box by midpoints of its own: the same rays' lengths.
    double wanted = 0;
    const int kRows = 200;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < 2 * kRows; ++j) {
            const double z = -1 + 2 * (i + 0.5) / kRows, a = kPi * (j + 0.5) / kRows;
            const double r = std::sqrt(1 - z * z);
            wanted +=
                chord(place, {r * std::cos(a), r * std::sin(a), z}) * power / (2.0 * kRows * kRows);
        }
    RC_ASSERT(std::abs(lit.total() - wanted) < 5e-3 * wanted); // 8192 rays and kinks at the edges
}
