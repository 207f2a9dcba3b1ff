// A ball whose index varies inside and jumps at its rim: the ray equation between two refractions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

const dvec3 kCentre(31.63, 32.21, 31.87);
constexpr double kRadius = 26.3;

const std::vector<dvec3> kViews = {{0, 0, -1}, {1, 0.37, -0.21}};

/// n² = 2.25 (2 − r²/R²), 1.5 at its rim. Bars of the requirements: 0.02°, whichever the steps.
void expectLuneburgs(Integrator integrator, const dvec3& direction) {
    const judge::Glass glass{{judge::luneburgBall(kCentre, kRadius, 1.5)}};
    Params params = along(direction, kCentre, 2 * kRadius, {41, 41});
    params.integrator = integrator;
    params.background = dvec3(1);
    const Look look(volumeOf(glass), params);
    const auto within = [](const judge::Ray& ray) {
        return impactOf(ray, kCentre, kRadius) < 0.95;
    };
    const Off off = offOf(look, params, glass, within);
    EXPECT_GT(off.rays, 1000);
    EXPECT_LT(off.degrees, 0.02) << params.text() << ", worst at "
                                 << impactOf(off.worst, kCentre, kRadius);
    // 0.02° over the 60 voxels from rim to face, and as much for the way inside.
    EXPECT_LT(off.place, 0.04) << params.text();
    EXPECT_LT(off.optical, 0.1) << params.text(); // that by an index of up to 2.1
    EXPECT_LT(energyOff(look, params, glass, within), 1e-4) << params.text();
}

} // namespace

TEST(SharpGraded, ALuneburgLensByTheUsualSteps) {
    expectLuneburgs(Params().integrator, kViews[1]);
}

TEST(SharpGraded, ALuneburgLensOfDenserGlass) {
    for (const Integrator integrator :
         {Params().integrator, Integrator::sharma, Integrator::adaptive})
        for (const dvec3& direction : kViews) expectLuneburgs(integrator, direction);
}

TEST(SharpGraded, AnEyeInsideSeesTheSquareOfTheIndexThere) {
    const judge::Glass glass{{judge::luneburgBall(kCentre, kRadius, 1.5)}};
    const dvec3 d = glm::normalize(dvec3(1, 0.37, -0.21)), eye = kCentre + 3.0 * d;
    Params params = sharply(view::parallel(eye, eye + d, 20, {21, 21}));
    params.background = dvec3(1);
    const Look look(volumeOf(glass), params);
    const auto counts = [&](const judge::Ray& ray) { return tellable(glass, ray); };
    const Off off = offOf(look, params, glass, counts);
    EXPECT_GT(off.rays, 200);
    EXPECT_LT(off.degrees, 0.02);
    // n² at the eye is 4.4, read from voxels: a relative bar of 1e-4.
    EXPECT_LT(energyOff(look, params, glass, counts), 4.5e-4);
}
