// Mesh files to triangles: the first step of mesh2vol.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>

namespace eikonal::mesh {

/// Reads OBJ, PLY (ASCII and binary), OFF (ASCII) or STL (ASCII and binary), chosen by the
/// extension in any case. Polygons become triangles, identical points one; points that no face
/// uses, normals, colours and textures are dropped. Coordinates are taken as world units.
/// Throws MissingError where there is no readable file; DataError, with the place and what was
/// found and expected, for an unknown extension, a file that does not follow its format, a
/// coordinate that is no finite number, an index out of range, or no faces.
TriangleMesh readMesh(const std::string& path);

} // namespace eikonal::mesh
