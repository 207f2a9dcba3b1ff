// How what surrounds the scene lights a matt surface, where nothing else is there to shade it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/background.h"

#include <array>

namespace eikonal::camera {

/// Irradiance by a surface's normal x, y, z [W/m²], as the factors of 1, y, z, x, xy, yz, 3z² − 1,
/// xz, x² − y². Matt surfaces see little more of what surrounds them: nine spherical harmonics are
/// right within 1 % in the mean (Ramamoorthi and Hanrahan 2001, "An efficient representation for
/// irradiance environment maps"). Exact for a colour all round.
using Irradiance = std::array<glm::dvec3, 9>;

Irradiance irradianceFrom(const Background& background, const std::optional<image::Image>& map);

/// On a surface of that normal, of length 1, in the world. Never below 0.
glm::dvec3 irradianceOn(const Irradiance& irradiance, const glm::dvec3& normal);

} // namespace eikonal::camera
