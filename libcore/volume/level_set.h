// Signed distances to closed surfaces as an OpenVDB grid; includes OpenVDB, so for this room only.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <openvdb/openvdb.h>

namespace eikonal::volume {

/// A narrow band of `halfWidth` voxels either side, in index space [voxel], background included.
openvdb::FloatGrid::Ptr makeLevelSet(const glm::dmat4& indexFromWorld,
                                     const std::vector<glm::dvec3>& points,
                                     const std::vector<Shells>& shells, double halfWidth);

/// A narrow band of values [unit] over `box`, cut to `halfWidth` [unit] either side: what lies
/// beyond is inactive and keeps its sign.
openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const DenseGrid& values, float halfWidth);

} // namespace eikonal::volume
