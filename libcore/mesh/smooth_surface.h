// Curved surfaces from facets: what a mesh's points and normals are samples of.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/fans.h"
#include "mesh/triangle_mesh.h"

namespace eikonal::mesh {

// Triangles that meet at more are an edge, unless a user says otherwise [degree].
constexpr double kUsualSmooth = 30;

// What triangles that stand for a curved surface in a grid may be off it [voxel]: below what counts
// of samples tell at eight along a voxel's edge.
constexpr double kSagitta = 1.0 / 20;

struct SmoothCounts {
    size_t flat = 0; ///< faces left flat since curved ones would have crossed others
};

/// The mesh with the fans' normals, its faces split until none departs from the curved one that it
/// stands for (edgeCurves(), CurvedFace) by more than `sagitta` [unit]. Points stay where they are;
/// new ones are the middles of edges' curves, which depend on the edge alone: what was closed stays
/// so. Faces that bend less are not split. Where curved faces would cross others which the flat
/// ones do not, those stay flat, their normals 0.
TriangleMesh curved(const TriangleMesh& mesh, const Fans& fans, double sagitta,
                    SmoothCounts& counts);

} // namespace eikonal::mesh
