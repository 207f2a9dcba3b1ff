// The tolerance octree on the device (Sun et al. 2008, §4.2, §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "lightsim/plan.h"

namespace eikonal::lightsim {

/// The dense level array, R32UI, one texel per 2×2×2 voxels, packed by shaders/lib/octree.glsl.
gpu::Texture makeOctree(gpu::Device& device, const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
