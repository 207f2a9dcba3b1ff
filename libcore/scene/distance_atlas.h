// Objects' distances as splines on the device, where rays look them up.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/objects.h"

#include <vector>

namespace eikonal::scene {

/// Blocks of cells of all objects: a table that tells where each block lies in an atlas of spline
/// coefficients.
class DistanceAtlas {
public:
    DistanceAtlas() = default;
    /// Throws MemoryError if the device can't hold it.
    DistanceAtlas(gpu::Device& device, const std::vector<Object>& objects);

    glm::ivec3 texels() const { return mCoefficients.size(); }

    /// At the units of shaders/shared/bindings.h.
    void bind() const;

private:
    gpu::Texture mBlocks, mCoefficients;
};

/// Whether their rows are packed, which costs time and saves memory: where there are many.
bool isPacked(const std::vector<Object>& objects);

/// What they take on the device.
std::vector<gpu::Need> atlasNeeds(const std::vector<Object>& objects);

} // namespace eikonal::scene
