// The shapes that other tests lean on, and the winding number that judges.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"
#include "mesh/triangulate.h"
#include "support/shapes.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <numeric>

namespace eikonal::mesh {
namespace {

// Sums of a few hundred products of numbers near 1: some hundred times the rounding of one.
constexpr double kRounding = 1e-13;

TEST(Shapes, BoxHasTheVolumeOfItsSides) {
    const TriangleMesh box = boxShape({-1, 0, 2}, {1, 3, 6});
    EXPECT_NEAR(signedVolume(box), 24, 24 * kRounding);
    EXPECT_TRUE(checkMesh(box).boundsVolume());
    EXPECT_EQ(boundingBox(box).min, glm::dvec3(-1, 0, 2));
    EXPECT_EQ(boundingBox(box).max, glm::dvec3(1, 3, 6));
}

TEST(Shapes, SpheresApproachTheBallAtSecondOrder) {
    const double ball = 4 * glm::pi<double>() / 3 * 8;
    for (const auto& sphere : {+[](int level) { return icosphere(2, level); },
                               +[](int level) { return uvSphere(2, 400u << (2 * level)); }}) {
        const double coarse = ball - signedVolume(sphere(2)), fine = ball - signedVolume(sphere(3));
        EXPECT_GT(fine, 0); // corners lie on the sphere, so faces lie within
        // Edges of half the length leave a quarter of the gap; the next order adds a few percent.
        EXPECT_NEAR(coarse / fine, 4, 0.2);
        EXPECT_TRUE(checkMesh(sphere(2)).boundsVolume());
        EXPECT_EQ(checkMesh(sphere(2)).selfIntersectingPairs, 0u);
    }
}

TEST(Shapes, UvSphereKeepsToTheCountAskedFor) {
    for (size_t wanted : {12u, 100u, 5000u, 75408u}) {
        const double got = static_cast<double>(uvSphere(1, wanted).triangles.size());
        // Bands are whole: the count steps by 8n at 4n², so it misses by at most 2/sqrt(count).
        EXPECT_NEAR(got / static_cast<double>(wanted), 1, 2 / std::sqrt(double(wanted))) << wanted;
    }
}

TEST(Winding, CountsHowOftenTheSurfaceWraps) {
    const TriangleMesh outer = boxShape({-2, -2, -2}, {2, 2, 2});
    const TriangleMesh inner = boxShape({-1, -1, -1}, {1, 1, 1});
    const TriangleMesh hollow = joined(outer, turnedInsideOut(inner));
    const TriangleMesh twice = joined(outer, inner);
    EXPECT_NEAR(windingNumber(hollow, {1.5, 0.1, 0.2}), 1, kRounding);
    EXPECT_NEAR(windingNumber(hollow, {0.5, 0.1, 0.2}), 0, kRounding);
    EXPECT_NEAR(windingNumber(twice, {0.5, 0.1, 0.2}), 2, kRounding);
    EXPECT_NEAR(windingNumber(twice, {3, 0.1, 0.2}), 0, kRounding);
    EXPECT_NEAR(windingNumber(turnedInsideOut(outer), {0.5, 0, 0}), -1, kRounding);
}

TEST(Winding, IsTheSolidAngleOfAnOpenSurface) {
    TriangleMesh openBox = boxShape({-1, -1, -1}, {1, 1, 1});
    openBox.triangles.resize(10); // one of six sides gone, a sixth of the view from the centre
    EXPECT_NEAR(windingNumber(openBox, {0, 0, 0}), 5.0 / 6, kRounding);
}

TEST(Points, IdenticalOnesBecomeOneAndUnusedOnesGo) {
    TriangleMesh mesh;
    mesh.points = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 0, 1}};
    mesh.triangles = {{1, 2, 3}, {4, 5, 2}};
    EXPECT_EQ(mergeIdenticalPoints(mesh), 2u);
    ASSERT_EQ(mesh.points.size(), 4u);
    EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 3, 1)); // minus zero is zero
}

double flatArea(const std::vector<glm::dvec3>& points, const std::vector<glm::uvec3>& triangles) {
    double area = 0; // of each triangle by itself: an overlap would count twice
    for (const glm::uvec3& t : triangles)
        area += 0.5 * glm::length(glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x]));
    return area;
}

TEST(Polygons, AConcaveOneIsCoveredOnceFromEverySideAndStart) {
    // An arrowhead of area 2, in a plane not parallel to any axis's.
    const std::vector<glm::dvec2> arrow = {{0, 0}, {2, 2}, {0, 1}, {-2, 2}};
    const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0, 0, 1)));
    std::vector<glm::dvec3> points;
    for (const glm::dvec2& p : arrow) points.push_back(p.x * u + p.y * v);
    for (std::uint32_t start = 0; start < 8; ++start) {
        std::vector<std::uint32_t> polygon;
        for (std::uint32_t i = 0; i < 4; ++i)
            polygon.push_back(start < 4 ? (start + i) % 4 : (start + 4 - i) % 4);
        std::vector<glm::uvec3> triangles;
        appendTriangles(points, polygon, triangles);
        ASSERT_EQ(triangles.size(), 2u);
        EXPECT_NEAR(flatArea(points, triangles), 2, kRounding) << "start " << start;
    }
}

TEST(Polygons, HopelessOnesStillGiveTrianglesOnEachSide) {
    const std::vector<glm::dvec3> points(6, glm::dvec3(1, 2, 3));
    std::vector<std::uint32_t> polygon(6);
    std::iota(polygon.begin(), polygon.end(), 0u);
    std::vector<glm::uvec3> triangles;
    appendTriangles(points, polygon, triangles);
    EXPECT_EQ(triangles.size(), 4u);
}

} // namespace
} // namespace eikonal::mesh
