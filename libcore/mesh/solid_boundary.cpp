// The faces that bound a mesh's solid.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/solid_boundary.h"

#include "mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eikonal::mesh {

namespace {

using glm::dvec3;
using Piece = std::array<dvec3, 3>;

/// The sides of a plane that points lie on, those within `skin` of it on neither.
struct Sides {
    bool above = false, below = false;

    Sides(const Piece& points, const dvec3& on, const dvec3& normal, double skin) {
        for (const dvec3& point : points) {
            const double height = glm::dot(point - on, normal);
            above |= height > skin;
            below |= height < -skin;
        }
    }
    bool both() const { return above && below; }
};

dvec3 normalOf(const Piece& t) {
    const dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    return length > 0 ? normal / length : dvec3(0);
}

/// Whether some of the piece may bound the solid and some not for the other triangle's sake: that
/// passes through it, or lies in its plane and ends amid it.
bool divides(const Piece& other, const Piece& piece, double skin) {
    const dvec3 normal = normalOf(other);
    const Sides across(piece, other[0], normal, skin);
    if (across.both()) return Sides(other, piece[0], normalOf(piece), skin).both();
    if (across.above || across.below) return false;
    bool straddles = false;
    for (size_t k = 0; k < 3; ++k) {
        const dvec3 side = other[(k + 1) % 3] - other[k];
        const Sides beside(piece, other[k], glm::normalize(glm::cross(side, normal)), skin);
        if (!beside.below) return false; // wholly outside this side
        straddles |= beside.above;
    }
    return straddles;
}

class Cutter {
public:
    Cutter(const TriangleMesh& mesh, double piece)
        : mMesh(mesh), mTree(mesh), mPiece(piece), mSkin(1e-5 * piece) {}

    TriangleMesh run() {
        for (size_t f = 0; f < mMesh.triangles.size(); ++f) {
            const glm::uvec3& face = mMesh.triangles[f];
            const size_t before = mKept.triangles.size();
            take(cornersOf(face), face);
            if (mMesh.normals.empty()) continue;
            mKept.normals.resize(mKept.triangles.size());
            // A whole face stays as it is curved; pieces are flat.
            if (mWhole && mKept.triangles.size() > before) mKept.normals.back() = mMesh.normals[f];
        }
        return std::move(mKept);
    }

private:
    Piece cornersOf(const glm::uvec3& face) const {
        return {mMesh.points[face.x], mMesh.points[face.y], mMesh.points[face.z]};
    }

    /// Whether a face that shares no corner with `face`, of which the piece is, divides the piece.
    bool isDivided(const dvec3& middle, double radius, const Piece& piece, const glm::uvec3& face) {
        mTree.within(middle, radius, mNear);
        return std::any_of(mNear.begin(), mNear.end(), [&](std::uint32_t f) {
            const glm::uvec3& other = mMesh.triangles[f];
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    if (other[j] == face[k]) return false;
            return divides(cornersOf(other), piece, mSkin);
        });
    }

    void take(const Piece& piece, const glm::uvec3& face) {
        const dvec3 middle = (piece[0] + piece[1] + piece[2]) / 3.0;
        double radius = 0, longest = 0;
        for (size_t k = 0; k < 3; ++k) {
            radius = std::max(radius, glm::distance(middle, piece[k]));
            longest = std::max(longest, glm::distance(piece[k], piece[(k + 1) % 3]));
        }
        if (longest <= mPiece || !isDivided(middle, radius, piece, face)) {
            mWhole = piece == cornersOf(face);
            if (bounds(middle, piece)) keep(piece);
            return;
        }
        const dvec3 ab = (piece[0] + piece[1]) / 2.0, bc = (piece[1] + piece[2]) / 2.0,
                    ca = (piece[2] + piece[0]) / 2.0;
        take({piece[0], ab, ca}, face);
        take({ab, piece[1], bc}, face);
        take({ca, bc, piece[2]}, face);
        take({ab, bc, ca}, face);
    }

    bool bounds(const dvec3& middle, const Piece& piece) const {
        // Off the face by more than rounding, by less than what anyone means as a gap.
        const dvec3 aside = mSkin * normalOf(piece);
        return aside != dvec3(0) && mTree.winding(middle - aside) > 0 &&
               mTree.winding(middle + aside) <= 0;
    }

    void keep(const Piece& piece) {
        const auto first = static_cast<std::uint32_t>(mKept.points.size());
        mKept.points.insert(mKept.points.end(), piece.begin(), piece.end());
        mKept.triangles.emplace_back(first, first + 1, first + 2);
    }

    const TriangleMesh& mMesh;
    TriangleTree mTree;
    double mPiece, mSkin; // [unit]
    std::vector<std::uint32_t> mNear;
    bool mWhole = false; // the last piece was its whole face
    TriangleMesh mKept;
};

} // namespace

TriangleMesh solidBoundary(const TriangleMesh& mesh, double piece) {
    return Cutter(mesh, piece).run();
}

} // namespace eikonal::mesh
