// Whether a mesh may be voxelised: checked, repaired where asked for, else refused.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/sheet.h"
#include "mesh/triangle_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::voxelize {

/// What was found in a mesh and done to it.
struct Acceptance {
    std::vector<std::string> findings; ///< its size first, then one sentence per fault
    std::vector<std::string> repairs;  ///< one sentence each
    std::string closing;               ///< how an open sheet was closed; empty: it was none
    std::vector<std::string> warnings; ///< where its maker may have meant another volume
};

/// Makes sure that `mesh` bounds a volume. Which side is out, and where a hole's lid would lie, is
/// never guessed silently. An open mesh whose rim is outside the domain of `sheet` is closed there.
/// Else without `repair` a mesh with such a fault is a DataError, which says what is wrong with
/// `path` and what would help; with it, one that still bounds nothing is.
Acceptance acceptMesh(mesh::TriangleMesh& mesh, const std::string& path, bool repair,
                      const std::optional<mesh::SheetDomain>& sheet = {});

} // namespace eikonal::voxelize
