// Bodies bounded by functions, against what they enclose and how many holes they have.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshgen/sound.h"
#include "shapes/implicit.h"
#include "support/scratch.h"

#include <numbers>

namespace eikonal {

using namespace shapes;
using std::numbers::pi;

mesh::TriangleMesh body(const std::string& name, std::map<std::string, double> set = {},
                        int resolution = 48, std::uint32_t seed = 0) {
    ImplicitParams params{name, resolution, seed, std::move(set)};
    params.check();
    return makeImplicit(params);
}

TEST(Implicit, ATorusWithItsPointsOnIt) {
    for (const double r : {0.1, 0.3}) {
        const auto torus = body("torus", {{"tube", r}}, 64);
        EXPECT_EQ(eulerCharacteristic(torus), 0);
        for (const glm::dvec3& p : torus.points)
            EXPECT_NEAR(std::hypot(std::hypot(p.x, p.z) - (1 - r), p.y), r, 1e-9);
        // Chords of a cell h over a circle of radius r: an area less by h² / (6 r²).
        const double whole = 2 * pi * pi * (1 - r) * r * r, h = 2.0 / 64;
        const double volume = sound(torus).volume;
        EXPECT_LT(volume, whole);
        EXPECT_GT(volume, whole * (1 - h * h / (3 * r * r)));
    }
}

TEST(Implicit, ARoundedCube) {
    for (const double r : {0.25, 1.0}) {
        const double a = 2 - 2 * r; // Steiner's formula
        const double whole =
            a * a * a + 6 * a * a * r + 3 * pi * a * r * r + 4 * pi / 3 * r * r * r;
        EXPECT_NEAR(sound(body("rounded-cube", {{"round", r}})).volume, whole, 0.004 * whole);
    }
}

TEST(Implicit, HolesAreCounted) {
    const auto two = body("genus2");
    EXPECT_EQ(sound(two).components, 1u);
    EXPECT_EQ(eulerCharacteristic(two), 2 - 2 * 2);
    for (const double cells : {1.0, 2.0, 3.5})
        EXPECT_EQ(sound(body("gyroid", {{"cells", cells}}, 64)).components, 1u);
}

TEST(Implicit, WhatIsRandomIsTheSeedsAlone) {
    const auto once = body("metaballs"), other = body("metaballs", {}, 48, 7);
    sound(once);
    sound(other);
    EXPECT_EQ(body("metaballs").points, once.points);
    EXPECT_NE(other.points, once.points);
    const mesh::Box box = mesh::boundingBox(body("metaballs", {{"count", 60}}));
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::max(box.max[axis], -box.min[axis]), 1);
}

TEST(Implicit, ADropFallsIntoItsPool) {
    for (double time = 0; time < 1; time += 0.11) {
        SCOPED_TRACE(time);
        sound(body("splash", {{"time", time}}, 40));
    }
    EXPECT_EQ(sound(body("splash", {{"time", 0.1}})).components, 2u); // the drop in the air
    EXPECT_EQ(sound(body("splash", {{"time", 0.25}})).components, 1u);
    EXPECT_EQ(sound(body("splash", {{"time", 0.75}})).components, 2u); // the jet's own drop
    // Still water before: a pool of 2 x 2 x 0.6 but for its chamfered edges, and the drop.
    const double pool = 2.4, drop = 4 * pi / 3 * std::pow(0.13, 3);
    EXPECT_NEAR(sound(body("splash", {}, 64)).volume, pool + drop, 0.005 * pool);
}

TEST(Implicit, RefusesByName) {
    const auto refused = [](const std::vector<std::string>& words, const std::string& name,
                            std::map<std::string, double> set, int resolution) {
        expectError(ExitStatus::usage, words, [&] { body(name, set, resolution); });
    };
    refused({"'cube'", "rounded-cube"}, "cube", {}, 48);
    refused({"--cells", "torus"}, "torus", {{"cells", 2}}, 48);
    refused({"--tube", "0.9", "0.48"}, "torus", {{"tube", 0.9}}, 48);
    refused({"--resolution", "4"}, "torus", {}, 4);
}

} // namespace eikonal
