// Light on surfaces: what beams and photons cost and how near they come to exact rays.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "judge/caustic.h"
#include "lightsim/lightsim.h"
#include "support/glass_volume.h"

#include <cmath>

namespace bench {

using namespace eikonal;

namespace {

// A ball of radius ½ over a floor at −¾, 64 voxels to a unit; the floor's [−1, 1]² by fine voxels.
constexpr int kUnit = 64, kDetail = 4, kTexels = 2 * kUnit * kDetail;

volume::Volume ballOverFloor() {
    const judge::Glass glass{{judge::glassBall({80, 52, 80}, 32, 1.5),
                              judge::glassBox(glm::dvec3(-20), {180, 4, 180}, 1)}};
    sharp::Voxels voxels;
    voxels.size = {160, 88, 160};
    voxels.halfWidth = 4;
    volume::Volume volume = sharp::volumeOf(glass, voxels);
    volume.putConstant("opacity.S1", glm::vec3(1));
    return volume;
}

/// Of the floor's upper side.
std::vector<double> texelsOf(const volume::FineGrid& grid) {
    std::vector<double> found(static_cast<size_t>(kTexels) * kTexels);
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const glm::ivec3 p = grid.voxels[i] - glm::ivec3(16, 0, 16) * kDetail;
        // The floor lies between two layers, which tell the same.
        if (p.y != 4 * kDetail || std::min(p.x, p.z) < 0 || std::max(p.x, p.z) >= kTexels) continue;
        found[static_cast<size_t>(p.z) * kTexels + static_cast<size_t>(p.x)] = grid.values[i].x;
    }
    return found;
}

} // namespace

Json measureSurfaces(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    const volume::Volume volume = ballOverFloor();
    judge::BallOverPlane scene;
    scene.texels = kTexels;
    const std::vector<double> exact = judge::irradianceUnder(scene, 40000);
    double mean = 0;
    for (double value : exact) mean += value / static_cast<double>(exact.size());
    Json rows = Json::array();
    const auto row = [&](const std::string& name, lightsim::Method method, int powerOfTwo) {
        lightsim::Params params;
        params.method = method;
        params.lights.push_back(lightsim::parseLight("directional:-0.3,-1,-0.2"));
        params.photons = std::int64_t{1} << powerOfTwo;
        params.surfaceDetail = kDetail;
        const lightsim::Plan plan = lightsim::makePlan(volume, params);
        Stats stats;
        const auto result = lightsim::simulate(device, plan, params, stats, {});
        const std::vector<double> found = texelsOf(result.irradiance);
        double squares = 0, sum = 0, milliseconds = 0;
        for (size_t i = 0; i < exact.size(); ++i) {
            squares += (found[i] - exact[i]) * (found[i] - exact[i]) /
                       (exact[i] * exact[i] + 0.01 * mean * mean);
            sum += found[i];
        }
        for (const auto& pass : stats.passes) milliseconds += pass.cpuMs;
        const auto texels = static_cast<double>(exact.size());
        rows.push_back({{"method", name},
                        {"photons_log2", powerOfTwo},
                        {"passes_ms", milliseconds},
                        {"error_percent", 100 * std::sqrt(squares / texels)},
                        {"energy_percent", 100 * (sum / texels / mean - 1)},
                        {"device_mb", static_cast<double>(stats.gpuPeakBytes) / 1e6}});
    };
    row("warm-up", lightsim::Method::beams, 12);
    rows.erase(0);
    for (int power : {14, 16, 18, 20}) row("beams", lightsim::Method::beams, power);
    for (int power : {16, 18, 20, 22, 24}) row("photons", lightsim::Method::photons, power);
    return rows;
}

} // namespace bench
