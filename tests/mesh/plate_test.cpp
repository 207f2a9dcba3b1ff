// Open surfaces that become plates.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/plate.h"

#include "mesh/check.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

namespace eikonal::mesh {
namespace {

/// A sphere's triangles above y = 0, an open bowl turned over.
TriangleMesh dome() {
    TriangleMesh mesh = icosphere(1, 4);
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return mesh.points[t.x].y + mesh.points[t.y].y + mesh.points[t.z].y < 0;
    });
    dropUnusedPoints(mesh);
    return mesh;
}

TEST(Plate, ASquareBecomesABoxBehindItsFace) {
    TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {2, 0, 3}, {0, 0, 3}}, {{0, 2, 1}, {0, 3, 2}}};
    ASSERT_EQ(makePlate(mesh, 0.25), "");
    const MeshReport report = checkMesh(mesh);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_NEAR(report.volume, 2 * 3 * 0.25, 1e-12);
    const Box box = boundingBox(mesh);
    EXPECT_EQ(box.max.y, 0); // its face looks up and stays
    EXPECT_EQ(box.min.y, -0.25);
    EXPECT_EQ(mesh.flatFrom, 2u);
}

TEST(Plate, ABentSheetKeepsItsFaceAndGetsAThickness) {
    TriangleMesh mesh = dome();
    const std::vector<glm::dvec3> face = mesh.points;
    const double area = surfaceArea(mesh);
    ASSERT_EQ(makePlate(mesh, 0.01), "");
    EXPECT_TRUE(checkTopology(mesh).boundsVolume());
    EXPECT_NEAR(signedVolume(mesh), 0.01 * area, 0.02 * 0.01 * area); // a shell's, less 1 %
    EXPECT_TRUE(std::equal(face.begin(), face.end(), mesh.points.begin()));
}

TEST(Plate, FacesThatDisagreeOrMeetInThreesStay) {
    TriangleMesh apart{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 2, 1}, {0, 2, 3}}};
    EXPECT_NE(makePlate(apart, 0.1), "");
    EXPECT_EQ(apart.triangles.size(), 2u);
    TriangleMesh three{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                       {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_NE(makePlate(three, 0.1), "");
}

} // namespace
} // namespace eikonal::mesh
