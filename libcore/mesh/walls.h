// How thick a mesh's solid is where it is thinnest: what a grid of voxels must resolve.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <optional>

namespace eikonal::mesh {

struct Wall {
    double thickness;  ///< [unit]
    glm::dvec3 middle; ///< half-way between its faces, world space [unit]
};

/// The thinnest wall found in the solid of a closed mesh. A wall is what a line along a face's
/// normal, going inward, passes before it leaves the solid through a face that looks the other way
/// within 30°: two sides of a prism or of a lens' rim that meet at more than that are an edge and
/// no wall, however close to each other near it. Lines start at up to 20,000 points spread evenly
/// over the surface, always the same; from the thinnest places found the search goes on downhill.
/// A box has its shortest edge, a shell its thickness. None: no face looks away from another.
std::optional<Wall> thinnestWall(const TriangleMesh& mesh);

} // namespace eikonal::mesh
