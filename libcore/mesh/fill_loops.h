// Plane outlines filled with triangles: letters, with their holes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace eikonal::mesh {

/// What closed outlines enclose.
struct FilledLoops {
    std::vector<glm::dvec2> points;
    std::vector<glm::uvec3> triangles; ///< anticlockwise
    /// The region's sides, the region to their left: each is a side of one triangle.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
};

/// The points that the loops wind around at least once, either way, which is how fonts are filled:
/// outlines that overlap become one, an outline that runs the other way within another is a hole.
/// By a constrained Delaunay triangulation. Loops are closed by themselves; they may cross.
FilledLoops fillLoops(const std::vector<std::vector<glm::dvec2>>& loops);

} // namespace eikonal::mesh
