// The surface of a function as a mesh, by OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace eikonal::volume {

struct Polygons {
    std::vector<glm::dvec3> points; ///< where the function's points were given
    std::vector<glm::uvec4> quads;  ///< anticlockwise, seen from where the function is above 0
};

/// Where a function of points is 0, as one point a cell that this surface crosses. The function,
/// below 0 inside, is looked up at the corners of cubes of edge `cell` from `low` to `high` and
/// one beyond; it must be above 0 on the outermost corners. Several threads call it at once.
Polygons polygonize(const std::function<double(const glm::dvec3&)>& function, const glm::dvec3& low,
                    const glm::dvec3& high, double cell);

} // namespace eikonal::volume
