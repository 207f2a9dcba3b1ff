// Mesh files and scene files as mesh2vol reads them: objects, and what a file says of their matter.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "scenefile/scene.h"
#include "voxelize/params.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::mesh2vol {

/// An object of a file.
struct Piece {
    std::string name; ///< empty where the file is one object
    std::optional<scenefile::Material> material{};
    mesh::TriangleMesh mesh{};

    bool isGlass() const { return !material || material->kind == scenefile::Material::Kind::glass; }
};

struct ReadFile {
    std::vector<Piece> pieces;
    std::vector<std::string> warnings, notes; ///< a line each
};

/// Whether a file may bring materials along, by its name.
bool mayBringMaterials(const std::string& path);

/// Reads a file of any kind: glTF with its materials, OBJ with those of its .mtl where that is
/// there, other meshes. With `fillIn` what has no material in a glTF file is matt, of albedo 0.8.
/// Throws as scenefile's and mesh's readers do.
ReadFile readFile(const std::string& path, bool fillIn);

/// What the voxels are told of a file's material. What tints without a depth (a base colour of
/// glass, Tf) absorbs so much that it lets the tint through along the mesh's mean chord, 4 V / S;
/// what glows is black and dense, so that rays see its radiance from 1/200 of its least extent on.
voxelize::Material materialOf(const scenefile::Material& given, const mesh::TriangleMesh& mesh);

/// For --explain.
std::string materialText(const scenefile::Material& given);

} // namespace eikonal::mesh2vol
