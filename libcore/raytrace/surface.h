// A mesh's surface where a ray meets it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>

namespace eikonal::raytrace {

struct SurfacePoint {
    glm::dvec3 x;      ///< on the triangle, world space [unit]
    glm::dvec3 face;   ///< the triangle's outward normal, of length 1
    glm::dvec3 smooth; ///< that of the surface which it stands for, of length 1
};

/// The point of a triangle nearest to x, which is close to it. The smooth normal is interpolated
/// between the mesh's normals at the corners (Phong 1975); where the mesh has none, or they say
/// nothing, it is the face's.
SurfacePoint surfaceAt(const mesh::TriangleMesh& mesh, std::uint32_t triangle, const glm::dvec3& x);

/// The smooth normal, on the side that a ray along `direction` arrives from; `face` is on that
/// side, too. Near a silhouette the smooth normal may look away from a ray that has met the face:
/// then it is turned just so far that the ray grazes the surface, as it does on the one that the
/// triangles stand for.
glm::dvec3 facingNormal(const glm::dvec3& smooth, const glm::dvec3& face,
                        const glm::dvec3& direction);

/// A direction within a body, of length 1, that leaves its boundary into it: one that the smooth
/// normal sends out through the flat face, or along it, is turned to 0.06° within the face's plane,
/// or the path would be outside the body that it is thought to be in. `inward` is the face's
/// normal.
glm::dvec3 keptWithin(const glm::dvec3& direction, const glm::dvec3& inward);

} // namespace eikonal::raytrace
