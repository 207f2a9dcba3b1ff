// Blurred media, as the photon kernel reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "lightsim/plan.h"

namespace eikonal::lightsim {

/// σ_a per voxel [1/voxel]; of a grey medium (σ_a, σ_s).
gpu::Texture makeAbsorption(gpu::Device& device, const Plan& plan);

/// σ_s per voxel [1/voxel], of a coloured medium.
gpu::Texture makeScattering(gpu::Device& device, const Plan& plan);

/// 1 where opacity exceeds ½, else 0.
gpu::Texture makeOpaque(gpu::Device& device, const Plan& plan);

} // namespace eikonal::lightsim
