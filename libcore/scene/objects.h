// The objects of a scene with sharp boundaries: what bounds them, what is in them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace eikonal::scene {

/// Distances are kept this far out [voxel].
constexpr float kKept = 5;

/// Reads a file's level sets and one-sided grids into the scene. Throws DataError for more than
/// twelve objects.
void readObjects(Scene& scene, const volume::Volume& volume);

/// Reads a grid over `box`: one value if it does not vary there, what the contract says of an
/// absent grid if it is not there.
Values readValues(const volume::Volume& volume, const std::string& grid,
                  const volume::IndexBox& box);

} // namespace eikonal::scene
