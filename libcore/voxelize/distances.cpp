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
#include <optional>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace eikonal::voxelize {

namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kPiece = 1.0 / 16; // [voxel] where faces cross
constexpr int kBlock = 32;          // voxels along the edge of the cubes that are halved
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
        : mTree(boundary), mFaces(boundary, mTree.order()), mSides(sides), mSize(lattice.size),
          mHalfWidth(halfWidth), mVoxelSize(lattice.voxelSize),
          mFar(static_cast<float>(halfWidth * lattice.voxelSize)) {
        double sum = 0;
        for (const FaceFrame& face : mFaces.frames) sum += static_cast<double>(face.longest());
        mFine = sum < kFine * static_cast<double>(mFaces.frames.size());
    }

    volume::BrickGrid measure() const {
        volume::BrickGrid grid(mSize, ivec3(0), mFar);
        const std::vector<Brick> bricks = reached();
        grid.values.resize(bricks.size() * volume::kBrickVoxels);
        tbb::parallel_for(tbb::blocked_range<size_t>(0, bricks.size()), [&](const auto& range) {
            Work work{BrickDistances(mFaces, mHalfWidth), {}};
            for (size_t i = range.begin(); i < range.end(); ++i)
                measureBrick(bricks[i], grid.values.data() + i * volume::kBrickVoxels, work);
        });
        for (size_t i = 0; i < bricks.size(); ++i)
            grid.page[grid.brickOf(bricks[i].low)] = static_cast<std::int32_t>(i);
        tbb::parallel_for(size_t{0}, grid.page.size(), [&](size_t brick) {
            if (grid.page[brick] < 0) grid.even[brick] *= signOf(grid.voxelOf(brick));
        });
        return grid;
    }

private:
    /// One that the band may reach, and the face nearest to its middle.
    struct Brick {
        ivec3 low;
        mesh::TriangleTree::Nearest nearest;
    };
    /// What one thread needs at a time.
    struct Work {
        BrickDistances distances;
        std::vector<std::uint32_t> near;
    };

    /// The bricks that the band may reach.
    std::vector<Brick> reached() const {
        const ivec3 blocks = (mSize + kBlock - 1) / kBlock;
        std::vector<std::vector<Brick>> found(static_cast<size_t>(blocks.x) * blocks.y * blocks.z);
        tbb::parallel_for(size_t{0}, found.size(), [&](size_t i) {
            const auto n = static_cast<int>(i);
            const ivec3 block(n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y);
            descend(
                kBlock * block, kBlock, mesh::TriangleTree::kNone,
                [&](const ivec3& low, const mesh::TriangleTree::Nearest& nearest) {
                    found[i].push_back({low, nearest});
                },
                volume::kBrick);
        });
        std::vector<Brick> all;
        for (const std::vector<Brick>& some : found)
            all.insert(all.end(), some.begin(), some.end());
        return all;
    }

    /// Halves a cube of voxels until it lies beyond the band, or `act` takes it when its edge is
    /// `last`; `hint` is a face that was near the cube around it.
    template<typename Act>
    void descend(const ivec3& low, int edge, std::uint32_t hint, const Act& act, int last) const {
        if (glm::any(glm::greaterThanEqual(low, mSize))) return;
        const double reach = mHalfWidth + toCornerOf(edge) + mFaces.bulge;
        const auto nearest = mTree.nearest(middleOf(low, edge), reach * reach, hint);
        if (nearest.face == mesh::TriangleTree::kNone) return;
        if (edge == last) return act(low, nearest);
        for (int i = 0; i < 8; ++i)
            descend(low + edge / 2 * ivec3(i & 1, i >> 1 & 1, i >> 2), edge / 2, nearest.face, act,
                    last);
    }

    static dvec3 middleOf(const ivec3& low, int edge) { return dvec3(low) + (edge - 1) / 2.0; }
    static double toCornerOf(int edge) { return std::sqrt(3.0) * (edge - 1) / 2; }

    /// Those that may be nearest to a voxel of a cube.
    void listFaces(const ivec3& low, int edge, double squared,
                   std::vector<std::uint32_t>& faces) const {
        mTree.placesWithin(middleOf(low, edge),
                           std::sqrt(squared) + 2 * (toCornerOf(edge) + mFaces.bulge) +
                               NearestFace::kRounding,
                           faces);
    }

    void measureBrick(const Brick& brick, float* values, Work& work) const {
        fillFar(brick.low, values);
        if (mFine) {
            descend(
                brick.low, volume::kBrick, brick.nearest.face,
                [&](const ivec3& voxel, const mesh::TriangleTree::Nearest& nearest) {
                    measureVoxel(voxel, nearest.squared, valueOf(voxel - brick.low, values), work);
                },
                1);
            return;
        }
        listFaces(brick.low, volume::kBrick, brick.nearest.squared, work.near);
        const auto& distances = work.distances.measure(brick.low, mSize, work.near);
        for (size_t i = 0; i < distances.size(); ++i)
            if (distances[i].distance < mHalfWidth) store(distances[i], values[i]);
    }

    void measureVoxel(const ivec3& voxel, double squared, float& value, Work& work) const {
        NearestFace best;
        if (mFaces.bulge == 0) {
            best.distance = std::sqrt(squared);
            return store(best, value);
        }
        listFaces(voxel, 1, squared, work.near);
        const dvec3 x(voxel);
        for (const std::uint32_t f : work.near) {
            const mesh::CurvedFace face = mFaces.curved(f);
            const auto start = face.flatNearest(x);
            const double reach = best.distance + face.bulge() + NearestFace::kRounding;
            if (start.squared <= reach * reach) best.take(face.nearest(x, start));
        }
        store(best, value);
    }

    float signOf(const ivec3& voxel) const { return mSides.inside(voxel) ? -1.0f : 1.0f; }

    static float& valueOf(const ivec3& offset, float* values) {
        return values[(offset.z * volume::kBrick + offset.y) * volume::kBrick + offset.x];
    }

    /// As if all were beyond the band; those beyond the domain go on as its last.
    void fillFar(const ivec3& low, float* values) const {
        const ivec3 size = glm::min(mSize - low, ivec3(volume::kBrick));
        float signs[volume::kBrickVoxels];
        mSides.signsOf(low, size, signs);
        for (int z = 0; z < volume::kBrick; ++z)
            for (int y = 0; y < volume::kBrick; ++y)
                for (int x = 0; x < volume::kBrick; ++x) {
                    const ivec3 p = glm::min(ivec3(x, y, z), size - 1);
                    valueOf({x, y, z}, values) = mFar * signs[(p.z * size.y + p.y) * size.x + p.x];
                }
    }

    /// `value` has the side that columns found.
    void store(const NearestFace& nearest, float& value) const {
        value =
            std::copysign(std::min(static_cast<float>(nearest.distance * mVoxelSize), mFar), value);
        // Columns counted the flat faces: between those and the curved ones they are wrong.
        if (mFaces.bulge > 0 && nearest.distance <= 2 * mFaces.bulge)
            value = std::copysign(value, static_cast<float>(nearest.height));
    }

    mesh::TriangleTree mTree;
    BoundaryFaces mFaces;
    bool mFine; ///< each voxel goes down the tree
    const Sides& mSides;
    ivec3 mSize;
    double mHalfWidth, mVoxelSize;
    float mFar;
};

} // namespace

volume::BrickGrid signedDistances(const mesh::TriangleMesh& mesh, const Lattice& lattice,
                                  double halfWidth) {
    mesh::TriangleMesh surface = inVoxels(mesh, lattice);
    std::optional<Sides> sides;
    bool oneShell = false;
    tbb::parallel_invoke([&] { sides.emplace(surface, lattice.size); },
                         [&] { oneShell = isOneShell(surface); });
    // Columns may miss that shells overlap by less than a voxel.
    if (sides->overlaps() || !oneShell) {
        surface = mesh::solidBoundary(surface, kPiece);
        mesh::mergeIdenticalPoints(surface); // curves need to know which faces share an edge
    }
    return Band(surface, *sides, lattice, halfWidth).measure();
}

} // namespace eikonal::voxelize
