// Curved surfaces from facets: closed, where the formula says, and flat where that is meant.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/curved_face.h"
#include "mesh/parts.h"
#include "mesh/repair.h"
#include "mesh/smooth_surface.h"
#include "mesh/triangle_tree.h"
#include "sample_files.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace eikonal::mesh {
namespace {

using glm::dvec2;
using glm::dvec3;

TriangleMesh curvedBy(const TriangleMesh& mesh, double degrees, double sagitta, size_t flat = 0) {
    SmoothCounts counts;
    TriangleMesh result = curved(mesh, findFans(mesh, degrees), sagitta, counts);
    EXPECT_EQ(counts.flat, flat);
    return result;
}

TriangleMesh rotated(TriangleMesh mesh, double angle, const dvec3& axis) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), angle, axis);
    for (dvec3& point : mesh.points) point = dvec3(turn * glm::dvec4(point, 1));
    return mesh;
}

void expectUnsplit(const TriangleMesh& mesh, const TriangleMesh& result) {
    EXPECT_EQ(result.points, mesh.points);
    EXPECT_EQ(result.triangles, mesh.triangles);
}

/// The farthest that a point is from the sphere of radius 1.
double offSphere(const TriangleMesh& mesh) {
    double most = 0;
    for (const dvec3& point : mesh.points) most = std::max(most, std::abs(glm::length(point) - 1));
    return most;
}

TriangleMesh octahedron() {
    TriangleMesh mesh;
    mesh.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                      {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    return mesh;
}

class SmoothFile : public MeshFileTest {
protected:
    /// As OBJ, with a normal for each corner.
    TriangleMesh throughObj(const TriangleMesh& mesh, const std::vector<CornerNormals>& normals) {
        std::string text = coordinates(mesh, "v "), faces;
        std::ostringstream out;
        for (const CornerNormals& of : normals)
            for (const glm::vec3& n : of) out << "vn " << n.x << ' ' << n.y << ' ' << n.z << '\n';
        for (size_t f = 0; f < mesh.triangles.size(); ++f) {
            out << 'f';
            for (int k = 0; k < 3; ++k)
                out << ' ' << mesh.triangles[f][k] + 1 << "//" << 3 * f + size_t(k) + 1;
            out << '\n';
        }
        return readMesh(write("normals.obj", text + out.str()));
    }
};

std::vector<CornerNormals> facesOwn(const TriangleMesh& mesh) {
    std::vector<CornerNormals> normals;
    for (const glm::uvec3& f : mesh.triangles) {
        const glm::vec3 n(glm::normalize(
            glm::cross(mesh.points[f.y] - mesh.points[f.x], mesh.points[f.z] - mesh.points[f.x])));
        normals.push_back({n, n, n});
    }
    return normals;
}

std::vector<CornerNormals> spheresOwn(const TriangleMesh& mesh) {
    std::vector<CornerNormals> normals;
    for (const glm::uvec3& f : mesh.triangles)
        normals.push_back({glm::vec3(glm::normalize(mesh.points[f.x])),
                           glm::vec3(glm::normalize(mesh.points[f.y])),
                           glm::vec3(glm::normalize(mesh.points[f.z]))});
    return normals;
}

} // namespace

TEST(Smooth, ABoxStaysABox) {
    const TriangleMesh box = boxShape(dvec3(-3, -2, -1), dvec3(3, 2, 1));
    expectUnsplit(box, curvedBy(box, 30, 1e-9));
    const TriangleMesh aslant = rotated(box, 0.7, dvec3(1, 2, 3));
    expectUnsplit(aslant, curvedBy(aslant, 89, 1e-6)); // floats keep 6e-8 of a normal
}

TEST(Smooth, ASpheresPointsLieOnIt) {
    for (const TriangleMesh& mesh : {icosphere(1, 1), icosphere(1, 3), uvSphere(1, 1000)}) {
        const TriangleMesh result = curvedBy(mesh, 30, 5e-4);
        EXPECT_GT(result.triangles.size(), 2 * mesh.triangles.size());
        EXPECT_LT(offSphere(result), 1e-6);
        EXPECT_TRUE(checkMesh(result).boundsVolume());
    }
    const TriangleMesh fine = icosphere(1, 4); // its facets' sagitta is below 0.002
    expectUnsplit(fine, curvedBy(fine, 30, 0.002));
}

TEST(Smooth, FacetsAreRefinedToTheSagittaAskedFor) {
    const TriangleMesh coarse = icosphere(1, 1);
    size_t before = coarse.triangles.size();
    for (const double sagitta : {1e-2, 1e-3, 1e-4}) {
        const TriangleMesh result = curvedBy(coarse, 30, sagitta);
        double least = 1;
        for (const glm::uvec3& f : result.triangles)
            least = std::min(
                least,
                glm::length(result.points[f.x] + result.points[f.y] + result.points[f.z]) / 3);
        EXPECT_GT(least, 1 - sagitta);
        // No finer than three halvings too far in area.
        EXPECT_LT(result.triangles.size(), 64 * before);
        before = result.triangles.size();
    }
}

TEST(Smooth, ACylinderIsRoundAndItsCapsAreFlat) {
    const TriangleMesh mesh = turned({{0, -2}, {1, -2}, {1, 2}, {0, 2}}, 16, false);
    const TriangleMesh result = curvedBy(mesh, 30, 1e-4);
    EXPECT_TRUE(checkMesh(result).boundsVolume());
    int rim = 0;
    for (const dvec3& p : result.points) {
        const double radius = glm::length(dvec2(p.x, p.z));
        if (std::abs(p.y) < 2 - 1e-9) {
            EXPECT_NEAR(radius, 1, 1e-5);
        }
        EXPECT_LT(std::abs(p.y), 2 + 1e-12);
        rim += std::abs(radius - 1) < 1e-5 && std::abs(p.y) > 2 - 1e-9;
    }
    EXPECT_GE(rim, 2 * 2 * 16); // the rims themselves are split
    EXPECT_NEAR(checkMesh(result).volume, 4 * glm::pi<double>(), 3e-3);
}

TEST(Smooth, ACreaseIsTheSameCurveFromBothSides) {
    // A lens: two caps of spheres of radius 2 that meet in a circle of radius 1.
    const double cap = std::asin(0.5);
    std::vector<dvec2> profile;
    for (int i = -4; i <= 4; ++i) {
        const double angle = cap * (4 - std::abs(i)) / 4;
        const double y = 2 * std::cos(angle) - std::sqrt(3.0);
        profile.emplace_back(2 * std::sin(angle), i < 0 ? -y : y);
    }
    const TriangleMesh mesh = turned(profile, 24, false);
    const TriangleMesh result = curvedBy(mesh, 30, 1e-4);
    EXPECT_TRUE(checkMesh(result).boundsVolume());
    EXPECT_EQ(checkMesh(result).selfIntersectingPairs, 0u);
    double off = 0;
    for (const dvec3& p : result.points)
        off = std::max(
            off, std::abs(glm::distance(p, dvec3(0, p.y > 0 ? -1 : 1, 0) * std::sqrt(3.0)) - 2));
    // The facets are off by 0.009.
    EXPECT_LT(off, 3e-4);
}

TEST(Smooth, WhateverTheCreasesItStaysClosed) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int i = 0; i < 10; ++i) {
        TriangleMesh mesh = icosphere(1, 2);
        const double rough = 0.02 * (i % 5 + 1); // angles of up to 60° and more
        for (dvec3& point : mesh.points) point *= 1 + rough * share(random);
        if (i % 2 == 1) {
            mesh.normals = spheresOwn(mesh);
            for (CornerNormals& of : mesh.normals)
                if (share(random) < 0)
                    for (glm::vec3& n : of)
                        n = glm::vec3(share(random), share(random), share(random));
        }
        SmoothCounts counts;
        const TriangleMesh result = curved(mesh, findFans(mesh, 30), 3e-3, counts);
        EXPECT_GT(result.triangles.size(), mesh.triangles.size());
        const MeshReport report = checkMesh(result);
        EXPECT_TRUE(report.boundsVolume());
        EXPECT_EQ(report.boundaryEdges, 0u);
        EXPECT_EQ(report.nonManifoldEdges, 0u);
        EXPECT_EQ(report.selfIntersectingPairs, 0u) << i;
    }
}

TEST(Smooth, APlaneStaysFlatUpToItsFillet) {
    // A disc of radius 10 whose rim is rounded by a quarter of radius 1 in six steps.
    std::vector<dvec2> profile = {{0, -1}};
    for (int i = 0; i <= 12; ++i) {
        const double angle = glm::pi<double>() * (i - 6) / 12;
        profile.emplace_back(10 + std::cos(angle), std::sin(angle));
    }
    profile.emplace_back(0, 1);
    const TriangleMesh mesh = turned(profile, 90, false);
    const TriangleMesh result = curvedBy(mesh, 30, 1e-3);
    double bulge = 0, off = 0;
    for (const dvec3& p : result.points) {
        const double r = glm::length(dvec2(p.x, p.z));
        if (r < 10)
            bulge = std::max(bulge, std::abs(p.y) - 1);
        else
            off = std::max(off, std::abs(glm::length(dvec2(r - 10, p.y)) - 1));
    }
    // By the normals of the steps beside it the plane would rise by 0.3.
    EXPECT_LT(bulge, 0.01);
    EXPECT_LT(off, 0.01);
}

TEST(Smooth, ATipIsKept) {
    const TriangleMesh cone = turned({{0, 0}, {1, 0}, {0, 4}}, 24, false);
    const TriangleMesh result = curvedBy(cone, 30, 1e-3);
    EXPECT_TRUE(checkMesh(result).boundsVolume());
    double off = 0;
    for (const dvec3& p : result.points)
        if (p.y > 1e-6) off = std::max(off, std::abs(glm::length(dvec2(p.x, p.z)) - (1 - p.y / 4)));
    EXPECT_LT(off, 0.02);
}

TEST(Smooth, WhatWouldCrossStaysFlat) {
    // A cavity of 80 facets in a box one wall of which lies closer to a facet than the facet is to
    // the ball.
    TriangleMesh ball = icosphere(1, 1);
    const glm::uvec3 f = ball.triangles[3];
    const dvec3 n = glm::normalize(
        glm::cross(ball.points[f.y] - ball.points[f.x], ball.points[f.z] - ball.points[f.x]));
    const double height = glm::dot(n, ball.points[f.x]);
    const dvec3 axis = glm::cross(n, dvec3(0, 0, 1));
    ball = rotated(ball, std::acos(n.z), axis);
    const TriangleMesh mesh =
        joined(turnedInsideOut(ball), boxShape(dvec3(-2, -2, -2), dvec3(2, 2, 0.5 * (height + 1))));
    ASSERT_TRUE(checkMesh(mesh).boundsVolume());
    ASSERT_EQ(checkMesh(mesh).selfIntersectingPairs, 0u);
    SmoothCounts counts;
    const TriangleMesh result = curved(mesh, findFans(mesh, 30), 1e-3, counts);
    EXPECT_GT(counts.flat, 0u);
    EXPECT_LT(counts.flat, 20u);
    EXPECT_EQ(checkMesh(result).selfIntersectingPairs, 0u);
    EXPECT_TRUE(checkMesh(result).boundsVolume());
    EXPECT_GT(result.triangles.size(), 5 * mesh.triangles.size());
}

TEST(Smooth, AThinRimIsRound) {
    // A bowl whose wall is a fiftieth of its radius: its rim's sides rise by half of that within
    // the rim, as do the edges across it, or the rim would fold.
    std::vector<dvec2> bowl;
    for (int i = 0; i <= 10; ++i)
        bowl.push_back(1.02 * dvec2(std::sin(0.2 * i), -std::cos(0.2 * i)));
    for (int i = 10; i >= 0; --i) bowl.emplace_back(std::sin(0.2 * i), -std::cos(0.2 * i));
    const TriangleMesh result = curvedBy(turned(bowl, 24, false), 30, 1e-3);
    const MeshReport report = checkMesh(result);
    EXPECT_TRUE(report.boundsVolume());
    EXPECT_EQ(report.selfIntersectingPairs, 0u);
    double most = 0;
    for (const dvec3& p : result.points)
        if (p.y > -1.01 * std::cos(2.0) - 1e-3)
            most = std::max(most, std::abs(glm::length(p) - 1.01) - 0.01);
    EXPECT_LT(most, 3e-4);
}

TEST(Smooth, SurfacesThatTouchDoSoAfterwards) {
    // Wine in a bowl, half an egg: its round faces are the bowl's, seen from the other side. The
    // bowl goes on above; so its normals at the wine's rim are others than the wine tells.
    std::vector<dvec2> bowl, side; // the outside from the bottom up, then the inside back
    for (int i = 0; i <= 10; ++i)
        bowl.push_back(1.3 * dvec2(std::sin(0.15 * i), -2 * std::cos(0.15 * i)));
    for (int i = 10; i >= 0; --i) {
        bowl.emplace_back(std::sin(0.15 * i), -2 * std::cos(0.15 * i));
        if (i <= 6) side.push_back(bowl.back());
    }
    const dvec2 rim = side.front();
    TriangleMesh wine =
        joined(turnedInsideOut(turned(side, 24, false)), turned({rim, {0, rim.y}}, 24, false));
    mergeIdenticalPoints(wine);
    const TriangleMesh meshes[] = {turned(bowl, 24, false), wine};
    for (const TriangleMesh& mesh : meshes) ASSERT_TRUE(checkMesh(mesh).boundsVolume());
    // The farthest that one of the curved wine's points on its round side is off the curved bowl.
    const auto apart = [&](const std::vector<Fans>& fans) {
        SmoothCounts counts;
        const TriangleMesh around = curved(meshes[0], fans[0], 3e-3, counts);
        const auto sides = edgeCurves(around);
        double most = 0;
        for (const dvec3& p : curved(meshes[1], fans[1], 3e-3, counts).points) {
            if (p.y > rim.y - 1e-9 && glm::length(dvec2(p.x, p.z)) < 0.95 * rim.x) continue;
            double squared = 1;
            for (size_t f = 0; f < sides.size(); ++f) {
                const glm::uvec3& face = around.triangles[f];
                const std::array corners = {around.points[face.x], around.points[face.y],
                                            around.points[face.z]};
                if (squaredDistance(p, corners[0], corners[1], corners[2]) >= 0.01) continue;
                const CurvedFace patch(corners, sides[f]);
                squared = std::min(squared, patch.nearest(p, patch.flatNearest(p)).squared);
            }
            most = std::max(most, std::sqrt(squared));
        }
        return most;
    };
    std::vector<Fans> fans = {findFans(meshes[0], 30), findFans(meshes[1], 30)};
    const double alone = apart(fans);
    joinFans({&meshes[0], &meshes[1]}, fans, 30);
    const double together = apart(fans);
    EXPECT_LT(together, 1e-4);
    EXPECT_GT(alone, 5 * together);
}

TEST_F(SmoothFile, FlatNormalsMeanFlat) {
    const TriangleMesh ball = icosphere(1, 3);
    const TriangleMesh read = throughObj(ball, facesOwn(ball));
    ASSERT_EQ(read.normals.size(), ball.triangles.size());
    const TriangleMesh result = curvedBy(read, 30, 1e-3);
    expectUnsplit(read, result);
    for (const auto& sides : edgeCurves(result))
        for (const EdgeCurve& side : sides) EXPECT_LT(glm::length(side.rise), 1e-6);
    // The same without normals is round.
    EXPECT_GT(curvedBy(ball, 30, 1e-3).triangles.size(), 2 * ball.triangles.size());
}

TEST_F(SmoothFile, NormalsOfTheFileAreUsed) {
    const TriangleMesh coarse = octahedron();
    // Faces meet at 70.5°, and are 54.7° off the ball's normals.
    const TriangleMesh obj = throughObj(coarse, spheresOwn(coarse));
    EXPECT_LT(offSphere(curvedBy(obj, 75, 1e-3)), 1e-6);
    EXPECT_TRUE(checkMesh(curvedBy(obj, 75, 1e-3)).boundsVolume());
    expectUnsplit(obj, curvedBy(obj, 60, 1e-3)); // edges above the angle are kept
    std::ostringstream ply;
    ply << "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
           "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
           "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
    for (const dvec3& p : coarse.points)
        ply << p.x << ' ' << p.y << ' ' << p.z << ' ' << 2 * p.x << ' ' << 2 * p.y << ' ' << 2 * p.z
            << '\n'; // of whatever length
    ply << indices(coarse, "3 ", 0);
    EXPECT_LT(offSphere(curvedBy(readMesh(write("normals.ply", ply.str())), 75, 1e-3)), 1e-6);
}

TEST_F(SmoothFile, AveragedNormalsOfABoxAreNoBall) {
    // Programs that have one normal a point write a box so.
    const TriangleMesh box = boxShape(dvec3(-1), dvec3(1));
    const TriangleMesh read = throughObj(box, spheresOwn(box));
    expectUnsplit(read, curvedBy(read, 30, 1e-6));
}

TEST_F(SmoothFile, NormalsThatSayNothingAreNone) {
    const TriangleMesh box = boxShape(dvec3(0), dvec3(1));
    const std::string points = coordinates(box, "v ");
    for (const char* normals :
         {"vn 0 0 0\n", "vn nan 0 1\n", "vn 1 2\n", "vn inf 0 0\n", "vn a b c\n", ""}) {
        for (const char* corner : {"//1", "//7", "//-9", "//x", "/1/1", "//0"}) {
            std::string faces;
            for (const glm::uvec3& f : box.triangles) {
                faces += 'f';
                for (int k = 0; k < 3; ++k) faces += ' ' + std::to_string(f[k] + 1) + corner;
                faces += '\n';
            }
            const TriangleMesh read =
                readMesh(write("odd.obj", points + std::string(normals) + faces));
            for (const CornerNormals& of : read.normals) EXPECT_EQ(of, CornerNormals{});
            expectUnsplit(read, curvedBy(read, 30, 1e-6));
        }
    }
}

TEST_F(SmoothFile, NormalsSurviveARepairAndASplit) {
    // A ball of facets meant flat that lacks one, in two objects.
    TriangleMesh ball = icosphere(1, 2);
    ball.normals = facesOwn(ball);
    TriangleMesh open = ball;
    open.triangles.pop_back();
    open.normals.pop_back();
    const RepairResult repaired = repairMesh(open);
    ASSERT_TRUE(checkMesh(repaired.mesh).boundsVolume());
    ASSERT_EQ(repaired.mesh.normals.size(), repaired.mesh.triangles.size());
    expectUnsplit(repaired.mesh, curvedBy(repaired.mesh, 30, 1e-5));
    const TriangleMesh two = [&] {
        TriangleMesh all = ball;
        append(all, moved(ball, dvec3(3)));
        return all;
    }();
    std::vector<std::uint32_t> labels(two.triangles.size(), 0);
    std::fill(labels.begin() + std::ptrdiff_t(ball.triangles.size()), labels.end(), 1u);
    for (const TriangleMesh& part : split(two, labels, {0, 1})) {
        ASSERT_EQ(part.normals, ball.normals);
        expectUnsplit(part, curvedBy(part, 30, 1e-5));
    }
}

} // namespace eikonal::mesh
