// Exact geometric questions about single faces and pairs of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace eikonal::mesh {

/// Faces of no area, decided without rounding.
size_t countDegenerateFaces(const TriangleMesh& mesh);

/// Pairs of faces that meet in more than the corners and edges they share, decided without
/// rounding; stops at `most`. Faces of no area are left out, and of faces on the same three
/// corners all but the first. The lower number of a pair comes first.
std::vector<std::pair<std::uint32_t, std::uint32_t>> intersectingPairs(const TriangleMesh& mesh,
                                                                       size_t most);

} // namespace eikonal::mesh
