// Fans of faces round a point, between edges: where a mesh is meant to be round, and its normals.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace eikonal::mesh {

/// Which corners of faces look the same way, and which.
struct Fans {
    std::vector<glm::uvec3> of;      ///< for each face its corners' fans
    std::vector<glm::dvec3> normals; ///< of length 1, or 0 where a fan has none
    std::vector<double> angles;      ///< of the fan's faces at its point, summed up [radian]
};

/// The fans of a mesh: an edge parts them if two faces meet there at more than `degrees`, or the
/// mesh's own normals differ on its sides, or it has not two faces that agree. A fan's normal is
/// that of the mesh, where it has one there that is off none of the faces by more than `degrees`;
/// else that of its faces, weighted so that it is exact where the points lie on a sphere (Max 1999,
/// "Weights for computing vertex normals from facet normals"). Where that is off one of the faces
/// by more than `degrees`, as at the tip of a cone, each face has a fan of its own.
Fans findFans(const TriangleMesh& mesh, double degrees);

/// Where faces of several meshes coincide, point for point, gives the fans there one normal, that
/// of the fan with most of the surface: surfaces that touch before they are curved touch
/// afterwards. Fans that this would turn by more than `degrees` from a face keep theirs.
void joinFans(const std::vector<const TriangleMesh*>& meshes, std::vector<Fans>& fans,
              double degrees);

/// The fans' normals at the faces' corners.
std::vector<CornerNormals> cornerNormals(const Fans& fans);

} // namespace eikonal::mesh
