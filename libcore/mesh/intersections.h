// Exact geometric questions about single faces and pairs of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

namespace eikonal::mesh {

/// Faces of no area, decided without rounding.
size_t countDegenerateFaces(const TriangleMesh& mesh);

/// Pairs of faces that meet in more than the corners and edges they share, decided without
/// rounding; stops at `most`. Faces of no area are left out, and of faces on the same three
/// corners all but the first.
size_t countIntersectingPairs(const TriangleMesh& mesh, size_t most);

} // namespace eikonal::mesh
