// A simulation's grids made into those of the contract: an index of a temperature, coefficients of
// a density.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "simgrids/map.h"
#include "volume/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::simgrids {

struct Params {
    /// At most one a target; none: scattering of density, emission of flame, as far as they are
    /// there.
    std::vector<Map> maps;
    /// What makes kelvins of a temperature grid's values: [K] = kelvinScale · v + kelvinOffset.
    double kelvinScale = 1, kelvinOffset = 0;
    /// The temperature [K] where the simulation has no active voxel; else the grid's background.
    std::optional<double> ambient;

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

/// A file open, and what becomes of which of its grids.
struct Plan {
    volume::Volume volume;
    std::vector<Map> maps; ///< `from` is the name of a grid that is there
    std::vector<Effect> effects;
};

/// The names in the file that a map's grid may have, the first that is there counting: Houdini's
/// and Blender's names of one quantity. A name of no list is its own.
std::vector<std::string> namesOf(const std::string& grid);

/// Opens the file and settles names. Throws what Volume::open() does, and DataError where a grid is
/// not there, or no map was given and none of the default ones applies.
Plan makePlan(const std::string& path, const Params& params);

/// Makes the grids, one voxel of each for one of its source, by double arithmetic; an index is
/// stored in double. Returns warnings: how many voxels were cut to the contract's range.
std::vector<std::string> run(Plan& plan, const Params& params, Stats& stats);

} // namespace eikonal::simgrids
