// Light that lightsim stored on opaque surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/files.h"
#include "scene/surface_voxels.h"

#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::scene {

struct SurfaceLight {
    SurfaceVoxels voxels;
    std::vector<glm::vec3> values; ///< irradiance [W/m²], by the voxels' numbers

    bool empty() const { return values.empty(); }
    bool grey() const;
};

/// The sum of all files, by the fine voxels of the one that has the finest; empty where none has
/// any.
SurfaceLight readSurfaceLight(const Files& files);

/// The light on the device, as shaders/view/surface.glsl reads it.
class SurfaceLightTable {
public:
    SurfaceLightTable() = default;
    SurfaceLightTable(gpu::Device& device, const SurfaceLight& light);
    void bind() const;

private:
    SurfaceTable mTable;
    gpu::Texture mValues;
};

std::vector<gpu::Need> surfaceLightNeeds(const SurfaceLight& light);

} // namespace eikonal::scene
