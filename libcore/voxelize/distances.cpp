// Signed distances from voxels to a mesh's solid, exact within a band.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/distances.h"

#include "mesh/shells.h"
#include "mesh/solid_boundary.h"
#include "mesh/triangle_tree.h"
#include "voxelize/brick_distances.h"
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
// Where faces' longest sides are less [voxel] lists are longer than the way through the tree.
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

/// Measures the voxels of blocks that the band may reach.
class Band {
public:
    Band(const mesh::TriangleMesh& boundary, const Sides& sides, const Lattice& lattice,
         double halfWidth)
        : mTree(boundary), mFaces(boundary), mSides(sides), mSize(lattice.size),
          mHalfWidth(halfWidth), mVoxelSize(lattice.voxelSize),
          mFar(static_cast<float>(halfWidth * lattice.voxelSize)) {
        double sum = 0;
        for (const FaceFrame& face : mFaces.frames) sum += static_cast<double>(face.longest());
        mListed = sum < kFine * static_cast<double>(mFaces.frames.size()) ? 1 : volume::kBrick;
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
    /// Those of a block that the band reaches.
    struct Bricks {
        std::vector<ivec3> low;
        std::vector<float> values;
    };

    /// What one thread needs at a time.
    struct Work {
        BrickDistances distances;
        std::vector<std::uint32_t> near;
        Bricks& found;
    };

    void measureBlock(const ivec3& low, Bricks& found) const {
        Work work{BrickDistances(mFaces, mHalfWidth), {}, found};
        descend(low, kBlock, mesh::TriangleTree::kNone, work);
    }

    /// Halves a cube of voxels until it lies beyond the band or is small; `hint` is a face that was
    /// near the cube around it.
    void descend(const ivec3& low, int edge, std::uint32_t hint, Work& work) const {
        if (glm::any(glm::greaterThanEqual(low, mSize))) return;
        const dvec3 middle = dvec3(low) + (edge - 1) / 2.0;
        const double toCorner = std::sqrt(3.0) * (edge - 1) / 2,
                     reach = mHalfWidth + toCorner + mFaces.bulge;
        const auto nearest = mTree.nearest(middle, reach * reach, hint);
        if (nearest.face == mesh::TriangleTree::kNone) return;
        if (edge == volume::kBrick) begin(low, work.found);
        const double distance = std::sqrt(nearest.squared);
        if (edge == 1 && mFaces.bulge == 0) return store(low, distance, work.found);
        if (edge == mListed) {
            mTree.within(middle, distance + 2 * (toCorner + mFaces.bulge) + NearestFace::kRounding,
                         work.near);
            if (edge == 1) return storeCurved(low, nearestCurved(low, work.near), work.found);
            return measureBrick(low, work);
        }
        for (int i = 0; i < 8; ++i)
            descend(low + edge / 2 * ivec3(i & 1, i >> 1 & 1, i >> 2), edge / 2, nearest.face,
                    work);
    }

    void measureBrick(const ivec3& low, Work& work) const {
        const auto& distances = work.distances.measure(low, mSize, work.near);
        for (int i = 0; i < volume::kBrickVoxels; ++i) {
            const NearestFace& nearest = distances[static_cast<size_t>(i)];
            if (nearest.distance >= mHalfWidth) continue;
            const ivec3 voxel = low + ivec3(i % volume::kBrick, i / volume::kBrick % volume::kBrick,
                                            i / volume::kBrick / volume::kBrick);
            if (mFaces.bulge > 0)
                storeCurved(voxel, nearest, work.found);
            else
                store(voxel, nearest.distance, work.found);
        }
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

    NearestFace nearestCurved(const ivec3& voxel, const std::vector<std::uint32_t>& faces) const {
        const dvec3 x(voxel);
        NearestFace best;
        for (const std::uint32_t f : faces) {
            const mesh::CurvedFace face = mFaces.curved(f);
            const auto start = face.flatNearest(x);
            const double reach = best.distance + face.bulge() + NearestFace::kRounding;
            if (start.squared <= reach * reach) best.take(face.nearest(x, start));
        }
        return best;
    }

    void storeCurved(const ivec3& voxel, const NearestFace& nearest, Bricks& found) const {
        store(voxel, nearest.distance, found);
        // Columns counted the flat faces: between those and the curved ones they are wrong.
        if (nearest.distance > 2 * mFaces.bulge) return;
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

    mesh::TriangleTree mTree;
    BoundaryFaces mFaces;
    int mListed; // voxels an edge of cubes with lists
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
