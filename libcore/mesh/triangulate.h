// Polygons to triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace eikonal::mesh {

/// Appends the n - 2 triangles of a polygon of n >= 3 corners, which may be concave and a little
/// bent. Every side of the polygon stays a side of one triangle, so that a closed surface stays
/// closed, whatever the polygon looks like.
void appendTriangles(const std::vector<glm::dvec3>& points,
                     const std::vector<std::uint32_t>& polygon, std::vector<glm::uvec3>& triangles);

} // namespace eikonal::mesh
