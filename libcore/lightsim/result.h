// What a light simulation gives.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/bricks.h"
#include "volume/fine_grid.h"

namespace eikonal::lightsim {

/// Grids over the scene's domain, 0 in bricks that receive no light; a grid not asked for is empty.
struct Result {
    volume::BrickGrid fluence;   ///< RGB [W/m²]
    volume::BrickGrid direction; ///< mean direction of travel in world space, length <= 1
    volume::FineGrid irradiance; ///< RGB on opaque surfaces [W/m²]
};

} // namespace eikonal::lightsim
