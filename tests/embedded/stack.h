// Layers one below the other, and what becomes of light in them, on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::embedded {

struct Layer {
    double thickness;         ///< [unit]; of the first and the last, which have no end, unused
    double ior;               ///< n [1]
    glm::dvec3 absorption{0}; ///< [1/unit]
    glm::dvec3 emission{0};   ///< [radiance/unit]
};

/// What a stack sends up, of J = L/n²: own + mirrored · (J that comes down).
struct Upward {
    glm::dvec3 own{0}, mirrored{0};
    double shift = 0; ///< how far aside of the first boundary's foot a ray meets the last [unit]
};

/// Layers from the top to the bottom. `sine` is n sin θ of a ray, which all layers have in common.
/// `below` is J that comes up from beneath, of what is black to all that comes down to it.
///
/// Sharp boundaries mirror by Fresnel's equations, and every order of reflection is summed: the
/// adding method, from the lowest boundary up.
Upward sharpStack(const std::vector<Layer>& layers, double sine, const glm::dvec3& below);

/// Boundaries that a Gaussian of that standard deviation [unit] blurs, of the index alone; nothing
/// is mirrored. By the midpoint rule.
Upward blurredStack(const std::vector<Layer>& layers, double sine, const glm::dvec3& below,
                    double softness);

/// The share of an unpolarised ray that a boundary mirrors; 1 where that is total.
double fresnel(double before, double beyond, double sine);

} // namespace eikonal::embedded
