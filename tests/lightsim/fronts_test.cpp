// Light by wavefronts: patches that advance in equal steps of time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

Params frontsOf(const std::vector<Light>& lights) {
    Params params = paramsOf(lights);
    params.method = Method::wavefront;
    params.photons = 0;
    return params;
}

/// A scene of one index that scatters nothing; both outputs are asked for.
TestVolume vacuum(const ivec3& size, double voxel = 1) {
    TestVolume scene(size, voxel);
    scene.constant("ior", 1);
    return scene;
}

} // namespace

TEST(LightFronts, VacuumHasTheIrradianceEverywhere) {
    const TestVolume scene = vacuum({12, 10, 14}, 0.5);
    for (const dvec3& along : {dvec3(0, 0, 1), dvec3(-1, 0, 0), dvec3(1, -2, 0.7)}) {
        Params params = frontsOf({beam(along, {3, 2, 1})});
        params.smoothing = 1;
        const Lit lit(scene.volume(), params);
        double worst = 0;
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            worst = std::max(worst, std::abs(lit.fluence(p) / 3 - 1));
        });
        std::printf("worst %g escaped %g entered %g steps %g patches %g\n", worst, lit.stats.energy.escaped[0], lit.stats.energy.entered[0], lit.counter("front_steps"), lit.counter("front_patches"));
        EXPECT_LT(worst, 0.02);
    }
}

TEST(LightFronts, APointLightFallsOffWithTheSquareOfTheDistance) {
    const TestVolume scene = vacuum(ivec3(24));
    for (const dvec3& place : {dvec3(12.2, 11.7, 12.4), dvec3(-9, 12, 12), dvec3(-5, -7, 30)}) {
        Params params = frontsOf({lamp(place)});
        const Lit lit(scene.volume(), params);
        double worst = 0, rms = 0, n = 0;
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            const dvec3 away = dvec3(p) + 0.5 - place;
            const double r2 = glm::dot(away, away);
            if (r2 < 16) return;
            const double e = lit.fluence(p) * r2 - 1;
            if (std::abs(e) > 0.12) std::printf("(%d %d %d: %.3f) ", p.x, p.y, p.z, e);
            worst = std::max(worst, std::abs(e)); rms += e * e; n += 1;
        });
        std::printf("worst %g rms %g escaped %g entered %g patches %g\n", worst, std::sqrt(rms / n), lit.stats.energy.escaped[0], lit.stats.energy.entered[0], lit.counter("front_patches"));
    }
}
