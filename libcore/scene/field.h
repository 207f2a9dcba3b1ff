// The index field on the device, as shaders/transport/index_field.glsl reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "optics/tracing.h"
#include "scene/scene.h"

namespace eikonal::scene {

using optics::Interpolation;

struct FieldOptions {
    Interpolation interpolation = Interpolation::linear;
    /// Linear: samples pre-corrected so that their interpolation is right on average, else plain
    /// central differences as in Ihrke et al. 2007 and Sun et al. 2008.
    bool unbiased = true;
    /// If above 0, the potential is the one in which Verlet steps of this dτ [voxel] are of fourth
    /// order: see toVerlet() in shaders/lib/ray.glsl.
    double verletTau = 0;
};

/// The value of the shaders' switch FIELD: 0 a constant index, 1 linear, 2 cubic.
int fieldSwitch(bool varies, Interpolation interpolation);

class Field {
public:
    Field() = default;
    /// An index that does not vary, and Cauchy's B of it [µm²].
    Field(gpu::Device& device, float constant, float dispersion);
    /// Of an index that varies. Throws MemoryError if the device can't hold it.
    Field(gpu::Device& device, const Index& index, const VoxelLayout& layout,
          const FieldOptions& options);

    /// At the unit and binding that shaders/transport/index_field.glsl names.
    void bind() const;
    const gpu::Texture& texture() const { return mTexture; }

private:
    gpu::Texture mTexture, mDispersed;
    gpu::Buffer mParams;
};

/// What a field takes on the device.
gpu::Need fieldNeed(const VoxelLayout& layout, Interpolation interpolation, bool disperses);

} // namespace eikonal::scene
