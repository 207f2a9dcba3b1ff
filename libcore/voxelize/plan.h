// What voxelising a scene will make, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "mesh/sheet.h"
#include "mesh/walls.h"
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
    std::vector<std::optional<mesh::Wall>> walls; ///< the thinnest per object; where sharp
    std::vector<Effect> effects;
    std::int64_t hostBytes = 0; ///< of grids, about, while they are filled and as trees [byte]
};

// Of a thinner wall a cubic spline of distances feels the crease in the middle, which turns both
// faces. [voxel]
constexpr double kThinnestWall = 5;

// Of a thinner one a signed distance is negative at one sample at most, and its slopes are not
// those of two boundaries but of none. [voxel]
constexpr double kLostWall = 2;

/// What to say of walls that distances can't hold: a sentence per object, with what would hold it.
std::vector<std::string> thinWallWarnings(const Params& params, const Plan& plan);

/// The thinnest wall over all objects [voxel], if there is one.
std::optional<double> thinnestWallVoxels(const Plan& plan);

/// Around the objects and down to the ground. Throws as makePlan() does.
Lattice latticeOf(const Params& params);

/// The edge of the voxels of these meshes' lattice [unit]. Throws as makePlan() does.
double voxelSizeOf(const Params& params);

/// The domain of --bounds, which holds whole voxels, and what an open sheet must keep to in it:
/// it may end half a voxel within, where no voxel has its middle. None without --bounds. Throws as
/// makePlan() does.
std::optional<mesh::SheetDomain> sheetDomainOf(const Params& params, bool below);

/// Lays the lattice around the objects' meshes and picks the grids. Throws UsageError if the
/// options make too many voxels of these meshes, MemoryError if the host can't hold them.
Plan makePlan(const Params& params);

} // namespace eikonal::voxelize
