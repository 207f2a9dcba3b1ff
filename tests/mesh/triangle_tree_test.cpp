// The tree's answers against those of every triangle asked one by one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/solid_boundary.h"
#include "mesh/triangle_tree.h"
#include "support/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

using namespace eikonal::mesh;
using glm::dvec3;

namespace {

struct Corners {
    dvec3 a, b, c;
};

Corners cornersOf(const TriangleMesh& mesh, size_t face) {
    const glm::uvec3& f = mesh.triangles[face];
    return {mesh.points[f.x], mesh.points[f.y], mesh.points[f.z]};
}

/// 400 triangles of any size and place in the unit cube, slivers and points among them.
TriangleMesh soup(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const dvec3 a(unit(random), unit(random), unit(random));
        const double size = std::pow(10, -3 * unit(random));
        const dvec3 b = a + size * dvec3(unit(random), unit(random), unit(random));
        const dvec3 beside = b + size * dvec3(unit(random), unit(random), unit(random));
        const dvec3 c = i % 20 == 0 ? a : i % 20 == 1 ? 0.5 * (a + b) : beside;
        mesh.points.insert(mesh.points.end(), {a, b, c});
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

} // namespace

TEST(TriangleTree, FindsTheNearestWhateverTheHint) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.5, 1.5);
    const TriangleMesh mesh = soup(random);
    const TriangleTree tree(mesh);
    for (int i = 0; i < 500; ++i) {
        const dvec3 x(place(random), place(random), place(random));
        double least = 1e300;
        for (size_t f = 0; f < mesh.triangles.size(); ++f) {
            const Corners t = cornersOf(mesh, f);
            least = std::min(least, squaredDistance(x, t.a, t.b, t.c));
        }
        // The same function on the same numbers: equal, not only near.
        EXPECT_EQ(tree.nearest(x, 1e300).squared, least);
        EXPECT_EQ(tree.nearest(x, 1e300, static_cast<std::uint32_t>(i % 400)).squared, least);
        EXPECT_EQ(tree.nearest(x, least).face, TriangleTree::kNone);
        EXPECT_NE(tree.nearest(x, least * 1.0001 + 1e-30).face, TriangleTree::kNone);
    }
}

TEST(TriangleTree, ATrianglesDistanceIsTheLeastOfManyPointsOnIt) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 2);
    const TriangleMesh mesh = soup(random);
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Corners t = cornersOf(mesh, f);
        const dvec3 x(place(random), place(random), place(random));
        const int kSteps = 60;
        double least = 1e300;
        for (int i = 0; i <= kSteps; ++i)
            for (int j = 0; j + i <= kSteps; ++j)
                least = std::min(least, glm::distance(x, t.a + (t.b - t.a) * (1.0 * i / kSteps) +
                                                             (t.c - t.a) * (1.0 * j / kSteps)));
        const double found = std::sqrt(squaredDistance(x, t.a, t.b, t.c));
        EXPECT_LE(found, least * (1 + 1e-12));
        // Points lie no further apart than a step along both sides.
        EXPECT_GE(found, least - (glm::distance(t.a, t.b) + glm::distance(t.a, t.c)) / kSteps);
    }
}

TEST(TriangleTree, FindsEveryFaceOnARayAndNear) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 1), way(-1, 1);
    const TriangleMesh mesh = soup(random);
    const TriangleTree tree(mesh);
    for (int i = 0; i < 300; ++i) {
        const dvec3 x(place(random), place(random), place(random));
        const dvec3 direction(way(random), way(random), i % 3 == 0 ? 0.0 : way(random));
        std::vector<TriangleTree::Hit> hits;
        tree.hits(x, direction, 0.5, hits);
        std::vector<std::uint32_t> found, near, wanted, wantedNear;
        for (const auto& hit : hits) found.push_back(hit.face);
        tree.within(x, 0.3, near);
        std::sort(found.begin(), found.end());
        std::sort(near.begin(), near.end());
        for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
            const Corners t = cornersOf(mesh, f);
            // Volumes of the tetrahedra over the sides tell whether the line passes within.
            const double u = glm::dot(direction, glm::cross(t.b - x, t.c - x)),
                         v = glm::dot(direction, glm::cross(t.c - x, t.a - x)),
                         w = glm::dot(direction, glm::cross(t.a - x, t.b - x));
            const dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
            const double along = glm::dot(t.a - x, normal) / glm::dot(direction, normal);
            if (((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)) && along > 0 &&
                along < 0.5)
                wanted.push_back(f);
            if (squaredDistance(x, t.a, t.b, t.c) <= 0.09) wantedNear.push_back(f);
        }
        EXPECT_EQ(found, wanted);
        EXPECT_EQ(near, wantedNear);
    }
}

TEST(TriangleTree, WindsAsTheSolidAnglesSay) {
    const TriangleMesh mesh = joined(joined(icosphere(1, 2), turnedInsideOut(icosphere(0.5, 2))),
                                     moved(uvSphere(0.8, 200), dvec3(0.9, 0.1, 0)));
    const TriangleTree tree(mesh);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-2, 2);
    for (int i = 0; i < 500; ++i) {
        const dvec3 x(place(random), place(random), place(random));
        EXPECT_EQ(tree.winding(x), std::lround(windingNumber(mesh, x)));
    }
}

TEST(SolidBoundary, IsTheSurfaceOfTheUnion) {
    const auto area = [](const TriangleMesh& mesh) {
        double sum = 0;
        for (size_t f = 0; f < mesh.triangles.size(); ++f) {
            const Corners t = cornersOf(mesh, f);
            sum += 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
        }
        return sum;
    };
    const TriangleMesh cube = boxShape(dvec3(0), dvec3(1));
    // What does not overlap stays as it is, what is within is gone, and so is a wall between.
    EXPECT_NEAR(area(solidBoundary(joined(cube, moved(cube, dvec3(2))), 0.1)), 12, 1e-12);
    EXPECT_NEAR(area(solidBoundary(joined(cube, boxShape(dvec3(0.2), dvec3(0.8))), 0.1)), 6, 1e-12);
    EXPECT_NEAR(area(solidBoundary(joined(cube, moved(cube, {1, 0, 0})), 0.1)), 10, 1e-12);
    // A bar through the cube: each opening and each end is off by half a piece along its rim of
    // length 2 at most, both ways.
    const TriangleMesh bar = boxShape({0.25, 0.25, -1}, {0.75, 0.75, 2});
    const double wanted = 6 - 2 * 0.25 + 4 * 0.5 * 2 + 2 * 0.25;
    EXPECT_NEAR(area(solidBoundary(joined(cube, bar), 0.01)), wanted, 4 * 2 * 0.005);
}
