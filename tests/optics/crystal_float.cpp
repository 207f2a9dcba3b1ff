// The shaders' crystals in float, as devices compute them. Compiled with literals of float.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/crystal_float.h"

#include <cmath>
#include <glm/glm.hpp>

namespace eikonal::shader_lib_float {

namespace {

using glm::max;
using std::abs;
using std::sqrt;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "lib/crystal.glsl"
#pragma GCC diagnostic pop

Uniaxial toFloat(const Medium& m) {
    return {static_cast<float>(m.o), static_cast<float>(m.e), vec3(m.axis)};
}

double sumOf(const Parts& parts) {
    const glm::dvec4 on(parts.on), back(parts.back);
    return glm::dot(on, on) + glm::dot(back, back);
}

} // namespace

std::array<Sums, 2> sumsInFloat(const Medium& near, const Medium& beyond, double q) {
    const Crossing c = crossingOf(toFloat(near), toFloat(beyond), static_cast<float>(q));
    return {Sums{sumOf(c.fromO), sumOf(closed(c.fromO))}, {sumOf(c.fromE), sumOf(closed(c.fromE))}};
}

} // namespace eikonal::shader_lib_float
