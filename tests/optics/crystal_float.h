// The shaders' crystals in float, as devices compute them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace eikonal::shader_lib_float {

/// A crystal: n_o, n_e, axis.
struct Medium {
    double o, e;
    glm::dvec3 axis;
};

/// What shares add up to as they are solved, and as they are used.
struct Sums {
    double solved, used;
};

/// Of a wave that arrives in o, and in e, at a boundary.
std::array<Sums, 2> sumsInFloat(const Medium& near, const Medium& beyond, double q);

} // namespace eikonal::shader_lib_float
