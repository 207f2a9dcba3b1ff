// What smoothing a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "smooth/params.h"
#include "volume/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::smooth {

/// A grid to be smoothed, or smoothed, over the volume's domain.
struct Item {
    std::string grid;
    glm::vec3 background{0.0f};
    volume::DenseGrid values;
    /// Of an index of doubles that floats do not hold: values and background are what exceeds this.
    std::optional<double> base{};
    /// Per voxel 1 where the grid's values count and are smoothed, 0 where they neither are nor do;
    /// empty: all count.
    std::vector<float> counts{};
    /// Of a level set: which, and its half width [voxel]. What lies beyond its band stays there.
    std::optional<volume::ObjectFacts> object{};
    double halfWidth = 0;
};

struct Plan {
    glm::ivec3 size{0};          ///< [voxel]
    std::vector<double> weights; ///< of gaussianWeights()
    std::vector<Item> items;     ///< empty: nothing to smooth
    std::vector<Effect> effects; ///< one per grid asked for
};

/// Reads the grids to be smoothed and decides. A grid of one value is none of them. One-sided
/// values (`GRID.NAME`; unsuffixed grids where an object has no `ior.NAME`) count up to where the
/// contract has them valid, 4 voxels beyond the object's boundary, or to its band's end. Throws
/// DataError if a named grid is not there or is neither float nor vec3s.
Plan makePlan(const volume::Volume& volume, const Params& params);

} // namespace eikonal::smooth
