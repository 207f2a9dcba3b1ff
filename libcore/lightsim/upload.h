// The medium and the domain's faces, as the photon kernels read them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "lightsim/photon_map.h"
#include "lightsim/plan.h"

#include <glm/vec4.hpp>
#include <vector>

namespace eikonal::lightsim {

/// σ_a RGB, or (σ_a, σ_s) in a grey medium, padded [1/voxel].
gpu::Texture makeAbsorption(gpu::Device& device, const Plan& plan);
/// σ_s RGB, padded [1/voxel].
gpu::Texture makeScattering(gpu::Device& device, const Plan& plan);
/// Not 0 in voxels that are more than half opaque.
gpu::Texture makeOpaque(gpu::Device& device, const Plan& plan);

/// The box's faces, outward, three corners a triangle.
std::vector<glm::vec4> triangles(const VoxelBox& box);

} // namespace eikonal::lightsim
