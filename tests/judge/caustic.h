// Light that a ball of glass throws on a plane, by exact rays of every order.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/texels.h"
#include "judge/trace.h"

#include <vector>

namespace judge {

struct BallOverPlane {
    double radius = 0.5, index = 1.5; ///< of a ball round the origin
    double height = -0.75;            ///< of the plane y = height
    dvec3 direction{-0.3, -1, -0.2};  ///< of the light's travel; its irradiance across it is 1
    double extent = 1; ///< texels cover [−extent, extent]² of the plane, x fastest
    int texels = 64;   ///< along an edge
};

/// Irradiance on the plane's texels, with the shadow, what goes through the ball after any number
/// of inner reflections, and what it mirrors. `strata`² jittered rays cover the light.
std::vector<double> irradianceUnder(const BallOverPlane& scene, int strata);

/// The same on any texels of the plane, whatever the scene's are, without noise: each order of
/// reflection is laid down by patches, the first ten of them: the others have 1e-5 of the light.
void irradianceUnder(const BallOverPlane& scene, Texels& texels, double bend = Patching{}.bend);

} // namespace judge
