// What a run measured, as the JSON of --stats.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/stats_json.h"

#include "gpu/device.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace eikonal::tool {

namespace {

nlohmann::ordered_json rgb(const Energy::Rgb& value) {
    return nlohmann::ordered_json::array({value[0], value[1], value[2]});
}

} // namespace

std::string statsText(const Stats& stats, const History& history, const gpu::DeviceInfo* device,
                      double wallMs) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["tool"] = history.tool;
    json["version"] = history.version;
    json["command"] = history.command;
    if (device) {
        json["device"] = {{"vendor", device->vendor},
                          {"renderer", device->renderer},
                          {"version", device->version},
                          {"software", device->software}};
    } else {
        json["device"] = nullptr;
    }
    json["effects"] = Json::object();
    for (const Effect& effect : stats.effects)
        json["effects"][effect.name] = {{"on", effect.on}, {"why", effect.why}};
    json["passes"] = Json::array();
    for (const PassTime& pass : stats.passes)
        json["passes"].push_back(
            {{"name", pass.name}, {"gpu_ms", pass.gpuMs}, {"cpu_ms", pass.cpuMs}});
    json["counters"] = Json::object();
    for (const auto& [name, value] : stats.counters)
        if (value == std::floor(value))
            json["counters"][name] = static_cast<std::uint64_t>(value);
        else
            json["counters"][name] = value;
    if (stats.hasEnergy) {
        const Energy& energy = stats.energy;
        json["energy"] = {{"emitted", rgb(energy.emitted)},   {"entered", rgb(energy.entered)},
                          {"absorbed", rgb(energy.absorbed)}, {"scattered", rgb(energy.scattered)},
                          {"escaped", rgb(energy.escaped)},   {"lost", rgb(energy.lost)}};
    }
    if (!stats.warnings.empty()) json["warnings"] = stats.warnings;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    json["memory"] = {{"gpu_peak_bytes", stats.gpuPeakBytes},
                      {"rss_peak_bytes", static_cast<std::uint64_t>(usage.ru_maxrss) * 1024}};
    json["wall_ms"] = wallMs;
    return json.dump(2) + "\n";
}

} // namespace eikonal::tool
