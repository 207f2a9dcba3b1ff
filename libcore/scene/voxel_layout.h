// Where a scene's voxels lie in textures that rays interpolate.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::scene {

struct Scene;

/// Samples go from the voxel before the domain's first to the one behind its last, along each axis,
/// those of the margin carried on from the inside. Of small domains all lie in one box. Of large
/// ones they lie in blocks of kVoxelCells³ cells with the samples at their corners, in an atlas: a
/// block whose samples are the same in every grid is there once for all that are like it.
struct VoxelLayout {
    glm::ivec3 size{0}; ///< the domain's [voxel]
    bool paged = false;
    glm::ivec3 blocks{0};             ///< along each axis, x fastest in what follows
    glm::ivec3 atlas{0};              ///< of blocks along each axis
    std::vector<std::uint32_t> table; ///< per block its place in the atlas
    std::vector<std::uint32_t> list;  ///< by place in the atlas the first block there
    std::vector<bool> even;           ///< by place: whether its samples are all the same

    /// The texels of a texture.
    glm::ivec3 texels() const;
    std::int64_t texelCount() const;
    /// The longest edge [texel].
    int edge() const;
    /// The first sample of a block, counted from the margin's.
    glm::ivec3 firstSample(std::uint32_t block) const;
    /// Where the block at a place of the atlas begins [texel].
    glm::ivec3 texelOf(size_t place) const;
};

/// `largest`: a box of more texels is cut into blocks where that saves any.
VoxelLayout layoutOf(const Scene& scene, std::int64_t largest = std::int64_t{1} << 24);

} // namespace eikonal::scene
