// Signed distances from voxels to a mesh's solid, exact within a band.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/distances.h"

#include "mesh/shells.h"
#include "mesh/solid_boundary.h"
#include "mesh/triangle_tree.h"
#include "voxelize/insides.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <tbb/blocked_range3d.h>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kPiece = 1.0 / 16; // [voxel] where faces cross
constexpr int kBlock = 32;          // voxels along the edge of what one thread does at a time

/// The mesh in index space [voxel], where voxel i's middle is at i.
mesh::TriangleMesh inVoxels(const mesh::TriangleMesh& mesh, const Lattice& lattice) {
    mesh::TriangleMesh out{{}, mesh.triangles};
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
    Band(const mesh::TriangleMesh& boundary, double halfWidth, double voxelSize,
         volume::DenseGrid& values)
        : mTree(boundary), mHalfWidth(halfWidth), mVoxelSize(voxelSize), mValues(values) {}

    void measure() const {
        const ivec3 blocks = (mValues.size + kBlock - 1) / kBlock;
        tbb::parallel_for(tbb::blocked_range3d<int>(0, blocks.z, 0, blocks.y, 0, blocks.x),
                          [&](const tbb::blocked_range3d<int>& some) {
                              for (int z = some.pages().begin(); z < some.pages().end(); ++z)
                                  for (int y = some.rows().begin(); y < some.rows().end(); ++y)
                                      for (int x = some.cols().begin(); x < some.cols().end(); ++x)
                                          measure(kBlock * ivec3(x, y, z), kBlock,
                                                  mesh::TriangleTree::kNone);
                          });
    }

private:
    /// Halves a cube of voxels until it lies beyond the band or is one voxel; `hint` is a face that
    /// was near the cube around it.
    void measure(const ivec3& low, int edge, std::uint32_t hint) const {
        if (glm::any(glm::greaterThanEqual(low, mValues.size))) return;
        const double toCorner = std::sqrt(3.0) * (edge - 1) / 2, reach = mHalfWidth + toCorner;
        const auto found = mTree.nearest(dvec3(low) + (edge - 1) / 2.0, reach * reach, hint);
        if (found.face == mesh::TriangleTree::kNone) return;
        if (edge == 1) {
            float& value =
                mValues
                    .values[(static_cast<size_t>(low.z) * mValues.size.y + low.y) * mValues.size.x +
                            low.x];
            const auto distance = static_cast<float>(std::sqrt(found.squared) * mVoxelSize);
            value = std::min(distance, std::abs(value)) * (value < 0 ? -1.0f : 1.0f);
            return;
        }
        for (int i = 0; i < 8; ++i)
            measure(low + edge / 2 * ivec3(i & 1, i >> 1 & 1, i >> 2), edge / 2, found.face);
    }

    mesh::TriangleTree mTree;
    double mHalfWidth, mVoxelSize;
    volume::DenseGrid& mValues;
};

} // namespace

volume::DenseGrid signedDistances(const mesh::TriangleMesh& mesh, const Lattice& lattice,
                                  double halfWidth) {
    volume::DenseGrid values;
    values.size = lattice.size;
    values.values.resize(static_cast<size_t>(lattice.size.x) * lattice.size.y * lattice.size.z);
    mesh::TriangleMesh surface = inVoxels(mesh, lattice);
    const bool overlaps =
        fillSides(surface, static_cast<float>(halfWidth * lattice.voxelSize), values);
    // Columns may miss that shells overlap by less than a voxel.
    if (overlaps || !isOneShell(surface)) surface = mesh::solidBoundary(surface, kPiece);
    Band(surface, halfWidth, lattice.voxelSize, values).measure();
    return values;
}

} // namespace eikonal::voxelize
