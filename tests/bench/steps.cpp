// What the photons' steps cost and give: the octree's knobs against quarter-voxel steps everywhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "lightsim/lightsim.h"

#include <cmath>

namespace bench {

using namespace eikonal;

Json measureSteps(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    const volume::Volume volume = ballVolume(64, true);
    lightsim::Params fine;
    fine.lights.push_back(lightsim::parseLight("directional:0.2,-1,0.1"));
    fine.photons = 1 << 18;
    fine.octreeTolerance = fine.octreeTolerance2 = 0;
    fine.stepMin = 0.25;
    std::vector<float> reference;
    Json rows = Json::array();
    const auto row = [&](const std::string& name, lightsim::Params params) {
        const lightsim::Plan plan = lightsim::makePlan(volume, params);
        Stats stats;
        const auto result = lightsim::simulate(device, plan, params, stats, {});
        const std::vector<float>& fluence = result.fluence.values;
        if (reference.empty()) reference = fluence;
        double difference = 0, sum = 0, steps = 0;
        for (size_t i = 0; i < fluence.size(); ++i) {
            const double error =
                static_cast<double>(fluence[i]) - static_cast<double>(reference[i]);
            difference += error * error;
            sum += static_cast<double>(reference[i]) * static_cast<double>(reference[i]);
        }
        for (const auto& [counter, value] : stats.counters)
            if (counter == "steps") steps = value;
        rows.push_back({{"options", name},
                        {"million_steps", steps / 1e6},
                        {"difference_percent", 100 * std::sqrt(difference / sum)}});
    };
    row("quarter-voxel steps", fine);
    lightsim::Params other = fine;
    other.seed = 1;
    row("the same, another seed", other);
    lightsim::Params usual = fine;
    usual.octreeTolerance = 0.005;
    usual.octreeTolerance2 = 0.02;
    usual.stepMin = 1;
    const auto varied = [&](double tolerance, double second, double stepMin) {
        lightsim::Params params = usual;
        params.octreeTolerance = tolerance;
        params.octreeTolerance2 = second;
        params.stepMin = stepMin;
        return params;
    };
    row("--step-min 0.5", varied(0.005, 0.02, 0.5));
    row("--octree-tolerance 0 --octree-tolerance2 0", varied(0, 0, 1));
    row("--octree-tolerance 0.0005 --octree-tolerance2 0.002", varied(0.0005, 0.002, 1));
    row("default", usual);
    row("--octree-tolerance 0.02 --octree-tolerance2 0.05", varied(0.02, 0.05, 1));
    row("--step-min 2", varied(0.005, 0.02, 2));
    return rows;
}

} // namespace bench
