// Crystals as voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/test_volume.h"

namespace eikonal {

/// An object of a scene by its distance [unit], its index and, if it is one, its crystal.
struct CrystalPart {
    std::string name;
    std::function<double(glm::dvec3)> distance;
    double index = 1;
    std::optional<volume::Crystal> crystal{};
    double absorption = 0;
    double albedo = -1; ///< 0 and up: it is opaque
};

inline volume::Crystal crystalOf(double index, const glm::dvec3& axis, double absorption = 0) {
    return {static_cast<float>(index), 0, glm::vec3(glm::normalize(axis)),
            glm::vec3(static_cast<float>(absorption))};
}

inline volume::Volume crystalVolume(const glm::ivec3& size, const std::vector<CrystalPart>& parts,
                                    double voxelSize = 1,
                                    const glm::dmat4& placed = glm::dmat4(1)) {
    TestVolume scene(size, voxelSize, placed);
    scene.constant("ior", 1);
    volume::Volume volume = scene.take();
    int order = 0;
    for (const CrystalPart& part : parts) {
        volume::DenseGrid distances{size, 1, {}};
        forEachVoxel(size, [&](glm::ivec3 p) {
            distances.values.push_back(
                static_cast<float>(part.distance((glm::dvec3(p) + 0.5) * voxelSize)));
        });
        volume::ObjectFacts facts;
        facts.name = part.name;
        facts.sdf = volume::ownGrid("sdf", part.name);
        facts.order = order++;
        facts.crystal = part.crystal;
        volume.putLevelSet(facts, {glm::ivec3(0), size - 1}, distances, 1000);
        const auto own = [&](const char* grid, double value) {
            volume.putConstant(volume::ownGrid(grid, part.name), glm::vec3(value));
        };
        own("ior", part.index);
        if (part.absorption > 0) own("absorption", part.absorption);
        if (part.albedo < 0) continue;
        own("opacity", 1);
        own("albedo", part.albedo);
    }
    return volume;
}

/// Adds a grid of values at voxels' middles [unit], one of the contract that has so many
/// components.
inline void putField(volume::Volume& volume, const std::string& grid, const glm::ivec3& size,
                     int components, const std::function<glm::dvec3(glm::dvec3)>& value) {
    volume::DenseGrid dense{size, components, {}};
    forEachVoxel(size, [&](glm::ivec3 p) {
        const glm::dvec3 v = value(glm::dvec3(p) + 0.5);
        for (int c = 0; c < components; ++c) dense.values.push_back(static_cast<float>(v[c]));
    });
    volume::PutOptions options;
    options.background = glm::vec3(1);
    options.allActive = true;
    volume.put(grid, {glm::ivec3(0), size - 1}, dense, options);
}

inline double boxDistance(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 out = glm::max(low - p, p - high);
    return std::max(out.x, std::max(out.y, out.z));
}

} // namespace eikonal
