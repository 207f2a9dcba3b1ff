// Signed distances as an OpenVDB grid.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/level_set.h"

#include <cmath>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const DenseGrid& values,
                                     float halfWidth) {
    auto grid = openvdb::FloatGrid::create(halfWidth);
    const openvdb::CoordBBox where(openvdb::Coord(box.min.x, box.min.y, box.min.z),
                                   openvdb::Coord(box.max.x, box.max.y, box.max.z));
    const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
        where, const_cast<float*>(values.values.data()));
    openvdb::tools::copyFromDense(dense, *grid, 0.0f);
    auto tile = grid->beginValueOn();
    tile.setMaxDepth(openvdb::FloatTree::ValueOnIter::LEAF_DEPTH - 1);
    for (; tile; ++tile)
        if (!(std::abs(*tile) < halfWidth)) {
            tile.setValue(*tile < 0 ? -halfWidth : halfWidth);
            tile.setActiveState(false);
        }
    std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
    grid->tree().getNodes(leaves);
    tbb::parallel_for(size_t{0}, leaves.size(), [&](size_t i) {
        for (auto voxel = leaves[i]->beginValueAll(); voxel; ++voxel) {
            const float value = *voxel;
            if (std::abs(value) < halfWidth)
                voxel.setValueOn();
            else
                leaves[i]->setValueOff(voxel.pos(), value < 0 ? -halfWidth : halfWidth);
        }
    });
    openvdb::tools::pruneLevelSet(grid->tree());
    return grid;
}

} // namespace eikonal::volume
