// Photons and beams through crystals.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "support/crystal_volume.h"
#include "support/lit.h"

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kO = 1.6584, kE = 1.4864;
const dvec3 kLow(4, 12, 4), kHigh(44, 32, 44);
constexpr double kWall = 6;

volume::Volume boxOverWall(const dvec3& axis, double sigmaO = 0, double sigmaE = 0) {
    return crystalVolume(ivec3(48, 40, 48),
                         {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, kO,
                           crystalOf(kE, axis, sigmaE), sigmaO},
                          {"wall", [](dvec3 p) { return p.y - kWall; }, 1, {}, 0, 0}});
}

Params onWall(std::int64_t photons) {
    Params params = paramsOf({beam({0, -1, 0})}, photons);
    params.outputs = Output::irradiance;
    params.surfaceDetail = 1;
    return params;
}

/// The mean over voxels whose middles are between two places along x, far from the box's other
/// sides.
double meanBetween(const volume::FineGrid& grid, double low, double high) {
    double sum = 0;
    int found = 0;
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const dvec3 x = dvec3(grid.voxels[i]) + 0.5;
        if (x.x < low || x.x > high || x.z < 14 || x.z > 34) continue;
        sum += static_cast<double>(grid.values[i].x);
        ++found;
    }
    EXPECT_GT(found, 10);
    return sum / found;
}

/// What a plate of index n lets through, by as many ways as it takes.
double through(double n, double sigma = 0) {
    const double R = std::pow((n - 1) / (n + 1), 2), a = std::exp(-20 * sigma);
    return (1 - R) * (1 - R) * a / (1 - R * R * a * a);
}

TEST(CrystalLight, EachModeLandsInAPlaceOfItsOwn) {
    // The axis at 45° to the light: e-rays land 2.18 voxels aside, so that along one edge of the
    // box's shadow o-rays alone light a strip of the wall.
    const double e = std::sqrt(2 / (1 / (kO * kO) + 1 / (kE * kE)));
    for (const auto& [side, method] :
         {std::pair(1, Method::photons), std::pair(-1, Method::photons),
          std::pair(1, Method::beams)}) {
        Params params = onWall(method == Method::photons ? 1 << 20 : 1 << 16);
        params.method = method;
        const Lit lit(boxOverWall({static_cast<double>(side), 1, 0}), params);
        EXPECT_EQ(lit.plan.beams, method == Method::beams);
        const volume::FineGrid& grid = lit.result.irradiance;
        // A percent: photons by 60 a voxel, over hundreds of voxels.
        EXPECT_NEAR(meanBetween(grid, 14, 34), 0.5 * (through(kO) + through(e)), 0.01);
        const double left = meanBetween(grid, 4.9, 5.6), right = meanBetween(grid, 42.4, 43.1);
        const double strip = side > 0 ? left : right, other = side > 0 ? right : left;
        EXPECT_LT(std::min(strip, other), 0.5 * through(kO) + 0.06);
        EXPECT_GT(std::max(strip, other), 0.5 * through(kO) + 0.2);
    }
}

TEST(CrystalLight, ModesAreAbsorbedByTheirOwn) {
    // Cut along its axis: plates of n_o and n_e.
    for (const Method method : {Method::photons, Method::beams}) {
        Params params = onWall(method == Method::photons ? 1 << 20 : 1 << 16);
        params.method = method;
        const Lit lit(boxOverWall({1, 0, 0}, 0.05, 0.01), params);
        EXPECT_NEAR(meanBetween(lit.result.irradiance, 14, 34),
                    0.5 * (through(kO, 0.05) + through(kE, 0.01)), 0.01);
    }
}

TEST(CrystalLight, WhatIsNotTracedIsRefused) {
    Params params = onWall(1 << 10);
    params.method = Method::wavefront;
    EXPECT_THROW(makePlan(boxOverWall({1, 1, 0}), params), UsageError);
    params = paramsOf({lamp({24, 20, 24})});
    EXPECT_THROW(makePlan(boxOverWall({1, 1, 0}), params), DataError);
}

} // namespace
} // namespace eikonal::lightsim
