// Values per voxel as textures that rays sample up to the domain's faces and a little beyond.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/voxel_layout.h"

#include <functional>
#include <glm/vec3.hpp>

namespace eikonal::scene {

/// Packs up to four values of a voxel into a texel: `pack(voxel, out)` fills
/// componentsOf(format) floats.
using Pack = std::function<void(const glm::ivec3& voxel, float* out)>;

/// A texture of that layout. Its margin is extended linearly, but not below 0 where `floorAtZero`.
gpu::Texture makeVoxelTexture(gpu::Device& device, const VoxelLayout& layout,
                              gpu::TexelFormat format, bool floorAtZero, const Pack& pack);

/// The same into a texture that is as wide, from a slice on.
void fillVoxels(gpu::Texture& texture, int slice, const VoxelLayout& layout,
                gpu::TexelFormat format, bool floorAtZero, const Pack& pack);

/// Calls `write(place, texels, width)` for each block of a paged layout, in order, with where its
/// first texel goes and the texels of a slice along x and y; uploads what they write, from `slice`
/// on.
using WriteBlock = std::function<void(size_t place, float* texels, const glm::ivec3& slab)>;
void fillBlocks(gpu::Texture& texture, int slice, const VoxelLayout& layout,
                gpu::TexelFormat format, const WriteBlock& write);

/// The table of blocks, as shaders/transport/voxels.glsl reads it.
gpu::Texture makeVoxelTable(gpu::Device& device, const VoxelLayout& layout);

/// What a texture of so many bytes a texel takes, and the table.
gpu::Need voxelNeed(const VoxelLayout& layout, const char* what, std::int64_t bytesPerTexel);
gpu::Need tableNeed(const VoxelLayout& layout);

} // namespace eikonal::scene
