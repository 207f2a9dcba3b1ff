// A mean cosine of scattering that varies from place to place, by what is scattered once.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stage.h"

using namespace eikonal;
using namespace eikonal::embedded;

namespace {

class VaryingG : public Embedded {};
INSTANTIATE_TEST_SUITE_P(Embedded, VaryingG, testing::Values(Boundary::sharp, Boundary::blurred),
                         nameOf);

const dvec3 kScattering(0.5, 1.1, 0.2), kAbsorption(0.3, 0.1, 1.2), kSun(3, 2, 1);
constexpr double kSide = 24 * kVoxel;                        // of the domain [unit]
constexpr double kLow = 4.3 * kVoxel, kHigh = 19.6 * kVoxel; // of the layer

/// From -0.6 to 0.8 within the domain, along x and z.
double meanCosine(const dvec3& p) {
    return -0.6 + (p.x + 0.4 * p.z) / kSide;
}

double henyeyGreenstein(double g, double cosine) {
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// The medium fills the domain, or within sharp boundaries a layer of it, whose index is that of
/// what surrounds it. At the domain's sides it is cut open: beside a lit space light in voxels at
/// its side would be mixed with that.
volume::Volume litMedium(Boundary boundary) {
    TestVolume scene(glm::ivec3(24), kVoxel);
    scene.constant("ior", 1);
    if (boundary == Boundary::sharp)
        scene.add(
            "sdf", [](dvec3 p) { return std::max(kLow - p.y, p.y - kHigh); }, 1e3);
    scene.constantVector("scattering", kScattering);
    scene.constantVector("absorption", kAbsorption);
    scene.add("anisotropy", meanCosine);
    volume::Volume volume = scene.take();
    light(volume, boundary, {sunAlong({0, -1, 0}, kSun)});
    return volume;
}

/// The sun's light that is scattered once towards the eye, by the midpoint rule.
dvec3 scatteredOnce(const dvec3& eye, const dvec3& sight, const dvec3& low, const dvec3& high) {
    double enter = 0, leave = 1e9;
    for (int c = 0; c < 3; ++c) {
        if (sight[c] == 0) continue;
        const double a = (low[c] - eye[c]) / sight[c], b = (high[c] - eye[c]) / sight[c];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    const dvec3 extinction = kScattering + kAbsorption;
    const int parts = 1000;
    const double part = (leave - enter) / parts;
    dvec3 sum(0);
    for (int i = 0; i < parts; ++i) {
        const double s = (i + 0.5) * part;
        const dvec3 p = eye + (enter + s) * sight;
        // Light travels downwards; to the eye it goes on against the sight.
        const double phase = henyeyGreenstein(meanCosine(p), sight.y);
        sum += part * phase * kScattering * kSun * glm::exp(-extinction * (high.y - p.y + s));
    }
    return sum;
}

} // namespace

TEST_P(VaryingG, IsSeenInSingleScattering) {
    const Boundary boundary = GetParam();
    const bool sharp = boundary == Boundary::sharp;
    const volume::Volume volume = litMedium(boundary);
    const dvec3 low(0, sharp ? kLow : 0, 0), high(kSide, sharp ? kHigh : kSide, kSide);
    // Scattered at 90°, 135° and 45°, and along rows of varying g. Light is stored by voxels, which
    // a sharp boundary cuts: half of one of some fifteen, by its change over a voxel.
    for (const dvec3& towards : {dvec3(0, 0, -1), dvec3(0, -1, -1), dvec3(0, 1, -1),
                                 dvec3(-1, 0, 0), dvec3(-1, 0.3, 0.2)}) {
        const dvec3 sight = glm::normalize(towards), middle(0.5 * kSide);
        const view::Params params = viewAlong(boundary, sight, middle, 0.8, {9, 9});
        const view::Look look(scene::Files(volume), params);
        forEachPixel(params, [&](int x, int y) {
            const dvec3 wanted = scatteredOnce(originOf(params, x, y), sight, low, high);
            expectColour(look, x, y, wanted, dvec3(sharp ? 0.01 : 4e-3));
        });
    }
}
