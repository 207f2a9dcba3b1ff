// What bounds the objects of a scene with sharp boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::scene {

/// Distances are kept this far out [voxel].
constexpr float kKept = 5;

/// One object's boundary over the part of the domain where it is near or inside.
struct Object {
    volume::IndexBox box;        ///< from the domain's first voxel on
    std::vector<float> distance; ///< signed, negative inside, x fastest [voxel]
    float band = 0;              ///< no distance is known beyond [voxel]
    float slope = 1;             ///< how it grows a voxel on, in the mean near the boundary
};

/// Reads the level set of that name over `box`. Throws DataError if it contradicts itself: negative
/// outside, or neighbours nearly the whole band apart.
Object readObject(const volume::Volume& volume, const std::string& sdf,
                  const volume::IndexBox& box);

} // namespace eikonal::scene
