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

} // namespace

TEST(SharpMesh, ABallOfFacetsRefractsAsTheBall) {
    const mesh::TriangleMesh mesh = mesh::moved(mesh::icosphere(kRadius, 5), kCentre);
    EXPECT_EQ(mesh.triangles.size(), 20480u);
    const judge::Glass glass{{judge::glassBall(kCentre, kRadius, 1.5)}};
    const Params params = along({0.3, -1, 0.21}, kCentre, 2 * kRadius, {61, 61});
    for (double degrees : {0.0, 30.0}) {
    const Look look(volumeOf(mesh, degrees), params);
    for (const auto& [from, to] : {std::pair(0.0, 0.5), {0.5, 0.8}, {0.8, 0.95},{0.95,0.99}}) {
        const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
            const double impact = impactOf(ray, kCentre, kRadius);
            return impact > from && impact <= to;
        });
        printf("smooth %g impact to %g: %.5f deg, %d rays\n", degrees, to, off.degrees, off.rays);
    }
    }
    const Look look(sharp::volumeOf(glass, {.size=ivec3(128),.halfWidth=6}), params);
    for (const auto& [from, to] : {std::pair(0.0, 0.5), {0.5, 0.8}, {0.8, 0.95},{0.95,0.99}}) {
        const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
            const double impact = impactOf(ray, kCentre, kRadius);
            return impact > from && impact <= to;
        });
        printf("formula impact to %g: %.5f deg, %d rays\n", to, off.degrees, off.rays);
    }
}
