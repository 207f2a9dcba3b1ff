// Walls of known thickness, and what is none: found where they are, whatever else is around.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/walls.h"
#include "support/shapes.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

using namespace eikonal::mesh;
using glm::dvec3;

namespace {

double thickness(const TriangleMesh& mesh) {
    const auto wall = thinnestWall(mesh);
    return wall ? wall->thickness : -1;
}

TriangleMesh turned(TriangleMesh mesh) {
    const dvec3 axis = glm::normalize(dvec3(1, 2, 3));
    for (dvec3& p : mesh.points) // Rodrigues' formula, by one radian
        p = p * std::cos(1.0) + glm::cross(axis, p) * std::sin(1.0) +
            axis * glm::dot(axis, p) * (1 - std::cos(1.0));
    return mesh;
}

/// A body of revolution about y through points (radius, height) from axis to axis, from the top
/// down, in `around` sectors.
TriangleMesh lathe(const std::vector<glm::dvec2>& profile, int around) {
    TriangleMesh mesh;
    const auto point = [&](size_t i, int k) {
        const double angle = 2 * glm::pi<double>() * (k % around) / around;
        return dvec3(profile[i].x * std::cos(angle), profile[i].y, -profile[i].x * std::sin(angle));
    };
    const auto add = [&](const dvec3& a, const dvec3& b, const dvec3& c) {
        if (a == b || b == c || c == a) return;
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (const dvec3& p : {a, b, c}) mesh.points.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (size_t i = 0; i + 1 < profile.size(); ++i)
        for (int k = 0; k < around; ++k) {
            add(point(i, k), point(i + 1, k), point(i + 1, k + 1));
            add(point(i, k), point(i + 1, k + 1), point(i, k + 1));
        }
    mergeIdenticalPoints(mesh);
    return mesh;
}

/// A lens of two spherical caps of `radius`, `aperture` wide from the axis.
TriangleMesh lens(double radius, double aperture) {
    const double edge = std::sqrt(radius * radius - aperture * aperture);
    std::vector<glm::dvec2> profile;
    for (int i = -20; i <= 20; ++i) {
        const double r = aperture * (20 - std::abs(i)) / 20;
        const double height = std::sqrt(radius * radius - r * r) - edge;
        profile.emplace_back(r, i < 0 ? height : -height);
    }
    return lathe(profile, 60);
}

} // namespace

TEST(Walls, ABoxHasItsShortestEdge) {
    EXPECT_NEAR(thickness(boxShape(dvec3(0), {3, 1, 2})), 1, 1e-8); // the skin left out of rays
    const auto slab = thinnestWall(turned(boxShape(dvec3(-5), {5, -4.987, 5})));
    ASSERT_TRUE(slab);
    EXPECT_NEAR(slab->thickness, 0.013, 1e-7);
    EXPECT_NEAR(thickness(moved(boxShape(dvec3(0), {3, 0.25, 2}), dvec3(1000))), 0.25, 1e-5);
}

TEST(Walls, AShellHasItsThickness) {
    // Corners on spheres of 1 and 0.95, of facets whose middles lie 3e-4 below them. Walls between
    // facets of equal shape differ from 0.05 by a share of cos(facet's angle).
    const TriangleMesh hollow = joined(icosphere(1, 5), turnedInsideOut(icosphere(0.95, 5)));
    EXPECT_NEAR(thickness(hollow), 0.05, 1e-4);
    // An inner sphere moved by 0.03 leaves 0.02 on that side.
    const TriangleMesh uneven =
        joined(icosphere(1, 5), turnedInsideOut(moved(icosphere(0.95, 5), {0, 0.03, 0})));
    const auto wall = thinnestWall(uneven);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->thickness, 0.02, 3e-4); // facets
    EXPECT_NEAR(wall->middle.y, 0.99, 0.01);
}

TEST(Walls, ADentBetweenSamplesIsFound) {
    // A plate of 1 with a cone of half-angle 45 degrees, cut at 0.04 above its floor, in a body
    // whose surface is 500 times that of the cone's tip.
    const TriangleMesh plate =
        lathe({{0, 0.04}, {0.05, 0.04}, {1.01, 1}, {9, 1}, {9, 0}, {0, 0}}, 96);
    const auto wall = thinnestWall(plate);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->thickness, 0.04, 1e-6);
    EXPECT_LT(std::hypot(wall->middle.x, wall->middle.z), 0.06);
}

TEST(Walls, EdgesAreNone) {
    // A prism of 60 degrees: its ends face away from each other, its sides do not.
    TriangleMesh prism;
    for (const double z : {0.0, 5.0})
        for (int k = 0; k < 3; ++k)
            prism.points.emplace_back(std::cos(k * 2.0944), std::sin(k * 2.0944), z);
    prism.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                       {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    EXPECT_NEAR(thickness(prism), 5, 1e-7);
    // A lens whose faces meet at 60 degrees is thinner than its middle towards the rim, where
    // faces come to look 30 degrees away from opposite: not thinner than there.
    const auto rim = thinnestWall(lens(2, 1));
    ASSERT_TRUE(rim);
    EXPECT_GT(rim->thickness, 0.2);
    EXPECT_LT(rim->thickness, 2 * 2 * (1 - std::cos(glm::pi<double>() / 6)));
}

TEST(Walls, OverlappingPartsAreOneSolid) {
    // Two boxes that overlap by 0.1: no wall is that thin.
    const TriangleMesh both =
        joined(boxShape(dvec3(0), dvec3(2)), boxShape({1.9, 0, 0}, {4, 2, 2}));
    EXPECT_NEAR(thickness(both), 2, 1e-7);
}

TEST(Walls, AreFoundAlikeEachTime) {
    const TriangleMesh mesh = joined(icosphere(1, 3), turnedInsideOut(icosphere(0.8, 2)));
    const auto a = thinnestWall(mesh), b = thinnestWall(mesh);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->thickness, b->thickness);
    EXPECT_EQ(a->middle, b->middle);
}
