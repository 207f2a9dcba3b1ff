// What a light simulation gives.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/bricks.h"
#include "volume/fine_grid.h"

#include <vector>

namespace eikonal::lightsim {

/// What falls on a point of a surface.
struct LightAtPoint {
    glm::vec3 irradiance{0}; ///< RGB [W/m²]
    glm::vec3 flow{0};       ///< the sum of its parts' mean of RGB, times where each travels
};

/// Grids over the scene's domain, 0 in bricks that receive no light; a grid not asked for is empty.
struct Result {
    volume::BrickGrid fluence;   ///< RGB [W/m²]
    volume::BrickGrid direction; ///< mean direction of travel in world space, length <= 1
    volume::FineGrid irradiance; ///< RGB on opaque surfaces [W/m²], but for points

    /// At points, flow in world space; of all light, or if apart of each light.
    std::vector<std::vector<LightAtPoint>> points;
};

/// Adds another light's grids to these, both of the same plan: directions by their fluence, a mean
/// of RGB.
void add(Result& sum, const Result& light);

} // namespace eikonal::lightsim
