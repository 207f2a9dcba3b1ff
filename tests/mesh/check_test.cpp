// Meshes broken on purpose: each fault is seen, and nothing else is claimed.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"
#include "support/shapes.h"

#include <chrono>
#include <gtest/gtest.h>

namespace eikonal::mesh {
namespace {

TriangleMesh unitBox() {
    return boxShape({0, 0, 0}, {1, 1, 1});
}

TriangleMesh tetrahedron(const glm::dvec3& at) {
    TriangleMesh mesh;
    mesh.points = {at, at + glm::dvec3(1, 0, 0), at + glm::dvec3(0, 1, 0),
                   at + glm::dvec3(0, 0, 1)};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

bool says(const MeshReport& report, const std::string& words) {
    for (const std::string& sentence : report.sentences())
        if (sentence.find(words) != std::string::npos) return true;
    return false;
}

TEST(Check, ASoundBoxHasNoFaults) {
    const MeshReport report = checkMesh(unitBox());
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.points, 8u);
    EXPECT_EQ(report.triangles, 12u);
    EXPECT_EQ(report.components, 1u);
    EXPECT_DOUBLE_EQ(report.volume, 1);
    EXPECT_EQ(report.sentences().size(), 1u);
    EXPECT_EQ(report.degenerateFaces + report.duplicateFaces + report.boundaryEdges + report.holes +
                  report.nonManifoldEdges + report.selfIntersectingPairs,
              0u);
}

TEST(Check, AnOpenBoxHasHoles) {
    TriangleMesh box = unitBox();
    box.triangles.erase(box.triangles.begin() + 2, box.triangles.begin() + 4);
    box.triangles.erase(box.triangles.begin());
    const MeshReport report = checkMesh(box);
    EXPECT_FALSE(report.closed);
    EXPECT_FALSE(report.outward);
    EXPECT_TRUE(report.oriented);
    EXPECT_EQ(report.boundaryEdges, 7u); // a square and a triangle of the side across
    EXPECT_EQ(report.holes, 2u);
    EXPECT_TRUE(says(report, "7 edges with a single face, around 2 holes"));
}

TEST(Check, AnInvertedBoxLooksInward) {
    const MeshReport report = checkMesh(turnedInsideOut(unitBox()));
    EXPECT_TRUE(report.closed && report.oriented);
    EXPECT_FALSE(report.outward);
    EXPECT_DOUBLE_EQ(report.volume, -1);
    EXPECT_TRUE(says(report, "inside out"));
}

TEST(Check, OneFlippedFaceIsADisagreement) {
    TriangleMesh box = unitBox();
    std::swap(box.triangles[5].x, box.triangles[5].y);
    const MeshReport report = checkMesh(box);
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.oriented);
    EXPECT_FALSE(report.outward);
    EXPECT_TRUE(says(report, "disagree"));
}

TEST(Check, DuplicateAndDegenerateFacesAreCounted) {
    TriangleMesh box = unitBox();
    box.triangles.push_back({box.triangles[0].y, box.triangles[0].z, box.triangles[0].x});
    box.triangles.push_back({3, 3, 5});
    const MeshReport report = checkMesh(box);
    EXPECT_EQ(report.duplicateFaces, 1u);
    EXPECT_EQ(report.degenerateFaces, 1u);
    EXPECT_EQ(report.nonManifoldEdges, 3u); // around the doubled face
    EXPECT_FALSE(report.closed);
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
}

TEST(Check, ThreePointsInALineHaveNoArea) {
    TriangleMesh mesh;
    // Not parallel to an axis; the coordinates are sums of few powers of two, so it is exact.
    mesh.points = {{0, 0, 0}, {0.5, 0.25, 1}, {1, 0.5, 2}, {1, 0.5, 2.0000000001}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    EXPECT_EQ(checkMesh(mesh).degenerateFaces, 1u);
}

TEST(Check, OverlappingTetrahedraCross) {
    const MeshReport apart = checkMesh(joined(tetrahedron({0, 0, 0}), tetrahedron({2, 0, 0})));
    EXPECT_EQ(apart.selfIntersectingPairs, 0u);
    const MeshReport report =
        checkMesh(joined(tetrahedron({0, 0, 0}), tetrahedron({0.1, 0.2, 0.3})));
    // The second's corner lies in the first: its three sides there pass through the first's slope.
    EXPECT_EQ(report.selfIntersectingPairs, 3u);
    EXPECT_TRUE(report.boundsVolume()); // crossing is no obstacle
    EXPECT_EQ(report.components, 2u);
    EXPECT_TRUE(says(report, "crosses itself: 3 pairs"));
}

TEST(Check, FacesFoldedOntoEachOtherCross) {
    TriangleMesh mesh; // two faces on one edge, in one plane, on the same side
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, -1, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(checkMesh(mesh).selfIntersectingPairs, 1u);
    mesh.triangles[1].z = 4;
    EXPECT_EQ(checkMesh(mesh).selfIntersectingPairs, 0u);
}

TEST(Check, FacesThatShareACornerAndPierceCross) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0.5, -1}, {0.2, 0.5, 1}, {0.2, 0.5, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
    EXPECT_EQ(checkMesh(mesh).selfIntersectingPairs, 1u);
    mesh.points[4] = {-1, -1, -1};
    EXPECT_EQ(checkMesh(mesh).selfIntersectingPairs, 0u);
}

TEST(Check, ASliverIsNoFault) {
    // A closed wedge 1e-7 thin: thousands of times what a double resolves, so a volume.
    const MeshReport report = checkMesh(boxShape({0, 0, 0}, {1, 1e-7, 1}));
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.degenerateFaces, 0u);
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
    // One rounding for each product: 1e-7 has no exact double.
    EXPECT_NEAR(report.volume, 1e-7, 1e-20);
}

TEST(Check, ShellsThatTouchAtAPointAreTwo) {
    TriangleMesh touching = joined(unitBox(), boxShape({1, 1, 1}, {2, 2, 2}));
    EXPECT_EQ(mergeIdenticalPoints(touching), 1u);
    const MeshReport report = checkMesh(touching);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.nonManifoldEdges, 0u);
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
}

TEST(Check, ShellsThatTouchAlongAnEdgeStillBoundAVolume) {
    TriangleMesh touching = joined(unitBox(), boxShape({1, 1, 0}, {2, 2, 1}));
    EXPECT_EQ(mergeIdenticalPoints(touching), 2u);
    const MeshReport report = checkMesh(touching);
    EXPECT_EQ(report.nonManifoldEdges, 1u); // four faces, evenly turned: said, but no obstacle
    EXPECT_TRUE(report.boundsVolume());
}

TEST(Check, AMembraneInsideMakesTheSurfaceOdd) {
    TriangleMesh box = unitBox();
    box.triangles.push_back({0, 1, 7}); // across the inside, between existing edges
    box.triangles.push_back({0, 7, 6});
    const MeshReport report = checkMesh(box);
    EXPECT_FALSE(report.closed);
    EXPECT_GT(report.nonManifoldEdges, 0u);
}

TEST(Check, ACavityMayLookInwardAnIslandMayNot) {
    const TriangleMesh outer = boxShape({-2, -2, -2}, {2, 2, 2});
    const TriangleMesh inner = boxShape({-1, -1, -1}, {1, 1, 1});
    const TriangleMesh cavity = turnedInsideOut(inner);
    const MeshReport hollow = checkMesh(joined(outer, cavity));
    EXPECT_TRUE(hollow.outward);
    EXPECT_DOUBLE_EQ(hollow.volume, 64 - 8);
    EXPECT_TRUE(checkMesh(joined(outer, inner)).outward);
    EXPECT_FALSE(checkMesh(joined(outer, moved(cavity, {9, 0, 0}))).outward);
    EXPECT_FALSE(checkMesh(joined(turnedInsideOut(outer), inner)).outward);
}

TEST(Check, TheVolumeIsThatOfTheSolid) {
    const auto box = [](double half, double x) {
        return moved(boxShape(glm::dvec3(-half), glm::dvec3(half)), {x, 0, 0});
    };
    const auto expect = [](const TriangleMesh& mesh, double volume, size_t buried) {
        const MeshReport report = checkMesh(mesh);
        EXPECT_TRUE(report.boundsVolume());
        EXPECT_NEAR(report.volume, volume, 1e-12 * volume);
        EXPECT_EQ(report.buried, buried);
        EXPECT_EQ(says(report, "within the solid"), buried > 0);
    };
    expect(joined(box(2, 0), box(1, 0)), 64, 1);
    expect(joined(box(2, 0), joined(box(1, 0), box(0.5, 0))), 64, 2);
    expect(joined(box(2, 0), box(1, 9)), 72, 0);
    // An island in a cavity shows; within the island another does not.
    const TriangleMesh hollow = joined(box(4, 0), turnedInsideOut(box(3, 0)));
    expect(joined(hollow, box(1, 0)), 512 - 216 + 8, 0);
    expect(joined(hollow, joined(box(1, 0), box(0.5, 0))), 512 - 216 + 8, 1);
    expect(joined(hollow, box(0.25, 3.5)), 512 - 216, 1); // within the wall
    // What crosses is not wholly within.
    EXPECT_EQ(checkMesh(joined(box(2, 0), box(1, 2.5))).buried, 0u);
}

TEST(Check, FarFromTheOriginNothingChanges) {
    // At 1e6 a double still resolves 1e-10; coordinates move to neighbours, topology stays.
    const glm::dvec3 far(1e6, -1e6, 1e6);
    const TriangleMesh sphere = icosphere(1, 3);
    const MeshReport near = checkMesh(sphere), report = checkMesh(moved(sphere, far));
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
    // Points off by 1e-10 on a surface of area 4π.
    EXPECT_NEAR(report.volume, near.volume, 2e-9);
}

TEST(Check, OddSoupsAreJudgedNotFeared) {
    EXPECT_FALSE(checkMesh({}).closed);
    EXPECT_FALSE(checkMesh({}).boundsVolume());
    TriangleMesh points;
    points.points = {{0, 0, 0}, {1, 0, 0}};
    points.triangles = {{0, 0, 0}, {0, 1, 0}};
    EXPECT_FALSE(checkMesh(points).closed);
    EXPECT_EQ(checkMesh(points).degenerateFaces, 2u);
    TriangleMesh sheet = unitBox();
    sheet.triangles = {{0, 2, 3}, {0, 3, 2}}; // a triangle and its back: closed, encloses nothing
    EXPECT_TRUE(checkMesh(sheet).closed);
    EXPECT_FALSE(checkMesh(sheet).outward);
}

TEST(Check, StacksOfCrossingFacesAreCutShort) {
    TriangleMesh stack; // every face pierces every other: 1,999,000 pairs
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const double t = 1e-4 * i;
        stack.points.insert(stack.points.end(), {{t, -1, -1}, {-t, 1, -1}, {0.01 * t, 0, 1}});
        stack.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const MeshReport report = checkMesh(stack);
    EXPECT_EQ(report.selfIntersectingPairs, kMaxReportedPairs);
    EXPECT_TRUE(says(report, "at least"));
}

TEST(Check, IsQuickOnAScan) {
    const TriangleMesh sphere = uvSphere(1, 75000);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(checkMesh(sphere).boundsVolume());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    // Promised: under 2 s for a scan of 75,000 faces. It takes a tenth of that on an idle machine.
    EXPECT_LT(took.count(), 2);
}

} // namespace
} // namespace eikonal::mesh
