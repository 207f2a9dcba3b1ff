// Domains of many voxels, whose tables are coarse and whose distances are packed: as exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/clearance.h"
#include "scene/distance_atlas.h"
#include "support/glass_volume.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

/// Every ray through a ball, up to 0.95 of its radius, is the judge's to the requirements' 0.01°.
void expectJudges(const ivec3& size, const dvec3& centre, double radius, bool packed) {
    const judge::Glass glass{{judge::glassBall(centre, radius, 1.5)}};
    Voxels voxels;
    voxels.size = size;
    voxels.halfWidth = 4;
    const dvec3 direction = glm::normalize(dvec3(0.3, -1, 0.2));
    Params params = along(direction, centre, 2 * radius, {41, 41});
    params.camera.eye = centre - (radius + 50) * direction;
    const Look look(volumeOf(glass, voxels), params);
    EXPECT_EQ(scene::isPacked(look.plan.scene.objects), packed);
    const Off off = offOf(look, params, glass, [&](const judge::Ray& ray) {
        return impactOf(ray, centre, radius) < 0.95;
    });
    EXPECT_GT(off.rays, 1000);
    EXPECT_LT(off.degrees, 0.01);
    EXPECT_LT(off.place, 0.02);
    EXPECT_LT(off.optical, 0.02);
}

} // namespace

TEST(SharpFine, TablesOfLongDomainsAreCoarse) {
    EXPECT_EQ(scene::tableEdge({256, 10, 10}), 1);
    EXPECT_EQ(scene::tableEdge({10, 257, 10}), 2);
    EXPECT_EQ(scene::tableEdge({10, 10, 513}), 4);
    EXPECT_EQ(scene::tableEdge({1024, 1024, 1024}), 4);
}

TEST(SharpFine, CoarseTablesLoseNoBoundary) {
    expectJudges({300, 44, 44}, {171.3, 21.8, 22.1}, 17.2, false);
    expectJudges({44, 44, 520}, {21.9, 22.3, 403.4}, 17.2, false);
}

TEST(SharpFine, PackedDistancesAreAsExact) {
    expectJudges(ivec3(304), {151.7, 152.2, 152.4}, 145, true);
}
