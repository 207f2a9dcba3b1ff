// Which voxels receive light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

const ivec3 kSize(72, 24, 24);
const dvec3 kMiddle(12.5, 12, 11.5);
constexpr double kRadius = 5;

double distanceAt(const dvec3& p) {
    return glm::length(p - kMiddle) - kRadius;
}

/// A ball that is lit, blurred or sharp, with that value of a grid within.
volume::Volume ballWith(const std::string& grid, double value, bool sharp) {
    TestVolume made(kSize);
    made.constant("ior", 1);
    if (sharp) made.add("sdf", distanceAt, 1e3);
    made.add(grid, [=](dvec3 p) { return sharp || distanceAt(p) < 0 ? value : 0; });
    return made.take();
}

Lit lit(const volume::Volume& volume, bool automatic) {
    Params params = paramsOf({beam({0.3, -1, 0.2}, dvec3(1, 2, 3))}, 1 << 15);
    params.smoothing = 2;
    params.automaticOutputs = automatic;
    if (!automatic)
        params.outputs = makePlan(volume,
                                  [&] {
                                      Params same = params;
                                      same.automaticOutputs = true;
                                      return same;
                                  }())
                             .outputs;
    return Lit(volume, params);
}

} // namespace

TEST(LightReceiving, WhatPicturesLookUpIsTheSameAsIfAllVoxelsReceived) {
    for (const bool sharp : {false, true}) {
        SCOPED_TRACE(sharp ? "sharp" : "blurred");
        const volume::Volume volume = ballWith("scattering", 0.05, sharp);
        const Lit some = lit(volume, true), all = lit(volume, false);
        EXPECT_LT(some.plan.receiving.list.size(), all.plan.receiving.list.size());
        double most = 0;
        forEachVoxel(kSize, [&](ivec3 p) { most = std::max(most, all.fluence(p)); });
        forEachVoxel(kSize, [&](ivec3 p) {
            // Light is looked up between voxels.
            if (distanceAt(dvec3(p) + 0.5) > 1) return;
            // Fixed-point sums round by chance, each a little differently.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(some.fluence(p, c), all.fluence(p, c), 1e-4 * most);
        });
        // Smoothing takes no darkness from where nothing is received: rims gain or lose by
        // noise alone, which is 3 % of a voxel's light here, of hundreds.
        double sums[2] = {0, 0};
        forEachVoxel(kSize, [&](ivec3 p) {
            if (some.fluence(p) == 0) return;
            sums[0] += some.fluence(p);
            sums[1] += all.fluence(p);
        });
        EXPECT_NEAR(sums[0], sums[1], 0.01 * sums[1]);
        // Far off it is as dark as if nothing were there; light passes all the same.
        EXPECT_EQ(some.fluence({60, 12, 12}), 0);
        EXPECT_GT(all.fluence({60, 12, 12}), 0);
    }
}

TEST(LightReceiving, WhatSurroundsObjectsReceivesWhereItScatters) {
    TestVolume made(kSize);
    made.add("sdf", distanceAt, 1e3);
    made.constant("ior", 1);
    made.constant("scattering.medium", 0.02);
    const volume::Volume volume = made.take();
    const Lit some = lit(volume, true);
    EXPECT_EQ(some.plan.receiving.list.size(), some.plan.receiving.bricks.x *
                                                   some.plan.receiving.bricks.y *
                                                   some.plan.receiving.bricks.z);
    EXPECT_GT(some.fluence({60, 12, 12}), 0);
}

TEST(LightReceivingLong, MoreVoxelsThanAStorageBufferHolds) {
    // 4 bytes of each are 140 MiB; software devices allow 128 MiB in a buffer.
    const ivec3 size(332);
    TestVolume made(size);
    made.constant("ior", 1);
    Params params = paramsOf({beam({0, -1, 0})}, 1 << 12);
    params.outputs = Output::fluence;
    const Lit found(made.take(), params);
    // A beam of 1 W/m² has that fluence.
    const double voxels = static_cast<double>(found.plan.voxels());
    EXPECT_NEAR(found.total() / voxels, 1, 1e-3);
}

/// A small ball of no index of its own in a wide medium: photons are sent there, and all light is
/// as if it were not.
volume::Volume ballInMedium(const dvec3& absorption, double scattering) {
    TestVolume made(ivec3(40, 48, 44));
    made.add(
        "sdf", [](dvec3 p) { return glm::distance(p, dvec3(22, 20, 21)) - 4; }, 1e3);
    made.constant("ior", 1);
    for (const char* of : {"", ".medium"}) {
        made.constantVector(std::string("absorption") + of, absorption);
        made.constant(std::string("scattering") + of, scattering);
    }
    return made.take();
}

const dvec3 kLamp(23, 90, 18), kSun = glm::normalize(dvec3(0.3, -1, 0.2));

Light sunOrLamp(bool isLamp, const dvec3& rgb) {
    return isLamp ? lamp(kLamp, rgb) : beam(kSun, rgb);
}

/// The mean over a voxel of light of unit irradiance or intensity.
double byBeersLaw(const ivec3& p, double sigma, bool isLamp) {
    const dvec3 x = dvec3(p) + 0.5, way = isLamp ? x - kLamp : kSun, d = glm::normalize(way);
    double depth = (48 - x.y) / -d.y, across = -d.y;
    for (int axis : {0, 2}) {
        const double to = d[axis] > 0 ? x[axis] : x[axis] - (axis == 0 ? 40 : 44);
        if (to / d[axis] >= depth) continue;
        depth = to / d[axis];
        across = std::abs(d[axis]);
    }
    const double a = 0.5 * sigma / across;
    return std::exp(-sigma * depth) * (a > 0 ? std::sinh(a) / a : 1) /
           (isLamp ? glm::dot(way, way) : 1);
}

TEST(LightReceiving, WhatMeetsNothingIsByBeersLaw) {
    const dvec3 absorption(0.01, 0.02, 0.1), rgb(3, 2, 1);
    const double scattering = 0.01;
    const volume::Volume scene = ballInMedium(absorption, scattering);
    for (const bool isLamp : {false, true}) {
        const Lit lit(scene, paramsOf({sunOrLamp(isLamp, rgb)}, 1 << 15));
        EXPECT_LT(lit.counter("photons"), 0.5 * (1 << 15));
        EXPECT_GT(lit.counter("photons"), 100);
        for (const ivec3 p :
             {ivec3(3, 20, 40), ivec3(25, 25, 3), ivec3(36, 45, 30), ivec3(1, 9, 5)}) {
            for (int c = 0; c < 3; ++c) {
                const double wanted = rgb[c] * byBeersLaw(p, absorption[c] + scattering, isLamp);
                EXPECT_NEAR(lit.fluence(p, c), wanted, 2e-4 * wanted) << p.x << " " << c;
            }
            const dvec3 direction = isLamp ? glm::normalize(dvec3(p) + 0.5 - kLamp) : kSun;
            EXPECT_LT(glm::distance(lit.direction(p), direction), 1e-4);
        }
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(lit.stats.energy.absorbed[c] / lit.stats.energy.scattered[c],
                        absorption[static_cast<int>(c)] / scattering, 1e-3);
    }
}

TEST(LightReceiving, WhatMeetsNothingAndWhatPhotonsBringAreTheWhole) {
    const double sigma = 0.001, intensity = 5000;
    const volume::Volume scene = ballInMedium(dvec3(0), sigma);
    for (const bool isLamp : {false, true}) {
        Params params = paramsOf({sunOrLamp(isLamp, dvec3(isLamp ? intensity : 1))}, 1 << 20);
        params.smoothing = 1;
        const Lit lit(scene, params);
        EXPECT_LT(lit.counter("photons"), 0.3 * (1 << 20));
        EXPECT_GT(lit.counter("photons"), 1000);
        double off = 0, all = 0;
        forEachVoxel(ivec3(40, 48, 44), [&](ivec3 p) {
            const double wanted = (isLamp ? intensity : 1) * byBeersLaw(p, sigma, isLamp);
            EXPECT_NEAR(lit.fluence(p), wanted, 0.05 * wanted) << p.x << " " << p.y << " " << p.z;
            off += lit.fluence(p) - wanted;
            all += wanted;
        });
        EXPECT_NEAR(off, 0, 5e-4 * all);
    }
}
