// What bounds the objects of a scene with sharp boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace eikonal::scene {

/// One object's boundary.
struct Object {
    volume::BrickGrid distance; ///< over the domain: signed, negative inside [voxel]
    volume::IndexBox box;       ///< where it is, and round it, from the domain's first voxel on
    /// Blocks of kBrick³ cells that rays look up: those with a corner within kNearby of it. Cell
    /// (x, y, z) is between voxels (x − 1, y − 1, z − 1) and (x, y, z), so that the domain's faces
    /// are within cells; blocks are counted with x fastest.
    std::vector<std::uint32_t> cells;
    volume::IndexBox inside; ///< the voxels within it, or which its boundary passes
    float band = 0;          ///< no distance is known beyond [voxel]
    float slope = 1;         ///< how it grows a voxel on, in the mean near the boundary
};

/// An object of those distances [voxel].
Object makeObject(volume::BrickGrid distance);

/// Whether they are more than tables of boundaries have bits for: kernels then go by lists.
bool areMany(const std::vector<Object>& objects);

/// The most objects whose boundary is near one voxel, and some more: near one block of cells.
int mostNear(const std::vector<Object>& objects);

/// Blocks of cells along each axis of a domain of that size.
inline glm::ivec3 cellBlocks(const glm::ivec3& size) {
    return (size + volume::kBrick) / volume::kBrick;
}

/// Reads the level set of that name over `box`. Throws DataError if it contradicts itself: negative
/// outside, or neighbours nearly the whole band apart.
Object readObject(const volume::Volume& volume, const std::string& sdf,
                  const volume::IndexBox& box);

} // namespace eikonal::scene
