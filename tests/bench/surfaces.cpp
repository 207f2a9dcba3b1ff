// Light on floors: what beams and photons cost and how near they come to what is exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"
#include "floors.h"

namespace bench {

using namespace eikonal;

namespace {

/// A row of the table.
Json measure(gpu::Device& device, const Case& scene, const std::string& name,
             lightsim::Method method, int powerOfTwo) {
    lightsim::Params params;
    params.method = method;
    params.lights.push_back(scene.light);
    params.photons = std::int64_t{1} << powerOfTwo;
    params.surfaceDetail = kDetail;
    const lightsim::Plan plan = lightsim::makePlan(scene.volume, params);
    Stats stats;
    const auto result = lightsim::simulate(device, plan, params, stats, {});
    const FloorError off = errorOf(scene, result.irradiance);
    double milliseconds = 0;
    for (const auto& pass : stats.passes) milliseconds += pass.cpuMs;
    return {{"under", scene.name},
            {"method", name},
            {"photons_log2", powerOfTwo},
            {"passes_ms", milliseconds},
            {"error_percent", 100 * off.error},
            {"energy_percent", 100 * off.energy},
            {"device_mb", static_cast<double>(stats.gpuPeakBytes) / 1e6}};
}

} // namespace

Json measureSurfaces(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    Json rows = Json::array();
    const auto measureAll = [&](const Case& scene) {
        measure(device, scene, "warm-up", lightsim::Method::beams, 12);
        for (int power : {14, 16, 18, 20})
            rows.push_back(measure(device, scene, "beams", lightsim::Method::beams, power));
        for (int power : {18, 20, 22, 24})
            rows.push_back(measure(device, scene, "photons", lightsim::Method::photons, power));
    };
    measureAll(ballOverFloor());
    measureAll(waterOverFloor(false));
    measureAll(waterOverFloor(true));
    return rows;
}

} // namespace bench
