// What linear interpolation of central differences is off by, as far as samples can tell.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/samples.h"

#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::scene {

/// Per voxel of a box three potentials: the difference along an axis of U less its potential, half
/// of that from before a voxel to behind it, is the force that linear interpolation gets right on
/// average.
struct Bias {
    glm::ivec3 low{0}, size{0}; ///< of the box [voxel]
    std::vector<glm::vec3> values;

    std::ptrdiff_t at(const glm::ivec3& voxel) const {
        const glm::ivec3 p = voxel - low;
        return (std::ptrdiff_t{p.z} * size.y + p.y) * size.x + p.x;
    }
};

/// Linear interpolation is off by 1/12 of the second differences along each axis on average over a
/// cell, central differences by 1/6 of those along their own: where U is smooth, that is the bias.
///
/// Where it is not (at a kink, an edge, or noise) most of the error is how the lattice happens to
/// lie, which taking off differences makes worse: there samples stay as they are. Which of the two
/// it is tell the fourth differences beside the second.
///
/// The box may reach two voxels beyond the domain.
Bias biasOf(const Potential& potential, const glm::ivec3& low, const glm::ivec3& size);

} // namespace eikonal::scene
