// One light simulation, its result at hand, its books checked.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/lightsim.h"
#include "support/test_volume.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace eikonal::lightsim {

/// What comes in must go out: entered = absorbed + scattered + escaped + lost, per channel. The
/// books are sums of floats of up to 2^20 photons, 2^10 to a sum, each rounded at every step to
/// 6e-8: 1e-4 leaves room for a thousand roundings the same way. Nothing enters that was not
/// emitted; as much room, since a point light's pixels cover 4π to fourth order in their size.
inline void expectClosed(const Energy& energy) {
    for (size_t c = 0; c < 3; ++c) {
        const double sum =
            energy.absorbed[c] + energy.scattered[c] + energy.escaped[c] + energy.lost[c];
        EXPECT_NEAR(sum, energy.entered[c], 1e-4 * energy.entered[c]) << "channel " << c;
        EXPECT_LE(energy.entered[c], energy.emitted[c] * (1 + 1e-4)) << "channel " << c;
    }
}

/// A run without smoothing unless asked for, of both outputs unless told otherwise.
inline Params paramsOf(const std::vector<Light>& lights, std::int64_t photons = 1 << 14) {
    Params params;
    params.lights = lights;
    params.photons = photons;
    params.smoothing = 0;
    params.automaticOutputs = false;
    return params;
}

inline Light beam(const glm::dvec3& direction, const glm::dvec3& rgb = glm::dvec3(1)) {
    return {Light::Kind::directional, glm::normalize(direction), rgb};
}

inline Light lamp(const glm::dvec3& place, const glm::dvec3& rgb = glm::dvec3(1)) {
    return {Light::Kind::point, place, rgb};
}

struct Lit {
    Lit(const volume::Volume& volume, const Params& params) {
        params.check();
        plan = makePlan(volume, params);
        result = simulate(device(), plan, params, stats, {});
        expectClosed(stats.energy);
    }

    double fluence(const glm::ivec3& p, int c = 0) const { return at(result.fluence, p, c); }
    glm::dvec3 direction(const glm::ivec3& p) const {
        return {at(result.direction, p, 0), at(result.direction, p, 1), at(result.direction, p, 2)};
    }
    double counter(const std::string& name) const {
        for (const auto& [known, value] : stats.counters)
            if (known == name) return value;
        return 0;
    }
    /// Sum of the fluence over the voxels [W/m²].
    double total(int c = 0) const {
        double sum = 0;
        forEachVoxel(plan.scene.size(), [&](glm::ivec3 p) { sum += fluence(p, c); });
        return sum;
    }

    Plan plan;
    Result result;
    Stats stats;
};

} // namespace eikonal::lightsim
