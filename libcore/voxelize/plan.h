// What voxelising a scene will make, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "volume/volume.h"
#include "voxelize/grids.h"
#include "voxelize/lattice.h"

#include <vector>

namespace eikonal::voxelize {

struct Plan {
    Lattice lattice;
    volume::Frame frame;
    volume::IndexBox box; ///< from voxel 0 on
    std::vector<Grid> grids;
    std::vector<Effect> effects;
    std::int64_t hostBytes = 0; ///< of grids, while they are filled and as trees [byte]
};

/// Lays the lattice around the objects' meshes and picks the grids. Throws UsageError if the
/// options make too many voxels of these meshes, MemoryError if the host can't hold them.
Plan makePlan(const Params& params);

} // namespace eikonal::voxelize
