// Distances to the surfaces that facets stand for, against those of formulas.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/smooth_surface.h"
#include "support/lattice.h"
#include "voxelize/curve.h"
#include "voxelize/distances.h"

#include <functional>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace eikonal::voxelize {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;
using mesh::TriangleMesh;

constexpr double kBand = 6;

TriangleMesh curvedBy(const TriangleMesh& mesh, double degrees, double sagitta = mesh::kSagitta) {
    mesh::SmoothCounts counts;
    TriangleMesh result = mesh::curved(mesh, mesh::findFans(mesh, degrees), sagitta, counts);
    EXPECT_EQ(counts.flat, 0u);
    return result;
}

struct Deviation {
    double most = 0, rms = 0; // of the distance [voxel]
    double slope = 0;         // rms of its gradient's direction [degree]
    int wrongSide = 0;
};

/// Against a formula, over the voxels within 5 of the surface where `counts`.
Deviation compare(
    const TriangleMesh& mesh, const ivec3& size, const std::function<double(dvec3)>& formula,
    const std::function<bool(dvec3)>& counts = [](const dvec3&) { return true; }) {
    const Lattice lattice = latticeAt(dvec3(-0.5), 1, size, 1);
    const volume::BrickGrid grid = signedDistances(mesh, lattice, kBand);
    Deviation found;
    int voxels = 0;
    for (int z = 1; z + 1 < size.z; ++z)
        for (int y = 1; y + 1 < size.y; ++y)
            for (int x = 1; x + 1 < size.x; ++x) {
                const ivec3 at(x, y, z);
                const double wanted = formula(dvec3(at));
                if (std::abs(wanted) > 4 || !counts(dvec3(at))) continue;
                const double value = grid.at(at);
                found.most = std::max(found.most, std::abs(value - wanted));
                found.rms += (value - wanted) * (value - wanted);
                found.wrongSide += std::abs(wanted) > 1e-5 && value * wanted < 0;
                dvec3 slope, formulas;
                for (int axis = 0; axis < 3; ++axis) {
                    ivec3 step(0);
                    step[axis] = 1;
                    slope[axis] = grid.at(at + step) - grid.at(at - step);
                    formulas[axis] = formula(dvec3(at + step)) - formula(dvec3(at - step));
                }
                const double sine =
                    glm::length(glm::cross(glm::normalize(slope), glm::normalize(formulas)));
                found.slope += sine * sine;
                ++voxels;
            }
    EXPECT_GT(voxels, 1000);
    found.rms = std::sqrt(found.rms / voxels);
    found.slope = glm::degrees(std::sqrt(found.slope / voxels));
    return found;
}

const dvec3 kCentre(20.3, 20.6, 20.1);

double toBall(const dvec3& x) {
    return glm::distance(x, kCentre) - 15;
}

double toCylinder(const dvec3& x) {
    const dvec3 p = x - kCentre;
    const dvec2 q(glm::length(dvec2(p.x, p.z)) - 13, std::abs(p.y) - 11);
    return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, q.y), 0.0);
}

double toTorus(const dvec3& x) {
    const dvec3 p = x - kCentre;
    return glm::length(dvec2(glm::length(dvec2(p.x, p.z)) - 12, p.y)) - 5;
}

TriangleMesh torus(int steps) {
    std::vector<dvec2> profile;
    for (int i = 0; i < steps / 2; ++i) {
        const double angle = glm::two_pi<double>() * i / (steps / 2);
        profile.emplace_back(12 + 5 * std::cos(angle), 5 * std::sin(angle));
    }
    return mesh::moved(mesh::turned(profile, steps, true), kCentre);
}

TEST(Curve, DistancesAreTheBallsHoweverCoarseTheFacets) {
    // 80 facets are up to a voxel off, 1280 up to 0.07; 5120 are not even split.
    for (const int subdivisions : {1, 3, 4}) {
        const TriangleMesh ball = mesh::moved(mesh::icosphere(15, subdivisions), kCentre);
        const TriangleMesh curved = curvedBy(ball, 30);
        EXPECT_EQ(curved.triangles.size() > ball.triangles.size(), subdivisions < 4);
        const Deviation flat = compare(ball, ivec3(41), toBall);
        const Deviation found = compare(curved, ivec3(41), toBall);
        // Three floats for each normal keep 1e-7 of it, and cubics a quarter of the fourth power of
        // 0.05 voxels' angle: 1e-5 of the radius.
        EXPECT_LT(found.most, 5e-5);
        EXPECT_LT(found.slope, 1e-3);
        EXPECT_EQ(found.wrongSide, 0);
        EXPECT_GT(flat.most, 300 * found.most);
        EXPECT_GT(flat.slope, 300 * found.slope);
    }
}

TEST(Curve, ACylindersRimIsSharpAndRound) {
    for (const int steps : {13, 32}) {
        const TriangleMesh mesh = mesh::moved(
            mesh::turned({{0, -11}, {13, -11}, {13, 11}, {0, 11}}, steps, false), kCentre);
        const Deviation found = compare(curvedBy(mesh, 30), ivec3(41), toCylinder);
        EXPECT_LT(found.most, 5e-5);
        EXPECT_EQ(found.wrongSide, 0);
    }
}

TEST(Curve, ATorusConverges) {
    // Its curvature varies, and points alone tell normals to the square of their spacing: the error
    // falls by about 8 where that is halved.
    double before = 0;
    for (const int steps : {24, 48, 96}) {
        const Deviation found = compare(curvedBy(torus(steps), 31), ivec3(41), toTorus);
        if (before > 0) {
            EXPECT_LT(found.most, before / 7);
        }
        before = found.most;
    }
    EXPECT_LT(before, 2e-4);
}

/// A disc whose rim is rounded by radius 3: the nearest point of what that radius is about.
dvec2 core(const dvec2& p) {
    return glm::clamp(p, dvec2(0, -8), dvec2(10, 8));
}

double toFilleted(const dvec3& x) {
    const dvec3 p = x - kCentre;
    const dvec2 q(glm::length(dvec2(p.x, p.z)) - 10, std::abs(p.y) - 8);
    return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, q.y), 0.0) - 3;
}

TEST(Curve, FilletsAreRoundAndPlanesBesideThemFlat) {
    std::vector<dvec2> profile = {{0, -11}};
    for (int i = 0; i <= 9; ++i) { // each fillet in four steps
        const double angle = glm::half_pi<double>() * (i < 5 ? i - 4 : i - 5) / 4;
        profile.emplace_back(10 + 3 * std::cos(angle), (i < 5 ? -8 : 8) + 3 * std::sin(angle));
    }
    profile.emplace_back(0, 11);
    TriangleMesh mesh = mesh::moved(mesh::turned(profile, 48, false), kCentre);
    const Deviation flat = compare(mesh, ivec3(41), toFilleted);
    const Deviation computed = compare(curvedBy(mesh, 30), ivec3(41), toFilleted);
    // By means over faces planes would bulge by 0.7 voxels.
    EXPECT_LT(computed.most, 0.02);
    EXPECT_GT(flat.most, 4 * computed.most);
    EXPECT_GT(flat.slope, 4 * computed.slope);
    for (const glm::uvec3& face : mesh.triangles) {
        mesh.normals.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const dvec3 p = mesh.points[face[k]] - kCentre;
            const double radius = glm::length(dvec2(p.x, p.z));
            const dvec2 n = glm::normalize(dvec2(radius, p.y) - core({radius, p.y}));
            mesh.normals.back()[static_cast<size_t>(k)] =
                radius > 0 ? dvec3(p.x / radius * n.x, n.y, p.z / radius * n.x) : dvec3(0, n.y, 0);
        }
    }
    const Deviation given = compare(curvedBy(mesh, 30), ivec3(41), toFilleted);
    EXPECT_LT(given.most, 1e-3);
    EXPECT_EQ(given.wrongSide, 0);
}

TEST(Curve, OverlappingShellsAreCurvedToo) {
    // Two balls that cross: the union's distance outside, but for the seam, where pieces of 1/16
    // voxel are flat.
    const dvec3 a(15.3, 20.6, 20.1), b(25.9, 20.2, 19.7);
    const TriangleMesh mesh = curvedBy(
        mesh::joined(mesh::moved(mesh::icosphere(9, 3), a), mesh::moved(mesh::icosphere(9, 3), b)),
        30);
    const auto formula = [&](const dvec3& x) {
        return std::min(glm::distance(x, a), glm::distance(x, b)) - 9;
    };
    const dvec3 axis = glm::normalize(b - a), middle = 0.5 * (a + b);
    const Deviation found = compare(mesh, ivec3(41), formula, [&](const dvec3& x) {
        return formula(x) > -2 && std::abs(glm::dot(x - middle, axis)) > 3;
    });
    EXPECT_LT(found.most, 1e-4);
    EXPECT_EQ(found.wrongSide, 0);
}

TEST(Curve, BesideAnOverlapRimsAreRound) {
    // A cylinder with a ball in one end: its other rim is nowhere near what is cut.
    const TriangleMesh mesh = curvedBy(
        mesh::joined(
            mesh::moved(mesh::turned({{0, -11}, {13, -11}, {13, 11}, {0, 11}}, 13, false), kCentre),
            mesh::moved(mesh::icosphere(6, 2), kCentre + dvec3(0, 11, 0))),
        30, 0.5);
    const Deviation found =
        compare(mesh, ivec3(41), toCylinder, [](const dvec3& x) { return x.y < kCentre.y; });
    // Facets as coarse as half a voxel's sagitta, so that a gap at the rim would show (by 1e-3).
    EXPECT_LT(found.most, 2e-4);
    EXPECT_EQ(found.wrongSide, 0);
}

TEST(Curve, MeshesMayLieAnywhereAndVoxelsBeOfAnySize) {
    const double h = 0.013;
    const dvec3 low(700, -300, 41);
    TriangleMesh ball = mesh::icosphere(12.3 * h, 2);
    Params params;
    params.objects.push_back({"ball", {}, 0, mesh::moved(ball, low + 20.2 * h)});
    params.voxelSize = h;
    Stats stats;
    EXPECT_TRUE(curveObjects(params, stats).empty());
    EXPECT_GT(params.objects[0].mesh.triangles.size(), 2 * ball.triangles.size());
    const Lattice lattice = latticeAt(low, h, ivec3(40), 1);
    const volume::BrickGrid grid = signedDistances(params.objects[0].mesh, lattice, kBand);
    double most = 0;
    for (int i = 0; i < 40; ++i) {
        const dvec3 x = dvec3(i) + 0.5;
        const double wanted = glm::clamp(glm::distance(x, dvec3(20.2)) - 12.3, -kBand, kBand);
        most = std::max(most, std::abs(grid.at(ivec3(i)) / h - wanted));
    }
    EXPECT_LT(most, 5e-5);
}

} // namespace
} // namespace eikonal::voxelize
