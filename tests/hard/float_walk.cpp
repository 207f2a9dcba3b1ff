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

vec4 fishEye(const vec3& x, float radius) {
    const vec3 p = x / radius;
    const float n = 2.0f / (1.0f + glm::dot(p, p));
    return {-n * n * n / radius * p, n}; // ½∇(n²) = n ∇n = −n³ p/a
}

} // namespace

Drift walkInFloat(double radius, double tangent, double tau, int steps, bool kicksFirst) {
    const float a = static_cast<float>(radius), t = static_cast<float>(tau);
    const vec3 way = glm::normalize(vec3(static_cast<float>(tangent), 1.0f, 0.5f));
    Ray ray;
    ray.x = vec3(a, 0.0f, 0.0f);
    ray.w = fishEye(ray.x, a).w * way;
    const glm::dvec3 first = glm::cross(glm::dvec3(ray.x), glm::dvec3(ray.w));
    Drift drift;
    for (int i = 0; i < steps; ++i) {
        if (kicksFirst) {
            ray.w = halfKick(ray.w, fishEye(ray.x, a), t);
            ray.x = ray.x + t * ray.w;
            ray.w = halfKick(ray.w, fishEye(ray.x, a), t);
        } else {
            ray = verletStep(ray, fishEye(verletMiddle(ray, t), a), t);
        }
        const double n = fishEye(ray.x, a).w, size = glm::length(glm::dvec3(ray.w));
        drift.index = std::max(drift.index, std::abs(size - n));
        const glm::dvec3 now = glm::cross(glm::dvec3(ray.x), glm::dvec3(ray.w));
        drift.angularMomentum = std::max(drift.angularMomentum, glm::length(now - first));
    }
    return drift;
}

} // namespace eikonal::hard
