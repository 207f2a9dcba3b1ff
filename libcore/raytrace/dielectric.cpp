// Snell's and Fresnel's laws in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/dielectric.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace eikonal::raytrace {

namespace kernel {

// GLSL's names.
using glm::max;
using std::abs;
using std::log;
using std::sqrt;
using vec3 = glm::dvec3;

namespace { // the library knows no `inline`
#define float double
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "lib/fresnel.glsl"
#pragma GCC diagnostic pop
#undef float
} // namespace

} // namespace kernel

Scattered scatter(const glm::dvec3& direction, const glm::dvec3& normal, double n, double beyond) {
    const kernel::Dielectric made = kernel::dielectricAt(n * direction, normal, n, beyond);
    Scattered scattered{glm::normalize(made.reflected), std::nullopt, made.reflectance};
    if (made.reflectance < 1) scattered.refracted = glm::normalize(made.refracted);
    return scattered;
}

} // namespace eikonal::raytrace
