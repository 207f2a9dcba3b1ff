// What the hierarchy of beams spares under waves: Barczak and Olano's tables 1 and 2, with a map of
// as many cells as their meshes have vertices. SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"
#include "floors.h"

#include <glm/matrix.hpp>

namespace bench {

using namespace eikonal;

namespace {

/// A picture's points on the floor, as from straight above: the whole measured part, or a quarter.
lightsim::Points pointsOn(const Case& scene, const scene::Scene& read, int edge, bool quarter) {
    const glm::dmat4 worldFromVoxel = glm::inverse(read.voxelFromWorld());
    const double span = (quarter ? 1.0 : 2.0) * kUnit;
    lightsim::Points points;
    points.width = edge;
    for (int i = 0; i < edge * edge; ++i) {
        const glm::dvec3 x(scene.low + (i % edge + 0.5) / edge * span, kFloor,
                           scene.low + (i / edge + 0.5) / edge * span);
        points.places.emplace_back(worldFromVoxel * glm::dvec4(x - 0.5, 1));
        points.normals.emplace_back(0, 1, 0);
    }
    return points;
}

/// Photons that a map of N by N cells over the light's view of the domain is asked for by.
std::int64_t photonsFor(int edge) {
    return std::int64_t{64} * edge * edge;
}

} // namespace

Json measureHierarchy(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    const Case scene = waterOverFloor(true);
    lightsim::Params params;
    params.lights.push_back(scene.light);
    params.surfaceDetail = kDetail;
    const scene::Scene read = lightsim::makePlan(scene.volume, params).scene;
    Json rows = Json::array();
    const auto measure = [&](int edge, const std::string& name, double reference) {
        const lightsim::Plan plan = lightsim::makePlan(scene.volume, params);
        Stats stats;
        const auto result = lightsim::simulate(device, plan, params, stats, {});
        double milliseconds = 0;
        for (const auto& pass : stats.passes)
            if (pass.name.rfind("beam", 0) == 0) milliseconds += pass.cpuMs;
        Json row{{"cells", edge},
                 {"way", name},
                 {"beams_ms", milliseconds},
                 {"speedup_percent", reference > 0 ? 100 * (reference / milliseconds - 1) : 0},
                 {"rays", stats.counter("beam_points")},
                 {"beams", stats.counter("beams")},
                 {"culled", stats.counter("beams_culled")}};
        if (plan.points.empty())
            row["error_percent"] = 100 * errorOf(scene, result.irradiance).error;
        else
            row["error_percent"] = "-";
        rows.push_back(row);
        return milliseconds;
    };
    params.photons = photonsFor(32);
    measure(0, "warm-up", 0);
    rows.erase(0);
    for (const int edge : {120, 160, 200}) {
        params.photons = photonsFor(edge);
        params.beamLevels = 0;
        const double reference = measure(edge, "every cell", 0);
        params.photons = photonsFor(edge / 4);
        params.beamLevels = 2;
        measure(edge, "hierarchy", reference);
        params.shadowCull = 0.65;
        measure(edge, "hierarchy, shadow culling", reference);
        params.points = pointsOn(scene, read, 512, true);
        measure(edge, "the same, a quarter seen, vectors", reference);
        params.points = pointsOn(scene, read, 512, false);
        measure(edge, "the same, all seen, vectors", reference);
        params.points = {};
        params.shadowCull = 1;
    }
    return rows;
}

} // namespace bench
