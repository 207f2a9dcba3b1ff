// Nearest points and rays among many triangles: how far a boundary is, and what lies behind it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace eikonal::mesh {

/// The squared distance from x to the closed triangle a, b, c, in double; a triangle of no area is
/// its sides. (Ericson, Real-Time Collision Detection, 5.1.5.)
double squaredDistance(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b,
                       const glm::dvec3& c);

/// A tree of boxes around triangles, in whatever space and unit their points are. What it answers
/// is exact but for the rounding of doubles. Questions may be asked by many threads.
///
/// CGAL's tree is not used: it makes its answer a point of its kernel and asks for a hint that is a
/// point of the surface, where a face and a bound are at hand, and costs several times as much.
class TriangleTree {
public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    explicit TriangleTree(const TriangleMesh& mesh);

    /// All faces, those side by side that lie near each other.
    const std::vector<std::uint32_t>& order() const { return mFaces; }

    struct Nearest {
        double squared;             ///< of the distance
        std::uint32_t face = kNone; ///< of the mesh; kNone: none within the bound
    };
    /// The nearest face at less than `squaredBound`. `hint`, a face thought near, speeds it up.
    Nearest nearest(const glm::dvec3& x, double squaredBound, std::uint32_t hint = kNone) const;

    /// Replaces `faces` by those that come as near to x as `radius`.
    void within(const glm::dvec3& x, double radius, std::vector<std::uint32_t>& faces) const;
    /// The same by their places in order().
    void placesWithin(const glm::dvec3& x, double radius, std::vector<std::uint32_t>& places) const;

    /// Replaces `places` by those in order() of faces whose own boxes touch the box.
    void placesTouching(const Box& box, std::vector<std::uint32_t>& places) const;

    struct Hit {
        double t; ///< [length of the direction]
        std::uint32_t face;
    };
    /// Replaces `hits` by the faces that the ray x + t · direction meets at 0 < t < `most`, in no
    /// order. A ray through an edge may meet both its faces or neither.
    void hits(const glm::dvec3& x, const glm::dvec3& direction, double most,
              std::vector<Hit>& hits) const;

    /// How often the surface, which must be closed, wraps around x.
    int winding(const glm::dvec3& x) const;

private:
    struct Node {
        Box box;
        std::uint32_t first = 0; ///< of its triangles in order; of an inner node its right child
        std::uint32_t count = 0; ///< 0: an inner node, whose left child is the next
    };
    struct Corners {
        glm::dvec3 a, b, c, middle;
        double radius; ///< of a ball about the middle that holds them
    };
    /// A face while its place is looked for.
    struct Centre {
        glm::dvec3 sum; ///< of its corners
        std::uint32_t face;
    };
    static size_t nodesOf(std::uint32_t count);
    void put(std::uint32_t face, std::uint32_t place);
    void build(size_t self, std::uint32_t first, std::uint32_t count, std::vector<Centre>& centres);
    template<typename Enter, typename Look> void walk(const Enter& enter, const Look& look) const;

    const TriangleMesh& mMesh;
    std::vector<std::uint32_t> mFaces; ///< in the order of the leaves
    std::vector<Corners> mCorners;     ///< in the same order
    std::vector<std::uint32_t> mPlace; ///< of a face in that order
    std::vector<Node> mNodes;
};

} // namespace eikonal::mesh
