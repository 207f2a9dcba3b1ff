// The faces that bound a mesh's solid: where shells overlap or faces cross, some lie inside it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

namespace eikonal::mesh {

/// What of the mesh lies between its solid, which is where the surface winds around more than 0
/// times, and the rest: faces within the solid, as of overlapping shells, are left out, and those
/// that cross others are cut into pieces of at most `piece` [unit] there, each kept or left out
/// as a whole. Whether a piece bounds is told by the winding number at either side of its middle.
TriangleMesh solidBoundary(const TriangleMesh& mesh, double piece);

} // namespace eikonal::mesh
