// Triangles in world space: what a boundary is before it becomes voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace eikonal::mesh {

/// Where the surface looks at a face's three corners: directions of length 1, or 0 where none is
/// known.
using CornerNormals = std::array<glm::vec3, 3>;

/// A triangle soup with shared corners. Seen from outside, a face's corners run anticlockwise.
struct TriangleMesh {
    std::vector<glm::dvec3> points;       ///< world space [unit]
    std::vector<glm::uvec3> triangles;    ///< three indices into `points`
    std::vector<CornerNormals> normals{}; ///< one for each triangle, or none at all
    /// Triangles from this one on are flat: no smoothing curves them or their sides.
    std::size_t flatFrom = std::numeric_limits<std::size_t>::max();
};

/// An axis-aligned box in world space [unit]. Empty while `min` exceeds `max`.
struct Box {
    glm::dvec3 min{1, 1, 1};
    glm::dvec3 max{-1, -1, -1};

    bool empty() const { return min.x > max.x; }
    bool contains(const glm::dvec3& x) const;
    bool touches(const Box& other) const {
        return min.x <= other.max.x && max.x >= other.min.x && min.y <= other.max.y &&
               max.y >= other.min.y && min.z <= other.max.z && max.z >= other.min.z;
    }
    void include(const glm::dvec3& x) {
        const bool first = empty();
        min = first ? x : glm::min(min, x);
        max = first ? x : glm::max(max, x);
    }
    void include(const Box& other) {
        if (other.empty()) return;
        include(other.min);
        include(other.max);
    }
};

/// The box of the points that a triangle uses; empty without triangles.
Box boundingBox(const TriangleMesh& mesh);

/// The enclosed volume [unit³], positive where faces look outward. An open mesh has none: then the
/// number depends on where the box's centre lies.
double signedVolume(const TriangleMesh& mesh);

/// [unit²]
double faceArea(const TriangleMesh& mesh, const glm::uvec3& face);

/// The sum of the faces' areas [unit²].
double surfaceArea(const TriangleMesh& mesh);

/// The sum of the faces' areas as vectors along their normals [unit²]; none where the surface is
/// closed and its faces agree.
glm::dvec3 vectorArea(const TriangleMesh& mesh);

/// How often the surface wraps around `x`: the sum of the faces' signed solid angles over 4π. For
/// a closed mesh 1 inside, 0 outside, -1 inside one turned inside out; a fraction for an open one.
/// Linear in the number of triangles.
double windingNumber(const TriangleMesh& mesh, const glm::dvec3& x);

/// The solid angle of one triangle seen from `x`, over 4π; positive if seen from behind.
double windingShare(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& x);

/// Gives every triangle its own normal at its corners: no smoothing curves it.
void setFlatNormals(TriangleMesh& mesh);

/// Drops the points that no triangle uses, keeping the order. Gives the number that went.
size_t dropUnusedPoints(TriangleMesh& mesh);

/// Makes points of equal coordinates one, then drops unused ones. Gives the number that went.
size_t mergeIdenticalPoints(TriangleMesh& mesh);

/// Puts another mesh's points and triangles behind a mesh's own.
void append(TriangleMesh& mesh, const TriangleMesh& other);

/// Whether two corners of the face are the same point of the list.
inline bool hasRepeatedCorner(const glm::uvec3& face) {
    return face.x == face.y || face.y == face.z || face.z == face.x;
}

} // namespace eikonal::mesh
