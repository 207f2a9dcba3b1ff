// Balls of glass from facets: rays go as through the ball, not as through the facets.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/device.h"
#include "support/glass_volume.h"
#include "support/shapes.h"
#include "voxelize/curve.h"
#include "voxelize/voxelize.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

// Of the 128 voxels along the domain's edge 8 are left at either end, as mesh2vol does by default.
constexpr int kVoxels = 128;
constexpr double kRadius = 56;
const dvec3 kCentre(64.21, 63.83, 64.09);

volume::Volume volumeOf(const mesh::TriangleMesh& mesh, double degrees) {
    voxelize::Params params;
    params.objects.push_back({"ball", {.ior = 1.5}, 0, mesh});
    params.bounds = mesh::Box{dvec3(0), dvec3(kVoxels)};
    params.resolution = kVoxels;
    params.smooth = degrees;
    Stats stats;
    EXPECT_TRUE(voxelize::curveObjects(params, stats).empty());
    return voxelize::voxelize(device(), params, voxelize::makePlan(params), stats).volume;
}

/// How far rays up to 0.95 of the ball's radius are off the judge's at the most [degree].
double turnOff(const mesh::TriangleMesh& mesh, double degrees) {
    const judge::Glass glass{{judge::glassBall(kCentre, kRadius, 1.5)}};
    const Params params = along({0.3, -1, 0.21}, kCentre, 2 * kRadius, {61, 61});
    const Look look(volumeOf(mesh, degrees), params);
    const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
        return impactOf(ray, kCentre, kRadius) < 0.95;
    });
    EXPECT_GT(off.rays, 2500);
    return off.degrees;
}

} // namespace

TEST(SharpMesh, ABallOfFacetsRefractsAsTheBall) {
    const mesh::TriangleMesh mesh = mesh::moved(mesh::icosphere(kRadius, 5), kCentre);
    ASSERT_EQ(mesh.triangles.size(), 20480u);
    // Required are 0.05°; the ball's own distances, by the formula, are followed to 1e-4.
    EXPECT_LT(turnOff(mesh, 30), 1e-3);
    // Its facets are a hundredth of a voxel off, and turn rays by 0.95°.
    EXPECT_GT(turnOff(mesh, 0), 0.5);
}

TEST(SharpMesh, SoDoesACoarseOne) {
    const mesh::TriangleMesh mesh = mesh::moved(mesh::icosphere(kRadius, 3), kCentre);
    ASSERT_EQ(mesh.triangles.size(), 1280u);
    EXPECT_LT(turnOff(mesh, 30), 0.01);
}
