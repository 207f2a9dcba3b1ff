// Blurred media, as the photon kernel reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "lightsim/plan.h"

namespace eikonal::lightsim {

/// Textures per voxel; none of sharp boundaries, whose regions know their coefficients.
struct Media {
    gpu::Texture absorption; ///< σ_a [1/voxel]; of a grey medium (σ_a, σ_s)
    gpu::Texture scattering; ///< σ_s of a coloured medium [1/voxel]
    gpu::Texture opaque;     ///< 1 where opacity exceeds ½, else 0
    gpu::Texture opacity;    ///< itself, where surfaces receive light; where they bounce it, then
                             ///< their albedo

    Media(gpu::Device& device, const Plan& plan);
    void bind() const;
};

} // namespace eikonal::lightsim
