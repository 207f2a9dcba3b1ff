// Meshes as OBJ: what the other tools and programs read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <ostream>
#include <string>

namespace eikonal::mesh {

/// Writes the mesh as one object, with its normals where it has some, behind a comment of one line.
/// Coordinates have nine significant digits, in every locale.
void writeObj(std::ostream& out, const TriangleMesh& mesh, const std::string& comment);

} // namespace eikonal::mesh
