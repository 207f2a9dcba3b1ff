// Objects' boundaries on the device, as shaders/transport/level_set.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/crystal_field.h"
#include "scene/distance_atlas.h"
#include "scene/scene.h"

namespace eikonal::scene {

class Boundaries {
public:
    Boundaries() = default;
    /// Throws MemoryError if the device can't hold it.
    Boundaries(gpu::Device& device, const Scene& scene);

    /// At the units and the binding of shaders/shared/bindings.h.
    void bind() const;

private:
    void makeCoefficients(gpu::Device& device, const Scene& scene, float voxelSize);
    DistanceAtlas mDistances;
    CrystalField mCrystals;
    gpu::Texture mClearance, mNearby, mSets, mCoefficients[3];
    gpu::Buffer mParams;
};

/// What the boundaries take on the device.
std::vector<gpu::Need> boundaryNeeds(const Scene& scene);

} // namespace eikonal::scene
