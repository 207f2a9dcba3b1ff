// Signed distances from voxels to a mesh's solid, exact within a band.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/distances.h"

#include "mesh/curved_face.h"
#include "mesh/shells.h"
#include "mesh/solid_boundary.h"
#include "mesh/triangle_tree.h"
#include "voxelize/insides.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kPiece = 1.0 / 16; // [voxel] where faces cross
constexpr int kBlock = 32;          // voxels along the edge of what one thread does at a time
constexpr int kListed = 4;          // of what has a list of faces of its own
// Where faces are smaller than that [voxel] lists are longer than the way through the tree.
constexpr double kFine = 0.4;

/// The mesh in index space [voxel], where voxel i's middle is at i.
mesh::TriangleMesh inVoxels(const mesh::TriangleMesh& mesh, const Lattice& lattice) {
    mesh::TriangleMesh out{{}, mesh.triangles, mesh.normals};
    out.points.reserve(mesh.points.size());
    for (const dvec3& point : mesh.points)
        out.points.push_back((point - lattice.low) / lattice.voxelSize - 0.5);
    return out;
}

bool isOneShell(const mesh::TriangleMesh& mesh) {
    return mesh::findShells(mesh, mesh::sortedEdges(mesh)).size() < 2;
}

/// The faces that may be nearest to some point of a cube, the one nearest to its middle first.
using Faces = std::vector<std::uint32_t>;

/// Measures the voxels of blocks that the band may reach.
class Band {
public:
    Band(const mesh::TriangleMesh& boundary, const Sides& sides, const Lattice& lattice,
         double halfWidth)
        : mTree(boundary), mSides(sides), mSize(lattice.size), mHalfWidth(halfWidth),
          mVoxelSize(lattice.voxelSize), mFar(static_cast<float>(halfWidth * lattice.voxelSize)) {
        mFaces.reserve(boundary.triangles.size());
        for (const glm::uvec3& face : boundary.triangles)
            mFaces.emplace_back(boundary.points[face.x], boundary.points[face.y],
                                boundary.points[face.z]);
        if (!boundary.normals.empty()) bend(boundary);
        double radii = 0;
        for (const Face& face : mFaces) radii += face.radius;
        const bool fine = radii < kFine * static_cast<double>(mFaces.size());
        mListed = fine ? 1 : kListed;
    }

    volume::BrickGrid measure() const {
        const ivec3 blocks = (mSize + kBlock - 1) / kBlock;
        std::vector<Bricks> found(static_cast<size_t>(blocks.x) * blocks.y * blocks.z);
        tbb::parallel_for(size_t{0}, found.size(), [&](size_t i) {
            const auto n = static_cast<int>(i);
            measureBlock(kBlock *
                             ivec3(n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y),
                         found[i]);
        });
        return gathered(found);
    }

private:
    struct Face {
        dvec3 a, b, c, middle;
        dvec3 normal{0};  // of length 1; of a sliver, whose is not exact, 0
        double radius;    // of a disc about the middle that holds it
        double bulge = 0; // how far the curved face may be off it

        Face(const dvec3& first, const dvec3& second, const dvec3& third)
            : a(first), b(second), c(third), middle((a + b + c) / 3.0),
              radius(std::sqrt(std::max(
                         {squareOf(a - middle), squareOf(b - middle), squareOf(c - middle)})) *
                     (1 + 1e-12)) {
            const dvec3 across = glm::cross(b - a, c - a);
            const double area = glm::length(across);
            if (area > 1e-4 * radius * radius) normal = across / area;
        }
        static double squareOf(const dvec3& v) { return glm::dot(v, v); }

        /// What the squared distance to x is at least: that to its disc, or a sliver's ball.
        double least(const dvec3& x) const {
            const dvec3 off = x - middle;
            const double height = glm::dot(normal, off);
            const double across = std::max(squareOf(off) - height * height, 0.0);
            const double beyond = across > radius * radius ? std::sqrt(across) - radius : 0.0;
            return height * height + beyond * beyond;
        }
    };

    /// Those of a block that the band reaches.
    struct Bricks {
        std::vector<ivec3> low;
        std::vector<float> values;
    };

    /// Takes the curved faces of a mesh with normals.
    void bend(const mesh::TriangleMesh& boundary) {
        constexpr double kFlat = 1e-6; // what floats keep of distances
        const auto curves = mesh::edgeCurves(boundary);
        for (size_t f = 0; f < mFaces.size(); ++f) {
            Face& face = mFaces[f];
            mCurved.emplace_back(std::array{face.a, face.b, face.c}, curves[f]);
            if (mCurved.back().bulge() < kFlat) continue;
            face.bulge = mCurved.back().bulge();
            mBulge = std::max(mBulge, face.bulge);
        }
    }

    void measureBlock(const ivec3& low, Bricks& found) const {
        Faces lists[3];
        descend(low, kBlock, mesh::TriangleTree::kNone, lists, found);
    }

    /// Halves a cube of voxels until it lies beyond the band or is small; `hint` is a face that was
    /// near the cube around it.
    void descend(const ivec3& low, int edge, std::uint32_t hint, Faces (&lists)[3],
                 Bricks& found) const {
        if (glm::any(glm::greaterThanEqual(low, mSize))) return;
        const dvec3 middle = dvec3(low) + (edge - 1) / 2.0;
        const double toCorner = std::sqrt(3.0) * (edge - 1) / 2,
                     reach = mHalfWidth + toCorner + mBulge;
        const auto nearest = mTree.nearest(middle, reach * reach, hint);
        if (nearest.face == mesh::TriangleTree::kNone) return;
        if (edge == volume::kBrick) begin(low, found);
        if (edge == 1 && mBulge == 0) return store(low, std::sqrt(nearest.squared), found);
        if (edge == mListed) {
            mTree.within(middle, std::sqrt(nearest.squared) + 2 * (toCorner + mBulge) + kRounding,
                         lists[0]);
            return measure(low, edge, lists, found);
        }
        for (int i = 0; i < 8; ++i)
            descend(low + edge / 2 * ivec3(i & 1, i >> 1 & 1, i >> 2), edge / 2, nearest.face,
                    lists, found);
    }

    /// The same with the faces that may be nearest to any of its points, in the first of the lists.
    void measure(const ivec3& low, int edge, Faces* lists, Bricks& found) const {
        if (glm::any(glm::greaterThanEqual(low, mSize))) return;
        if (edge == 1 && mBulge > 0) return storeCurved(low, lists[0], found);
        const dvec3 middle = dvec3(low) + (edge - 1) / 2.0;
        const double toCorner = std::sqrt(3.0) * (edge - 1) / 2;
        const double squared = nearestOf(middle, lists[0]), distance = std::sqrt(squared);
        if (distance > mHalfWidth + toCorner + mBulge) return;
        if (edge == 1) return store(low, distance, found);
        Faces* const own = lists + 1;
        keepNear(middle, distance + 2 * (toCorner + mBulge) + kRounding, lists[0], *own);
        for (int i = 0; i < 8; ++i)
            measure(low + edge / 2 * ivec3(i & 1, i >> 1 & 1, i >> 2), edge / 2, own, found);
    }

    /// The squared distance to the nearest of the faces, which is moved to their front.
    double nearestOf(const dvec3& x, Faces& faces) const {
        double squared = std::numeric_limits<double>::max();
        size_t first = 0;
        for (size_t i = 0; i < faces.size(); ++i) {
            const Face& face = mFaces[faces[i]];
            if (face.least(x) > squared + kRounding) continue;
            const double own = mesh::squaredDistance(x, face.a, face.b, face.c);
            if (own >= squared) continue;
            squared = own;
            first = i;
        }
        std::swap(faces[0], faces[first]);
        return squared;
    }

    void keepNear(const dvec3& x, double radius, const Faces& from, Faces& to) const {
        to.clear();
        for (const std::uint32_t f : from)
            if (mFaces[f].least(x) <= radius * radius) to.push_back(f);
    }

    float signOf(const ivec3& voxel) const { return mSides.inside(voxel) ? -1.0f : 1.0f; }

    /// A brick whose every voxel is beyond the band.
    void begin(const ivec3& low, Bricks& found) const {
        found.low.push_back(low);
        for (int z = 0; z < volume::kBrick; ++z)
            for (int y = 0; y < volume::kBrick; ++y)
                for (int x = 0; x < volume::kBrick; ++x)
                    found.values.push_back(mFar *
                                           signOf(glm::min(low + ivec3(x, y, z), mSize - 1)));
    }

    /// The distance from x to the nearest curved face, which is one of those, and on which side of
    /// it x is.
    mesh::CurvedFace::Nearest nearestCurved(const dvec3& x, const Faces& faces) const {
        mesh::CurvedFace::Nearest best{std::numeric_limits<double>::max(), 0};
        double distance = std::sqrt(best.squared);
        for (const std::uint32_t f : faces) {
            const Face& face = mFaces[f];
            const double reach = distance + face.bulge + kRounding;
            if (face.least(x) > reach * reach) continue;
            const auto start = mCurved[f].flatNearest(x);
            if (start.squared > reach * reach) continue;
            const auto own = mCurved[f].nearest(x, start);
            const double apart = std::sqrt(own.squared) - distance;
            // Of two faces at whose edge the nearest point lies the one that x is more before or
            // behind tells the side.
            if (apart > kRounding ||
                (apart > -kRounding && std::abs(own.height) <= std::abs(best.height)))
                continue;
            best = own;
            distance = std::sqrt(best.squared);
        }
        return best;
    }

    void storeCurved(const ivec3& voxel, const Faces& faces, Bricks& found) const {
        const auto nearest = nearestCurved(dvec3(voxel), faces);
        const double distance = std::sqrt(nearest.squared);
        store(voxel, distance, found);
        // Columns counted the flat faces: between those and the curved ones they are wrong.
        if (distance > 2 * mBulge) return;
        float& value = valueAt(voxel, found);
        value = std::copysign(value, static_cast<float>(nearest.height));
    }

    void store(const ivec3& voxel, double distance, Bricks& found) const {
        float& value = valueAt(voxel, found);
        value = std::copysign(std::min(static_cast<float>(distance * mVoxelSize), mFar), value);
    }

    float& valueAt(const ivec3& voxel, Bricks& found) const {
        const ivec3 p = voxel - found.low.back();
        return found.values[found.values.size() - volume::kBrickVoxels +
                            static_cast<size_t>((p.z * 8 + p.y) * 8 + p.x)];
    }

    volume::BrickGrid gathered(const std::vector<Bricks>& blocks) const {
        volume::BrickGrid grid(mSize, ivec3(0), mFar);
        for (const Bricks& block : blocks) {
            for (size_t i = 0; i < block.low.size(); ++i)
                grid.page[grid.brickOf(block.low[i])] =
                    static_cast<std::int32_t>(grid.values.size() / volume::kBrickVoxels + i);
            grid.values.insert(grid.values.end(), block.values.begin(), block.values.end());
        }
        tbb::parallel_for(size_t{0}, grid.page.size(), [&](size_t brick) {
            if (grid.page[brick] < 0) grid.even[brick] *= signOf(grid.voxelOf(brick));
        });
        return grid;
    }

    // Faces are left out by more than doubles' rounding [voxel, and its square].
    static constexpr double kRounding = 1e-9;

    mesh::TriangleTree mTree;
    std::vector<Face> mFaces;
    std::vector<mesh::CurvedFace> mCurved; // of a mesh with normals
    double mBulge = 0;                     // the greatest of the faces'
    int mListed = kListed;                 // voxels an edge of cubes with lists
    const Sides& mSides;
    ivec3 mSize;
    double mHalfWidth, mVoxelSize;
    float mFar;
};

} // namespace

volume::BrickGrid signedDistances(const mesh::TriangleMesh& mesh, const Lattice& lattice,
                                  double halfWidth) {
    mesh::TriangleMesh surface = inVoxels(mesh, lattice);
    const Sides sides(surface, lattice.size);
    // Columns may miss that shells overlap by less than a voxel.
    if (sides.overlaps() || !isOneShell(surface)) {
        surface = mesh::solidBoundary(surface, kPiece);
        mesh::mergeIdenticalPoints(surface); // curves need to know which faces share an edge
    }
    return Band(surface, sides, lattice, halfWidth).measure();
}

} // namespace eikonal::voxelize
