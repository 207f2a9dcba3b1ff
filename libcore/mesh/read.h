// Mesh files to triangles: the first step of mesh2vol.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace eikonal::mesh {

/// Reads OBJ, PLY (ASCII and binary), OFF (ASCII) or STL (ASCII and binary), chosen by the
/// extension in any case, or by the content where there is none of these: in a stream, which is
/// "-" for standard input or any that base/input_file.h knows. Polygons and strips become
/// triangles, identical points one; points that no face uses, colours and textures are dropped.
/// Corners have the normals that OBJ (vn) and PLY (nx, ny, nz) give them; one that is no direction,
/// or that there is not, counts as none. Coordinates are taken as world units.
/// Throws MissingError where there is no readable file; DataError, with the place and what was
/// found and expected, for an unknown format, a file that does not follow its format, a coordinate
/// that is no finite number, an index out of range, or no faces.
TriangleMesh readMesh(const std::string& path);

/// An object of a file.
struct Part {
    std::string name; ///< as the file has it; empty where the file is one object
    TriangleMesh mesh;
    std::string material{}; ///< what readPieces() finds it to be made of
};

/// The same, apart where the file names objects: those of OBJ's lines `o`, or `g` where there is
/// no `o`. What is closed only together stays together, under the first's name: parts with an
/// open edge in common, and a closed part that looks inward with the one around it, whose cavity
/// it is.
std::vector<Part> readParts(const std::string& path);
/// The same of a file that was read.
std::vector<Part> readParts(const std::string& path, std::string_view bytes);

/// Of an OBJ file that was read: what has the same object and the same material (`usemtl`), each
/// apart, whether it is closed alone or not.
std::vector<Part> readPieces(const std::string& path, std::string_view bytes);

/// The files that an OBJ file has its materials from, as it names them (`mtllib`); of other files
/// none.
std::vector<std::string> materialLibraries(const std::string& path, std::string_view bytes);

/// "standard input" or the path, as messages have it.
std::string meshTitle(const std::string& path);

} // namespace eikonal::mesh
