// A volume's materials changed by hand: noise, brushes, other volumes' grids.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "paint/strokes.h"
#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::paint {

struct Params {
    std::string object; ///< whose GRID a name without a dot means, `medium` for what is round all
    std::vector<Noise> noises;
    std::vector<Sphere> spheres;
    std::vector<Stamp> stamps;

    /// Throws UsageError where nothing is painted.
    void check() const;
};

/// Paints: all noises first, then spheres, then stamps. A grid that is not there is 0 before (`ior`
/// and `reflectance`: 1). A painted grid has all voxels of the domain active, so that it holds
/// beyond an object's boundary as the contract wants; beyond the domain it keeps its background.
/// Values are cut to the contract's range where its end is valid, else refused with DataError
/// naming the voxel. Returns warnings: what was cut, strokes that change
/// nothing. Throws MissingError and DataError of brushes that can't be read or hold none of the
/// three grids; DataError where a file has objects with values of their own and a grid's name does
/// not say of which, or of one that there is not.
std::vector<std::string> run(volume::Volume& volume, const Params& params, Stats& stats);

} // namespace eikonal::paint
