// Photons and beams through crystals.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "judge/varying_crystal.h"
#include "support/crystal_volume.h"
#include "support/lit.h"

#include <array>
#include <optional>

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kO = 1.6584, kE = 1.4864;
const dvec3 kLow(4, 12, 4), kHigh(44, 32, 44);
constexpr double kWall = 6.3, kFar = 2e4, kDisc = 10;

volume::Volume boxOverWall(const dvec3& axis, double sigmaO = 0, double sigmaE = 0) {
    return crystalVolume(ivec3(48, 40, 48),
                         {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, kO,
                           crystalOf(kE, axis, sigmaE), sigmaO},
                          {"wall", [](dvec3 p) { return p.y - kWall; }, 1, {}, 0, 0}});
}

Params onWall(std::int64_t photons) {
    // A disc of 20 voxels of light that is nearly parallel, of irradiance 1, far from the box's
    // edges, which splines round.
    Light light = lamp({24, kFar, 24}, dvec3(kFar * kFar));
    light.kind = Light::Kind::spot;
    light.axis = {0, -1, 0};
    light.angle = std::atan(kDisc / kFar) * 180 / 3.141592653589793;
    Params params = paramsOf({light}, photons);
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
        if (x.x < low || x.x > high || x.z < 22 || x.z > 26 || x.y < 3)
            continue; // not where the wall is cut open
        sum += static_cast<double>(grid.values[i].x);
        ++found;
    }
    EXPECT_GT(found, 0);
    return sum / found;
}

/// What a plate of index n lets through, by as many ways as it takes.
double through(double n, double sigma = 0) {
    const double R = std::pow((n - 1) / (n + 1), 2), a = std::exp(-20 * sigma);
    return (1 - R) * (1 - R) * a / (1 - R * R * a * a);
}

TEST(CrystalLight, EachModeLandsInAPlaceOfItsOwn) {
    // The axis at 45° to the light: e-rays land 2.18 voxels aside, so that two discs of half the
    // light lie beside each other.
    const double e = std::sqrt(2 / (1 / (kO * kO) + 1 / (kE * kE)));
    for (const auto& [side, method] :
         {std::pair(1, Method::photons), std::pair(-1, Method::photons),
          std::pair(1, Method::beams)}) {
        Params params = onWall(method == Method::photons ? 1 << 20 : 1 << 16);
        params.method = method;
        const Lit lit(boxOverWall({static_cast<double>(side), 1, 0}), params);
        EXPECT_EQ(lit.plan.beams, method == Method::beams);
        const volume::FineGrid& grid = lit.result.irradiance;
        // Photons by some hundred a voxel.
        EXPECT_NEAR(meanBetween(grid, 19, 29), 0.5 * (through(kO) + through(e)), 0.01);
        const double left = meanBetween(grid, 12.2, 13.7), right = meanBetween(grid, 34.3, 35.7);
        const double leftWithin = meanBetween(grid, 15, 16),
                     rightWithin = meanBetween(grid, 32, 33);
        // Beyond the o-rays' disc the e-rays' alone, on the other side the o-rays' alone.
        const bool onRight = right > left;
        EXPECT_EQ(onRight, side > 0);
        EXPECT_NEAR(onRight ? right : left, 0.5 * through(e), 0.03);
        EXPECT_NEAR(onRight ? left : right, 0, 0.03);
        EXPECT_NEAR(onRight ? leftWithin : rightWithin, 0.5 * through(kO), 0.03);
    }
}

TEST(CrystalLight, ABallOfCalciteHasTwoCaustics) {
    const dvec3 centre(24.3, 24.2, 23.8), axis(1, 1, 0);
    constexpr double kRadius = 12;
    constexpr int kCells = 16; // of 2 by 2 voxels, about the middle
    using Cells = std::array<double, kCells * kCells>;
    const auto cellAt = [](double x, double z) -> std::optional<size_t> {
        const int i = static_cast<int>(std::floor(x / 2)) - 4;
        const int j = static_cast<int>(std::floor(z / 2)) - 4;
        if (std::min(i, j) < 0 || std::max(i, j) >= kCells) return std::nullopt;
        return static_cast<size_t>(kCells * j + i);
    };
    Cells expected{};
    const auto land = [&](const dvec3& at, double power) {
        if (const auto cell = cellAt(at.x, at.z)) expected[*cell] += power / 4;
    };
    constexpr double kStep = 0.1;
    for (double z = 0.5 * kStep; z < 48; z += kStep)
        for (double x = 0.5 * kStep; x < 48; x += kStep)
            if (glm::length(glm::dvec2(x - centre.x, z - centre.z)) >= kRadius)
                land({x, 0, z}, kStep * kStep);
    // The judge's rays straight down, on rings about the ball's axis, and evenly between them. What
    // is reflected within is left out.
    constexpr int kRings = 16, kSpokes = 32, kParts = 12;
    constexpr double kRing = 1.570796 / kRings, kSpoke = 6.283185307179586 / kSpokes;
    struct Landed {
        dvec3 at{0};
        double share = 0;
    };
    std::array<std::vector<Landed>, 2> modes; // o and e
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j <= kSpokes; ++j) {
            const double r = kRadius * std::sin(kRing * i), phi = kSpoke * j;
            const dvec3 from = centre + dvec3(r * std::cos(phi), 20, r * std::sin(phi));
            for (auto& mode : modes) mode.emplace_back();
            for (const judge::LeftBall& ray :
                 judge::throughBall({kO, kE, axis}, centre, kRadius, from, {0, -1, 0}, 2)) {
                if (ray.course != "o" && ray.course != "e") continue;
                const double way = (kWall - ray.x.y) / ray.direction.y;
                Landed& landed = modes[ray.course == "e"].back();
                landed.at = ray.x + way * ray.direction;
                landed.share += ray.power; // of both polarisations that arrive
            }
        }
    for (const auto& mode : modes)
        for (int i = 0; i < kRings * kParts; ++i)
            for (int j = 0; j < kSpokes * kParts; ++j) {
                const double u = (i + 0.5) / kParts, v = (j + 0.5) / kParts;
                const auto at = [&](int k, int l) -> const Landed& {
                    return mode[static_cast<size_t>((kSpokes + 1) * (i / kParts + k) + j / kParts +
                                                    l)];
                };
                const double s = u - std::floor(u), t = v - std::floor(v);
                dvec3 x(0);
                double share = 0;
                for (int k = 0; k < 2; ++k)
                    for (int l = 0; l < 2; ++l) {
                        const double weight = (k == 1 ? s : 1 - s) * (l == 1 ? t : 1 - t);
                        x += weight * at(k, l).at;
                        share += weight * at(k, l).share;
                    }
                const double angle = kRing * u;
                land(x, share * kRadius * kRadius * std::sin(angle) * std::cos(angle) * kRing *
                            kSpoke / (kParts * kParts));
            }
    const auto apart = [](const Cells& a, const Cells& b) {
        double difference = 0, sum = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            difference += std::abs(a[i] - b[i]);
            sum += b[i];
        }
        return difference / sum;
    };
    const volume::Volume volume = crystalVolume(
        ivec3(48), {{"ball", [&](dvec3 p) { return glm::length(p - centre) - kRadius; }, kO,
                     crystalOf(kE, axis)},
                    {"wall", [](dvec3 p) { return p.y - kWall; }, 1, {}, 0, 0}});
    for (const Method method : {Method::photons, Method::beams}) {
        Params params = paramsOf({parseLight("directional:0,-1,0:1")},
                                 method == Method::photons ? 1 << 20 : 1 << 18);
        params.outputs = Output::irradiance;
        params.surfaceDetail = 1;
        params.method = method;
        const Lit lit(volume, params);
        Cells found{};
        const volume::FineGrid& grid = lit.result.irradiance;
        for (size_t i = 0; i < grid.voxels.size(); ++i) {
            const dvec3 x = dvec3(grid.voxels[i]) + 0.5;
            if (x.y < 3) continue; // where the wall is cut open
            if (const auto at = cellAt(x.x, x.z))
                found[*at] += static_cast<double>(grid.values[i].x) / 4;
        }
        EXPECT_LT(apart(found, expected), 0.03) << (method == Method::beams);
    }
}

TEST(CrystalLight, ModesAreAbsorbedByTheirOwn) {
    // Cut along its axis: plates of n_o and n_e.
    for (const Method method : {Method::photons, Method::beams}) {
        Params params = onWall(method == Method::photons ? 1 << 20 : 1 << 16);
        params.method = method;
        const Lit lit(boxOverWall({1, 0, 0}, 0.05, 0.01), params);
        EXPECT_NEAR(meanBetween(lit.result.irradiance, 19, 29),
                    0.5 * (through(kO, 0.05) + through(kE, 0.01)), 0.01);
    }
}

TEST(CrystalLight, RaysTurnWhereTheAxisDoes) {
    // Half of the light straight on, half where the judge's e-ray of the light's middle lands.
    const auto at = [](const dvec3& x) {
        const double a = (0.2 + 0.9 * (x.y - 12) / 20);
        return judge::Tensor{kO, kE + 0.002 * (x.z - 24), {std::sin(a), std::cos(a), 0.3}};
    };
    const ivec3 size(48, 40, 48);
    volume::Volume volume = boxOverWall({0, 1, 0});
    putField(volume, "axis.box", size, 3, [&](dvec3 x) { return glm::normalize(at(x).axis); });
    putField(volume, "ior_extraordinary.box", size, 1, [&](dvec3 x) { return dvec3(at(x).e); });
    const dvec3 entry(24, kHigh.y, 24);
    dvec3 landed(0);
    double shares[2] = {0, 0}; // of o and e, but for what is reflected within
    for (const dvec3& field : {dvec3(1, 0, 0), dvec3(0, 0, 1)})
        for (const judge::LightWave& w : judge::scattered(
                 judge::isotropicWave(1, {0, -1, 0}, field), {0, -1, 0}, {}, at(entry))) {
            if (!w.beyond) continue;
            const judge::CrystalRay end = judge::throughCrystal(
                at, w.mode, entry, w.k, [](const dvec3& x) { return kLow.y - x.y; }, 0.1);
            const judge::LightWave wave =
                judge::crystalWave(at(end.x), w.mode, glm::normalize(end.k));
            for (const judge::LightWave& out : judge::scattered(wave, {0, -1, 0}, at(end.x), {})) {
                if (!out.beyond) continue;
                shares[w.mode == 'e'] += 0.5 * w.power * out.power;
                if (w.mode == 'e') landed = end.x + (kWall - kLow.y) / out.ray.y * out.ray;
            }
        }
    ASSERT_GT(std::abs(landed.x - 24),
              0.5); // which no straight way tells: both ends' walk-offs differ
    const dvec3 expected = (shares[0] * entry + shares[1] * landed) / (shares[0] + shares[1]);
    for (const Method method : {Method::photons, Method::beams}) {
        Params params = onWall(method == Method::photons ? 1 << 17 : 1 << 13);
        params.method = method;
        const Lit lit(volume, params);
        dvec3 middle(0);
        double sum = 0;
        const volume::FineGrid& grid = lit.result.irradiance;
        for (size_t i = 0; i < grid.voxels.size(); ++i) {
            const dvec3 x = dvec3(grid.voxels[i]) + 0.5;
            if (x.y < 3 || glm::length(glm::dvec2(x.x - 24, x.z - 24)) > 18) continue;
            middle += static_cast<double>(grid.values[i].x) * x;
            sum += static_cast<double>(grid.values[i].x);
        }
        middle /= sum;
        // Beside these, what is reflected within and lands further aside, a four-hundredth.
        EXPECT_NEAR(middle.x, expected.x, 0.02);
        EXPECT_NEAR(middle.z, expected.z, 0.02);
    }
}

TEST(CrystalLight, APolariserLetsOneImageThrough) {
    // The axis in the plane of x and y: E along x is the e-wave's, along z the o-wave's.
    const double e = std::sqrt(2 / (1 / (kO * kO) + 1 / (kE * kE)));
    for (const Method method : {Method::photons, Method::beams})
        for (const dvec3& along : {dvec3(1, 0, 0), dvec3(0, 0, 1)}) {
            Params params = onWall(method == Method::photons ? 1 << 18 : 1 << 14);
            params.method = method;
            params.lights[0].polarizer = along;
            const Lit lit(boxOverWall({1, 1, 0}), params);
            const volume::FineGrid& grid = lit.result.irradiance;
            const bool extraordinary = along.x == 1;
            EXPECT_NEAR(meanBetween(grid, 19, 29), through(extraordinary ? e : kO), 0.02);
            // Each is alone where the other's disc is not.
            const double left = meanBetween(grid, 12.2, 13.7),
                         right = meanBetween(grid, 34.3, 35.7);
            EXPECT_NEAR(std::min(left, right), 0, 0.02);
            EXPECT_NEAR(std::max(left, right), extraordinary ? through(e) : 0.0, 0.05);
        }
}

TEST(CrystalLight, ADichroicPlateFollowsMalus) {
    const double sigma = 0.5; // of the o-wave, which is all gone then
    for (const Method method : {Method::photons, Method::beams})
        for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
            Params params = onWall(method == Method::photons ? 1 << 17 : 1 << 14);
            params.method = method;
            const double angle = degrees * 3.141592653589793 / 180;
            params.lights[0].polarizer = {std::cos(angle), 0.4, std::sin(angle)};
            const Lit lit(boxOverWall({1, 0, 0}, sigma, 0), params);
            EXPECT_NEAR(meanBetween(lit.result.irradiance, 19, 29),
                        std::pow(std::cos(angle), 2) * through(kE), 0.01)
                << degrees;
        }
}

TEST(CrystalLight, GlassAtBrewstersAngleReflectsOnePolarisation) {
    const double n = 1.5, cosine = 1 / std::sqrt(1 + n * n);
    const volume::Volume volume = crystalVolume(
        ivec3(48, 24, 48), {{"box",
                             [](dvec3 p) {
                                 return boxDistance(p, {4, 9, 4}, {44, 15, 44});
                             },
                             n},
                            {"wall", [](dvec3 p) { return p.y - kWall; }, 1, {}, 0, 0}});
    const double Rs = std::pow((n * n - 1) / (n * n + 1), 2);
    for (const Method method : {Method::photons, Method::beams})
        for (const char* along : {"0,1,0", "0,0,1"}) {
            Params params =
                paramsOf({parseLight(std::string("directional:1.5,-1,0:2:polarizer=") + along)},
                         method == Method::photons ? 1 << 20 : 1 << 15);
            params.outputs = Output::irradiance;
            params.surfaceDetail = 1;
            params.method = method;
            const Lit lit(volume, params);
            EXPECT_NEAR(meanBetween(lit.result.irradiance, 22, 34) / cosine,
                        along[2] == '1' ? 1 : (1 - Rs) / (1 + Rs), 0.01)
                << along << (method == Method::beams);
        }
}

TEST(CrystalLight, WhatIsNotTracedIsRefused) {
    Params params = onWall(1 << 10);
    params.method = Method::wavefront;
    EXPECT_THROW(makePlan(boxOverWall({1, 1, 0}), params), UsageError);
    params.lights[0].polarizer = {0, 0, 1};
    const volume::Volume glass =
        crystalVolume(ivec3(24), {{"ball", [](dvec3 p) { return glm::length(p - 12.0) - 8; }, 1.5},
                                  {"wall", [](dvec3 p) { return p.y - 3; }, 1, {}, 0, 0.5}});
    EXPECT_THROW(makePlan(glass, params), UsageError);
    params = paramsOf({lamp({24, 20, 24})});
    EXPECT_THROW(makePlan(boxOverWall({1, 1, 0}), params), DataError);
}

} // namespace
} // namespace eikonal::lightsim
