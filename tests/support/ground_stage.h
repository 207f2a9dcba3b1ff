// A ground within a domain, as mesh2vol makes it, with nothing on it or a ball of glass.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/recorded_lights.h"
#include "support/test_volume.h"
#include "volume/ground.h"

#include <glm/geometric.hpp>
#include <limits>

namespace eikonal {

struct GroundStage {
    glm::ivec3 size{16}; ///< [voxel]
    double voxelSize = 1;
    glm::dmat4 placed{1}; ///< the domain's low corner is the origin before
    volume::Ground ground{};
    double around = 1; ///< index of what surrounds all
    glm::dvec3 centre{0};
    double radius = 0; ///< of a ball of index 1.5 about `centre` in the world; 0: none

    volume::Volume make(const std::string& lights = "") const {
        TestVolume scene(size, voxelSize, placed);
        scene.index([&](glm::dvec3) { return around; }, around);
        volume::Volume volume = scene.take();
        const auto bound = [&](const std::string& name, int priority, int order,
                               const std::function<double(glm::dvec3)>& distance) {
            volume::DenseGrid grid{size, 1, {}};
            forEachVoxel(size, [&](glm::ivec3 p) {
                const glm::dvec3 inDomain = (glm::dvec3(p) + 0.5) * voxelSize;
                grid.values.push_back(
                    static_cast<float>(distance(glm::dvec3(placed * glm::dvec4(inDomain, 1)))));
            });
            volume.putLevelSet({name, "sdf." + name, priority, order}, {glm::ivec3(0), size - 1},
                               grid, 6);
        };
        if (radius > 0) {
            bound("ball", 0, 0, [&](glm::dvec3 p) { return glm::length(p - centre) - radius; });
            volume.putConstant("ior.ball", glm::vec3(1.5f));
        }
        bound("ground", std::numeric_limits<int>::max(), 1,
              [&](glm::dvec3 p) { return p.y - ground.y; });
        volume.putConstant("ior.ground", glm::vec3(static_cast<float>(around)));
        volume.putConstant("opacity.ground", glm::vec3(1));
        volume.putConstant("albedo.ground", glm::vec3(ground.meanAlbedo()));
        volume.setMetadata(volume::kGroundKey, volume::textOf(ground));
        if (!lights.empty()) volume.setMetadata(scene::kLightsKey, lights);
        return volume;
    }
};

/// What a checker's squares reflect at a place.
inline glm::dvec3 albedoAt(const volume::Ground& ground, const glm::dvec3& p) {
    if (ground.square == 0) return ground.albedo;
    const auto whole = [&](double at) { return static_cast<long>(std::floor(at / ground.square)); };
    return ground.albedo * ((whole(p.x) + whole(p.z)) % 2 == 0 ? 1.0 : 0.5);
}

} // namespace eikonal
