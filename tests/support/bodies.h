// Convex, concave and thin bodies of glass, on which methods of tracing meshes are compared.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace eikonal::mesh {

enum class BodyKind { convex, concave, thin };

/// One of them, with its normals, about the origin; all of it is seen from `eye` in 30°.
struct SampleBody {
    std::string name;
    BodyKind kind;
    TriangleMesh mesh;
    glm::dvec3 eye; ///< [unit]
};

/// A sphere, a lens and a box; a peanut, a ring and a bumpy sphere; a bowl and a pane.
std::vector<SampleBody> sampleBodies();

} // namespace eikonal::mesh
