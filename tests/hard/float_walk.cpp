// The shaders' ray steps compiled in float (with the compiler's single-precision constants).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "float_walk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/ext.hpp>
#include <glm/glm.hpp>

namespace eikonal::hard {

namespace {

using glm::clamp;
using glm::max;
using glm::min;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::abs;
using std::floor;
using std::sqrt;
using uint = std::uint32_t;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "lib/ray.glsl"
#pragma GCC diagnostic pop

thread_local float theRadius = 1;

/// The fish-eye, under the name by which the library asks for a field.
vec4 fieldAt(vec3 x) {
    const vec3 p = x / theRadius;
    const float n = 2.0f / (1.0f + glm::dot(p, p));
    return {-n * n * n / theRadius * p, n}; // ½∇(n²) = n ∇n = −n³ p/a
}

} // namespace

Drift walkInFloat(double radius, double tangent, double tau, int steps, bool kicksFirst) {
    const float t = static_cast<float>(tau);
    theRadius = static_cast<float>(radius);
    const vec3 way = glm::normalize(vec3(static_cast<float>(tangent), 1.0f, 0.5f));
    Ray ray;
    ray.x = vec3(theRadius, 0.0f, 0.0f);
    ray.w = fieldAt(ray.x).w * way;
    const glm::dvec3 first = glm::cross(glm::dvec3(ray.x), glm::dvec3(ray.w));
    Drift drift;
    for (int i = 0; i < steps; ++i) {
        if (kicksFirst) {
            ray.w = halfKick(ray.w, fieldAt(ray.x), t);
            ray.x = ray.x + t * ray.w;
            ray.w = halfKick(ray.w, fieldAt(ray.x), t);
        } else {
            ray = verletStep(ray, fieldAt(verletMiddle(ray, t)), t);
        }
        const double n = fieldAt(ray.x).w, size = glm::length(glm::dvec3(ray.w));
        drift.index = std::max(drift.index, std::abs(size - n));
        const glm::dvec3 now = glm::cross(glm::dvec3(ray.x), glm::dvec3(ray.w));
        drift.angularMomentum = std::max(drift.angularMomentum, glm::length(now - first));
    }
    return drift;
}

} // namespace eikonal::hard
