// What smoothing a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "smooth/params.h"
#include "volume/volume.h"

#include <string>
#include <vector>

namespace eikonal::smooth {

/// A grid to be smoothed, or smoothed, over the volume's domain.
struct Item {
    std::string grid;
    glm::vec3 background{0.0f};
    volume::DenseGrid values;
};

struct Plan {
    glm::ivec3 size{0};          ///< [voxel]
    std::vector<double> weights; ///< of gaussianWeights()
    std::vector<Item> items;     ///< empty: nothing to smooth
    std::vector<Effect> effects; ///< one per grid asked for
};

/// Reads the grids to be smoothed and decides. A grid of one value is none of them. Throws
/// DataError if a named grid is not there or is neither float nor vec3s.
Plan makePlan(const volume::Volume& volume, const Params& params);

} // namespace eikonal::smooth
