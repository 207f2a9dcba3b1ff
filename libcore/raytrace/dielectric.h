// Snell's and Fresnel's laws in double, by the text that kernels use (shaders/lib/fresnel.glsl).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace eikonal::raytrace {

/// What an interface makes of a ray; directions of length 1.
struct Scattered {
    glm::dvec3 reflected;
    std::optional<glm::dvec3> refracted; ///< nothing past the critical angle
    double reflectance;                  ///< of unpolarised light [1]
};

/// A ray along `direction` from index n to index `beyond`; the normal looks to either side. Both of
/// length 1.
Scattered scatter(const glm::dvec3& direction, const glm::dvec3& normal, double n, double beyond);

} // namespace eikonal::raytrace
