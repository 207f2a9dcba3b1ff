// Thickness along normals.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/normal_distances.h"

#include "raytrace/scenes.h"

#include <gtest/gtest.h>

namespace eikonal::raytrace {
namespace {

using glm::dvec3;

TEST(NormalDistances, OfASphereAreItsDiameter) {
    const std::vector<float> distances = distancesAlongNormals(mesh::icosphere(2, 5));
    ASSERT_EQ(distances.size(), size_t{10242});
    // The far facets lie within h² / 8 of it, h = 0.08, and edges have angles of 1.8° there.
    for (const float d : distances) EXPECT_NEAR(d, 4, 1e-3);
}

TEST(NormalDistances, OfABoxAreItsSizesAndDiagonals) {
    // Four points in the middle of each side's pairs of triangles would need finer ones: here the
    // box has its corners alone, whose normals, by angles, are the diagonals of a cube.
    const std::vector<float> distances = distancesAlongNormals(mesh::boxShape(dvec3(-1), dvec3(1)));
    ASSERT_EQ(distances.size(), size_t{8});
    for (const float d : distances) EXPECT_NEAR(d, 2 * std::sqrt(3.0), 1e-5);
}

TEST(NormalDistances, WithinASideAreAcross) {
    mesh::TriangleMesh box = mesh::boxShape({-1, -2, -3}, {1, 2, 3});
    // A point in the middle of a triangle of each side parts it in three.
    const size_t corners = box.points.size(), faces = box.triangles.size();
    for (size_t f = 0; f < faces; ++f) {
        const glm::uvec3 t = box.triangles[f];
        const auto middle = static_cast<unsigned>(box.points.size());
        box.points.push_back((box.points[t.x] + box.points[t.y] + box.points[t.z]) / 3.0);
        box.triangles[f] = {t.x, t.y, middle};
        box.triangles.push_back({t.y, t.z, middle});
        box.triangles.push_back({t.z, t.x, middle});
    }
    const std::vector<float> distances = distancesAlongNormals(box);
    for (size_t i = corners; i < distances.size(); ++i) {
        const dvec3 x = glm::abs(box.points[i]);
        const double across = x.x == 1 ? 2 : x.y == 2 ? 4 : 6;
        EXPECT_NEAR(distances[i], across, 1e-5);
    }
}

TEST(NormalDistances, EndAtTheFirstWall) {
    // From its outer side to the cavity.
    const mesh::TriangleMesh shell =
        mesh::joined(mesh::icosphere(2, 4), mesh::turnedInsideOut(mesh::icosphere(1.5, 4)));
    const std::vector<float> distances = distancesAlongNormals(shell);
    for (size_t i = 0; i < distances.size(); ++i) EXPECT_NEAR(distances[i], 0.5, 5e-3);
}

TEST(NormalDistances, OfAnOpenSheetAreZero) {
    mesh::TriangleMesh sheet;
    sheet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    sheet.triangles = {{0, 1, 2}};
    EXPECT_EQ(distancesAlongNormals(sheet), (std::vector<float>{0, 0, 0, 0}));
}

} // namespace
} // namespace eikonal::raytrace
