// Signed distances as an OpenVDB grid; includes OpenVDB, so for this room only.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <openvdb/openvdb.h>

namespace eikonal::volume {

/// A narrow band of values [unit] over `box`, cut to `halfWidth` [unit] either side: what lies
/// beyond is inactive and keeps its sign.
openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const DenseGrid& values, float halfWidth);
openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const BrickGrid& values, float halfWidth);

} // namespace eikonal::volume
