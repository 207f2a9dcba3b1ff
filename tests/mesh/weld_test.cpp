// Soups whose points rounding holds apart: welded where that closes them, told where it can't.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"
#include "mesh/repair.h"
#include "mesh/weld.h"
#include "support/shapes.h"

#include <gtest/gtest.h>
#include <random>

namespace eikonal::mesh {
namespace {

/// Every face with corners of its own, each off by up to `jitter` along every axis.
TriangleMesh soupOf(const TriangleMesh& mesh, double jitter, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-jitter, jitter);
    TriangleMesh soup;
    for (const glm::uvec3& face : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (int k = 0; k < 3; ++k)
            soup.points.push_back(mesh.points[face[k]] +
                                  glm::dvec3(off(random), off(random), off(random)));
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

double diagonalOf(const TriangleMesh& mesh) {
    const Box box = boundingBox(mesh);
    return glm::distance(box.min, box.max);
}

/// Repaired, the soup is the mesh again, its points off by no more than the jitter.
void expectBack(const TriangleMesh& mesh, double jitter, unsigned seed) {
    const RepairResult result = repairMesh(soupOf(mesh, jitter, seed));
    const MeshReport was = checkTopology(mesh), is = checkTopology(result.mesh);
    EXPECT_TRUE(is.boundsVolume());
    EXPECT_EQ(result.loss, "");
    EXPECT_EQ(is.points, was.points);
    EXPECT_EQ(is.triangles, was.triangles);
    EXPECT_EQ(is.components, was.components);
    EXPECT_NEAR(is.volume, was.volume, 2 * jitter * surfaceArea(mesh) + 1e-12 * was.volume);
    const Box a = boundingBox(mesh), b = boundingBox(result.mesh);
    EXPECT_LE(glm::length(a.min - b.min) + glm::length(a.max - b.max), 4 * jitter + 1e-15);
}

TEST(Weld, BringsASoupBackAtEveryJitterUpToTheWidest) {
    const std::vector<TriangleMesh> shapes = {
        boxShape({-1, -2, -3}, {1, 2, 3}), icosphere(1, 3), uvSphere(50, 800),
        moved(icosphere(1e-3, 2), {7, -5, 3}),
        joined(icosphere(2, 2), turnedInsideOut(icosphere(1.8, 2)))};
    unsigned seed = 0;
    for (const TriangleMesh& shape : shapes)
        for (const double share : {0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6})
            // Two corners are apart by as much as twice the jitter along the diagonal.
            for (const double fill : {0.05, 0.28}) {
                SCOPED_TRACE("share " + std::to_string(share) + " seed " + std::to_string(seed));
                expectBack(shape, 10 * share * fill * diagonalOf(shape), ++seed);
            }
}

TEST(Weld, KeepsWhatIsThinButWider) {
    // The plate is a hundred times as thick as its corners are apart, and thinner than the widest
    // weld: the smallest tolerance that closes it must do.
    for (const double thick : {1e-2, 1e-4, 1e-6})
        expectBack(boxShape({0, 0, 0}, {1, 2, thick}), 1e-3 * thick, 5);
}

TEST(Weld, LeavesWhatNoToleranceCloses) {
    TriangleMesh box = boxShape({0, 0, 0}, {1, 1e-7, 1}); // open, but by no rounding
    box.triangles.pop_back();
    const TriangleMesh before = box;
    EXPECT_EQ(weldNearPoints(box).points, 0u);
    EXPECT_EQ(box.points, before.points);
    EXPECT_EQ(box.triangles, before.triangles);
    TriangleMesh nothing;
    EXPECT_EQ(weldNearPoints(nothing).points, 0u);
}

TEST(Weld, ASoupTooCoarseIsALoss) {
    const TriangleMesh ball = icosphere(1, 3);
    for (const double jitter : {1e-4, 1e-3, 1e-2})
        EXPECT_NE(repairMesh(soupOf(ball, jitter)).loss, "") << jitter;
    // Half of the surface is lost, the other half sound.
    const RepairResult half = repairMesh(joined(moved(ball, {5, 0, 0}), soupOf(ball, 1e-3)));
    EXPECT_NE(half.loss.find("50 % of its surface"), std::string::npos) << half.loss;
}

TEST(Weld, HolesAndFlapsAreNoLoss) {
    TriangleMesh ball = icosphere(1, 3);
    ball.triangles.resize(ball.triangles.size() - 40);
    EXPECT_EQ(repairMesh(ball).loss, "");
    TriangleMesh flap;
    flap.points = {{5, 0, 0}, {5.5, 0, 0}, {5, 0.5, 0}};
    flap.triangles = {{0, 1, 2}};
    EXPECT_EQ(repairMesh(joined(boxShape({0, 0, 0}, {1, 1, 1}), flap)).loss, "");
    // A bowl's lid is as large as a third of what was there.
    TriangleMesh bowl = icosphere(1, 4);
    std::erase_if(bowl.triangles, [&](const glm::uvec3& face) {
        return bowl.points[face.x].y + bowl.points[face.y].y + bowl.points[face.z].y < 0;
    });
    EXPECT_EQ(repairMesh(bowl).loss, "");
}

} // namespace
} // namespace eikonal::mesh
