// The stress in a disc that two forces compress, which photoelasticity shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <glm/vec2.hpp>

namespace eikonal {

struct PlaneStress {
    double difference = 0;  ///< σ1 − σ2, of the principal stresses
    glm::dvec2 first{1, 0}; ///< the direction of σ1, of length 1
};

/// At a point of a disc of that radius about the origin, compressed by two equal forces along y
/// against each other; in units of 2 P/(π t), P the force and t the thickness (Frocht 1948,
/// Photoelasticity, volume 2, §4).
inline PlaneStress discStress(const glm::dvec2& at, double radius) {
    const double x = at.x, a = radius - at.y, b = radius + at.y;
    const double r1 = std::pow(x * x + a * a, 2), r2 = std::pow(x * x + b * b, 2);
    const double xx = -(a * x * x / r1 + b * x * x / r2 - 0.5 / radius);
    const double yy = -(a * a * a / r1 + b * b * b / r2 - 0.5 / radius);
    const double xy = a * a * x / r1 - b * b * x / r2;
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    return {std::hypot(xx - yy, 2 * xy), {std::cos(angle), std::sin(angle)}};
}

} // namespace eikonal
