// The ground beyond the domain, as the view kernel reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/ground.h"
#include "view/shared.h"

namespace eikonal::view {

/// Irradiance of a light that is the same all over on a plane that faces up: of a directional one,
/// as far as its disc is above the horizon [W/m²].
glm::dvec3 evenIrradiance(const scene::Light& light);

/// Throws DataError for more lights that stand somewhere than the kernel takes.
GroundParams groundParams(const scene::Ground& ground, const scene::Scene& scene);

} // namespace eikonal::view
