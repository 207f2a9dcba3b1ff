// What a light simulation gives.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

namespace eikonal::lightsim {

/// Grids over the scene's domain; a grid not asked for is empty.
struct Result {
    volume::DenseGrid fluence;   ///< RGB [W/m²]
    volume::DenseGrid direction; ///< mean direction of travel in world space, length <= 1
};

} // namespace eikonal::lightsim
