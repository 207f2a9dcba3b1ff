// Crystals that vary within, on the device as shaders/transport/varying_crystal.glsl reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/scene.h"

namespace eikonal::scene {

/// Cubic B-splines of n_o and of D = (n_e² − n_o²) a aᵀ, a the axis, over the box that all crystals
/// that vary are in: D knows no sign of a, and is 0 where the medium is isotropic.
class CrystalField {
public:
    CrystalField() = default;
    /// Throws DataError where two such crystals come closer than look-ups reach, MemoryError if the
    /// device can't hold it.
    CrystalField(gpu::Device& device, const Scene& scene);

    /// At the units of shaders/shared/bindings.h; nothing of none.
    void bind() const;

private:
    gpu::Texture mPure, mMixed;
};

/// The box that a scene's crystals that vary are in, and what is looked up round them, from the
/// domain's first voxel on.
volume::IndexBox crystalBox(const Scene& scene);

/// What they take on the device.
gpu::Need crystalNeed(const Scene& scene);

} // namespace eikonal::scene
