// The points of opaque surfaces that a picture shows, and light that is given for them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;

namespace {

const glm::ivec3 kSize(32);

/// An opaque half-space below a plane through the middle, of albedo 0.5, and above it as the one of
/// lower priority a slab of glass whose top lies at y = `top` [voxel] and bottom at 20.
volume::Volume floorUnderGlass(const dvec3& normal, double top) {
    const judge::Glass glass{{judge::glassBox({-20, 20, -20}, {60, top, 60}, 1.5),
                              judge::glassHull({{normal, glm::dot(normal, dvec3(16))}}, 1)}};
    sharp::Voxels voxels;
    voxels.size = kSize;
    voxels.halfWidth = 4;
    volume::Volume volume = sharp::volumeOf(glass, voxels);
    volume.putConstant("opacity.S1", glm::vec3(1));
    volume.putConstant("albedo.S1", glm::vec3(0.5f));
    return volume;
}

/// Rays that all travel along `direction`, through the middle of the domain.
Params along(const dvec3& direction, int edge) {
    return parallel(dvec3(16) - 60.0 * direction, dvec3(16), 8, {edge, edge}, {0, 0, 1});
}

/// An opaque half-space of voxels alone, whose opacity rises over so many that it is linear where
/// rays end.
TestVolume voxelFloor(const dvec3& normal) {
    TestVolume scene(kSize);
    scene.constant("ior", 1);
    scene.add("opacity", [=](dvec3 p) {
        return std::clamp(0.5 - glm::dot(normal, p - dvec3(16)) / 6, 0.0, 1.0);
    });
    scene.constantVector("albedo", dvec3(0.5));
    return scene;
}

} // namespace

TEST(ViewPoints, PositionAndNormalAreThoseOfTheSurfaceBehindAllRefraction) {
    const dvec3 normal = glm::normalize(dvec3(0.2, 1, -0.1));
    const dvec3 direction = glm::normalize(dvec3(0.3, -1, 0));
    const dvec3 onFloor(16);
    for (const double top : {22.3, 26.0}) {
        const Look look(floorUnderGlass(normal, top), along(direction, 8));
        // Snell over flat faces: a slab shifts a ray aside along its faces.
        const double sine = direction.x, within = sine / 1.5;
        const double shift = (top - 20) * (within / std::sqrt(1 - within * within) -
                                           sine / std::sqrt(1 - sine * sine));
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const dvec3 place = look.position(x, y);
                EXPECT_NEAR(glm::dot(normal, place - onFloor), 0, 2e-3);
                expectNear(look.normal(x, y), normal, 2e-3);
                // Back along the ray, and back by the shift, it comes to the pixel.
                const dvec3 back = place - dvec3(shift, 0, 0) - onFloor;
                const dvec3 aside = back - glm::dot(back, direction) * direction;
                const dvec3 right = glm::normalize(glm::cross(direction, dvec3(0, 0, 1)));
                const dvec3 up = glm::cross(right, direction);
                EXPECT_NEAR(glm::dot(aside, right), x - 3.5, 3e-3);
                EXPECT_NEAR(glm::dot(aside, up), 3.5 - y, 3e-3);
            }
    }
}

TEST(ViewPoints, OfVoxelsTheyAreThoseOfHalfOpacity) {
    const dvec3 normal = glm::normalize(dvec3(0.2, 1, -0.1));
    const Look look(voxelFloor(normal).take(), along({0, -1, 0}, 8));
    for (int x = 0; x < 8; ++x) {
        EXPECT_NEAR(glm::dot(normal, look.position(x, 3) - dvec3(16)), 0, 2e-3);
        expectNear(look.normal(x, 3), normal, 1e-3);
    }
}

TEST(ViewPoints, AreZeroWhereNothingOpaqueIs) {
    const Look look(floorUnderGlass({0, 1, 0}, 26), along({1, 0, 0}, 8));
    int points = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool any = look.normal(x, y) != dvec3(0);
            EXPECT_EQ(any, look.position(x, y) != dvec3(0));
            points += any;
        }
    EXPECT_GT(points, 20); // that look at the half-space where the domain's face cuts it open
    EXPECT_LT(points, 44);
}

TEST(ViewPoints, GivenLightIsReflected) {
    const dvec3 sloping = glm::normalize(dvec3(0.2, 1, -0.1));
    for (const bool sharp : {true, false}) {
        Params params = along({0, -1, 0}, 16);
        params.samples = 3;
        const auto scene = [&] {
            return sharp ? floorUnderGlass(sloping, 22.3) : voxelFloor(sloping).take();
        };
        const Look seen(scene(), params);
        params.points = {16, 16, {}, {}, {}};
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                params.points.places.push_back(seen.position(x, y));
                params.points.isPoint.push_back(x >= 8);
                params.points.lights.emplace_back(3, 2, y + 1); // grey it is not
            }
        const Look look(scene(), params);
        // What goes through the glass and back out again.
        const double through = sharp ? std::pow(1 - 0.04, 2) : 1;
        for (int y = 1; y < 15; ++y)
            for (int x = 0; x < 16; ++x) {
                if (x == 7 || x == 8) continue; // next to where points end
                const double scale = x < 8 ? 0 : 0.5 / M_PI * through;
                EXPECT_NEAR(look.at("R", x, y), 3 * scale, 3 * scale * 0.02);
                EXPECT_NEAR(look.at("G", x, y), 2 * scale, 2 * scale * 0.02);
                EXPECT_NEAR(look.at("B", x, y), (y + 1) * scale, 0.5 * scale);
            }
    }
}
