// The shaders' library as C++ in double, so that the text that is shipped is the text tested.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/ext.hpp>
#include <glm/glm.hpp>

namespace eikonal::shader_lib {

// GLSL's names for GLM's types of double; functions that GLM lacks for one number are std's.
using glm::clamp;
using glm::max;
using glm::min;
using std::abs;
using std::asin;
using std::cos;
using std::exp;
using std::floor;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using uint = std::uint32_t;

inline double atan(double y, double x) {
    return std::atan2(y, x);
}
inline vec3 floor(const vec3& v) {
    return glm::floor(v);
}

// Found in the shaders' folder, not in this one. `float` is a word of the language: only the
// library is read under this meaning of it.
#define float double
namespace { // the library knows no `inline`
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lib/crystal.glsl"
#include "lib/dip.glsl"
#include "lib/latlong.glsl"
#include "lib/microfacet.glsl" // and what it includes: fresnel, random
#include "lib/octree.glsl"
#include "lib/phase.glsl"
#include "lib/plane_light.glsl"
#include "lib/ray.glsl"
#include "lib/spline.glsl"
#include "lib/varying_crystal.glsl"

// Steps that look the field up ask the test for it.
thread_local std::function<vec4(vec3)> theField;
vec4 fieldAt(vec3 x) {
    return theField(x);
}
thread_local std::function<VaryingCrystal(vec3, vec3)> theCrystal;
VaryingCrystal varyingCrystalAt(int, vec3 x, vec3 k) {
    return theCrystal(x, k);
}
} // namespace
#pragma GCC diagnostic pop
#undef float

} // namespace eikonal::shader_lib
