// An open surface of no thickness becomes a plate.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>

namespace eikonal::mesh {

/// Gives an open mesh a thickness [unit] behind its faces, which stay where they are: back faces
/// are theirs, moved along the points' mean normals and turned over, and sides join both where an
/// edge has a single face. What is added is flat. Gives why not, and leaves the mesh, where faces
/// disagree about which side is out or more than two meet at an edge; else an empty text.
std::string makePlate(TriangleMesh& mesh, double thickness);

} // namespace eikonal::mesh
