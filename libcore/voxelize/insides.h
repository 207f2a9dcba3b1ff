// Which voxels' middles lie inside a mesh, decided by columns along z.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace eikonal::voxelize {

/// Which voxels' middles lie inside a mesh: where the surface winds around them more than 0 times,
/// as Coverage counts. `mesh` is closed, in index space [voxel].
///
/// A plane of voxels along x and z cuts the mesh in closed chains of segments. Both faces of an
/// edge find the same end of their segments, to the bit, and a column belongs to the half-open
/// span of one segment of a chain: so no crossing is lost or doubled at an edge or a corner.
class Sides {
public:
    Sides(const mesh::TriangleMesh& mesh, const glm::ivec3& size);

    /// Whether the surface winds around some column's points other than 0 or 1 times: then shells
    /// overlap, or faces cross.
    bool overlaps() const { return mOverlaps; }
    bool inside(const glm::ivec3& voxel) const;
    /// The same of a box of voxels, x fastest: −1 inside, else 1.
    void signsOf(const glm::ivec3& low, const glm::ivec3& size, float* signs) const;

private:
    struct Row {
        std::vector<std::uint32_t> ends; ///< per column, of its changes
        std::vector<int> changes;        ///< the first voxels along z on the other side, ascending
    };
    std::vector<Row> mRows; ///< along y
    bool mOverlaps = false;
};

} // namespace eikonal::voxelize
