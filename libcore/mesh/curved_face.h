// Faces bent to the normals at their corners: what a mesh's facets stand for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/shells.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace eikonal::mesh {

/// How the curve between two points leaves its chord: at t from 0 to 1 along it by
/// 4 t (1 - t) rise + t (1 - t) (1 - 2t) skew [unit]. No part of either runs along the chord.
struct EdgeCurve {
    glm::dvec3 rise{0}; ///< of the curve's middle; its length is the chord's sagitta
    glm::dvec3 skew{0}; ///< how differently the two ends are bent

    /// At least how far any of its points is from the chord's with the same t.
    double bulge() const;
};

/// The normals at an edge's two ends as one of its faces has them; 0: none, the face is flat.
struct EdgeNormals {
    glm::dvec3 first, second;
};

/// The curve from `a` to `b` on one smooth surface: the rise is that of a circle's arc, or a
/// helix', where the normals are theirs.
EdgeCurve smoothCurve(const glm::dvec3& a, const glm::dvec3& b, const EdgeNormals& normals);

/// The curve in which two surfaces meet: along both at both ends. Straight where that says nothing.
EdgeCurve creaseCurve(const glm::dvec3& a, const glm::dvec3& b, const EdgeNormals& left,
                      const EdgeNormals& right);

/// A surface's normal at the middle of such a curve.
glm::dvec3 middleNormal(const glm::dvec3& a, const glm::dvec3& b, const EdgeCurve& curve,
                        const EdgeNormals& normals);

/// For each face the curves of its three sides, from corner k to the next: the same for all faces
/// at an edge, read the other way where they run so. Straight where a face there has no normals or
/// more than two meet; everywhere if the mesh has no normals. `edges` are the mesh's, sorted.
std::vector<std::array<EdgeCurve, 3>> edgeCurves(const TriangleMesh& mesh,
                                                 const std::vector<FaceEdge>& edges);
inline std::vector<std::array<EdgeCurve, 3>> edgeCurves(const TriangleMesh& mesh) {
    return edgeCurves(mesh, sortedEdges(mesh));
}

/// A cubic triangle through three points with such curves for sides; where these are of a quadratic
/// surface over the triangle's plane, that surface (Vlachos, Peters, Boyd and Mitchell 2001,
/// "Curved PN triangles", but for the sides' rise).
class CurvedFace {
public:
    CurvedFace(const std::array<glm::dvec3, 3>& corners, const std::array<EdgeCurve, 3>& sides);

    /// At least how far any of its points is from that of the flat face with the same weights.
    double bulge() const { return mBulge; }

    /// The point of the weights 1 - u - v, u, v of the corners.
    glm::dvec3 at(const glm::dvec2& uv) const;

    struct Nearest {
        double squared; ///< of the distance
        double height;  ///< of x above the face at its nearest point, negative behind it
    };
    /// Where the flat face is nearest to x.
    struct Start {
        glm::dvec2 uv;
        double squared; ///< of the distance from there
    };
    Start flatNearest(const glm::dvec3& x) const;
    /// The point nearest to x, by Newton's method from there.
    Nearest nearest(const glm::dvec3& x, const Start& start) const;

private:
    struct Slopes {
        glm::dvec3 x, u, v, uu, uv, vv; ///< the point and its derivatives
    };
    Slopes slopesAt(const glm::dvec2& uv) const;

    std::array<glm::dvec3, 3> mCorners;
    std::array<EdgeCurve, 3> mSides;
    double mBulge;
};

} // namespace eikonal::mesh
