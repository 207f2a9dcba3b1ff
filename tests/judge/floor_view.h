// Pictures of floors under a ball of glass and under waves, with the exact light on them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/caustic.h"
#include "judge/water.h"

namespace judge {

struct View {
    dvec3 eye{0, 0.9, 2.6}, target{0, -0.15, 0}; ///< [unit]; up is y
    double fov = 40;                             ///< vertical [degree]
    int width = 800, rows = 600;                 ///< [pixel]
    int strata = 8; ///< a pixel is the mean of strata² rays, evenly over its square
};

/// What all rays of a pixel meet first.
enum class Meets { other, floor, through }; ///< through: the ball or the water

/// Row 0 on top.
struct Picture {
    std::vector<double> radiance; ///< for light whose irradiance across its direction is 1
    std::vector<Meets> met;
};

/// What lies on the floor: it is Lambertian, [−extent, extent]² large, and lit by the light alone.
struct Floor {
    double albedo = 0.8, extent = 3;
    double fine = 1024; ///< texels to a unit in the caustic's surroundings; a quarter elsewhere
};

/// A ball over its plane before a black background; view rays are followed through the ball as
/// light is, up to nine inner reflections.
Picture pictureOf(const BallOverPlane& scene, const Floor& floor, const View& view);

/// The floor seen through waves; radiance that comes out of the water is n² less. Rays that waves
/// reflect are followed to the next wave. The box is black.
Picture pictureOf(const Water& water, const Floor& floor, const View& view);

} // namespace judge
