// Repair: what was broken on purpose bounds the volume it had before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"
#include "mesh/repair.h"
#include "support/shapes.h"

#include <gtest/gtest.h>
#include <random>

namespace eikonal::mesh {
namespace {

// Sums of a few dozen products of small numbers; holes in flat sides are filled exactly.
constexpr double kRounding = 1e-12;

TriangleMesh unitBox() {
    return boxShape({0, 0, 0}, {1, 1, 1});
}

bool did(const RepairResult& result, const std::string& action) {
    for (const std::string& sentence : result.actions)
        if (sentence.find(action) != std::string::npos) return true;
    return false;
}

void expectVolume(const RepairResult& result, double volume) {
    const MeshReport report = checkMesh(result.mesh);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.nonManifoldEdges, 0u);
    EXPECT_NEAR(report.volume, volume, volume * kRounding);
}

TEST(Repair, LeavesASoundMeshAlone) {
    const TriangleMesh hollow = joined(boxShape({-2, -2, -2}, {2, 2, 2}),
                                       turnedInsideOut(boxShape({-1, -1, -1}, {1, 1, 1})));
    const RepairResult result = repairMesh(hollow);
    EXPECT_TRUE(result.actions.empty());
    EXPECT_EQ(result.mesh.points, hollow.points);
    EXPECT_EQ(result.mesh.triangles, hollow.triangles);
}

TEST(Repair, FillsHoles) {
    TriangleMesh box = unitBox();
    box.triangles.erase(box.triangles.begin() + 2, box.triangles.begin() + 4);
    box.triangles.erase(box.triangles.begin());
    const RepairResult result = repairMesh(box);
    EXPECT_TRUE(did(result, "filled 2 holes with 3 triangles"));
    expectVolume(result, 1);
}

TEST(Repair, FillsALongRimInBoundedTime) {
    TriangleMesh bowl = uvSphere(1, 200000);
    std::erase_if(bowl.triangles, [&](const glm::uvec3& face) {
        return bowl.points[face.x].y + bowl.points[face.y].y + bowl.points[face.z].y < -0.001;
    });
    const RepairResult result = repairMesh(bowl); // 448 edges around
    EXPECT_TRUE(did(result, "filled 1 hole"));
    const MeshReport report = checkTopology(result.mesh);
    EXPECT_TRUE(report.boundsVolume());
    // Half a ball; 200,000 faces miss it by 1e-4, the rim lies within one band of the equator.
    EXPECT_NEAR(report.volume, 2.0944, 0.03);
}

TEST(Repair, TurnsAnInvertedBoxOutward) {
    const RepairResult result = repairMesh(turnedInsideOut(unitBox()));
    EXPECT_EQ(result.actions.size(), 1u);
    EXPECT_TRUE(did(result, "turned 1 closed part"));
    expectVolume(result, 1);
}

TEST(Repair, MakesAFlippedFaceAgree) {
    for (size_t flipped = 0; flipped < 12; ++flipped) {
        TriangleMesh box = unitBox();
        std::swap(box.triangles[flipped].x, box.triangles[flipped].y);
        expectVolume(repairMesh(box), 1);
    }
}

TEST(Repair, DropsDuplicateAndDegenerateFaces) {
    TriangleMesh box = unitBox();
    box.triangles.push_back({box.triangles[0].x, box.triangles[0].z, box.triangles[0].y});
    box.triangles.push_back({3, 3, 5});
    const RepairResult result = repairMesh(box);
    EXPECT_TRUE(did(result, "dropped 1 triangle with a repeated corner"));
    EXPECT_TRUE(did(result, "dropped 1 triangle given twice"));
    EXPECT_EQ(result.mesh.triangles.size(), 12u);
    expectVolume(result, 1);
}

TEST(Repair, MergesPointsThatWereApart) {
    TriangleMesh soup; // as an STL file has it, read without merging
    const TriangleMesh box = unitBox();
    for (const glm::uvec3& face : box.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (int k = 0; k < 3; ++k) soup.points.push_back(box.points[face[k]]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(checkMesh(soup).components, 12u);
    const RepairResult result = repairMesh(soup);
    EXPECT_TRUE(did(result, "28 points"));
    EXPECT_EQ(result.mesh.points.size(), 8u);
    expectVolume(result, 1);
}

TEST(Repair, KeepsTheCavityOfAnInvertedHollowBox) {
    const TriangleMesh outer = boxShape({-2, -2, -2}, {2, 2, 2});
    const TriangleMesh inner = boxShape({-1, -1, -1}, {1, 1, 1});
    const RepairResult result = repairMesh(joined(turnedInsideOut(outer), inner));
    EXPECT_TRUE(did(result, "turned 2 closed parts"));
    expectVolume(result, 64 - 8);
    // The judge is another one than the signs of volumes that repair goes by.
    EXPECT_NEAR(windingNumber(result.mesh, {1.5, 0.1, 0.2}), 1, kRounding);
    EXPECT_NEAR(windingNumber(result.mesh, {0.5, 0.1, 0.2}), 0, kRounding);
}

TEST(Repair, SplitsABoxWithAMembraneInTwo) {
    TriangleMesh box = unitBox();
    box.triangles.push_back({1, 2, 6}); // the diagonal plane through the box
    box.triangles.push_back({1, 6, 5});
    EXPECT_FALSE(checkMesh(box).closed);
    const RepairResult result = repairMesh(box);
    const MeshReport report = checkMesh(result.mesh);
    EXPECT_TRUE(report.closed && report.oriented && report.outward);
    for (const glm::dvec3& x : {glm::dvec3(0.2, 0.3, 0.4), glm::dvec3(0.9, 0.8, 0.6)})
        EXPECT_NEAR(windingNumber(result.mesh, x), 1, kRounding);
    EXPECT_NEAR(windingNumber(result.mesh, {1.2, 0.3, 0.4}), 0, kRounding);
}

TEST(Repair, DropsAFlatFlapButNotTheWholeMesh) {
    TriangleMesh flap;
    flap.points = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    flap.triangles = {{0, 1, 2}};
    const RepairResult result = repairMesh(joined(unitBox(), flap));
    EXPECT_TRUE(did(result, "dropped 1 flat part"));
    EXPECT_EQ(result.mesh.points.size(), 8u);
    expectVolume(result, 1);
    // A sheet alone encloses nothing, and its report still says so.
    EXPECT_FALSE(checkMesh(repairMesh(flap).mesh).boundsVolume());
    EXPECT_FALSE(repairMesh(flap).mesh.triangles.empty());
}

TEST(Repair, WorksFarFromTheOriginAndOnSlivers) {
    TriangleMesh far = moved(unitBox(), {1e6, 1e6, -1e6});
    far.triangles.pop_back();
    expectVolume(repairMesh(far), 1); // whole numbers: exact even there
    TriangleMesh sliver = boxShape({0, 0, 0}, {1, 1e-7, 1});
    sliver.triangles.pop_back();
    expectVolume(repairMesh(sliver), 1e-7);
}

TEST(Repair, ClosesRandomSoups) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::minstd_rand random(seed + 1);
        TriangleMesh soup;
        const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
        const unsigned points = 4 + below(10), faces = 1 + below(30);
        for (unsigned i = 0; i < points; ++i)
            soup.points.emplace_back(below(4), below(4), below(4));
        for (unsigned i = 0; i < faces; ++i)
            soup.triangles.emplace_back(below(points), below(points), below(points));
        const MeshReport report = checkMesh(repairMesh(soup).mesh);
        EXPECT_TRUE((report.closed && report.oriented) || report.triangles == 0)
            << "rerun with seed " << seed;
    }
}

} // namespace
} // namespace eikonal::mesh
