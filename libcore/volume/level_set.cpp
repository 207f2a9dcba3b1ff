// Signed distances as an OpenVDB grid.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/level_set.h"

#include <cmath>
#include <glm/common.hpp>
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

openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const BrickGrid& values,
                                     float halfWidth) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    auto grid = openvdb::FloatGrid::create(halfWidth);
    const auto coordOf = [&](size_t brick) {
        const glm::ivec3 p = box.min + values.voxelOf(brick);
        return openvdb::Coord(p.x, p.y, p.z);
    };
    const auto inside = [&](size_t brick) { return values.even[brick] < 0; };
    std::vector<size_t> uneven; // or inside where the box ends within them
    for (size_t brick = 0; brick < values.page.size(); ++brick)
        if (values.page[brick] >= 0 || (inside(brick) && values.isCut(brick)))
            uneven.push_back(brick);
        else if (inside(brick))
            grid->tree().addTile(1, coordOf(brick), -halfWidth, false);
    std::vector<Leaf*> leaves(uneven.size());
    tbb::parallel_for(size_t{0}, uneven.size(), [&](size_t i) {
        const openvdb::Coord low = coordOf(uneven[i]);
        leaves[i] = new Leaf(low, halfWidth, false);
        const glm::ivec3 first = values.voxelOf(uneven[i]);
        const glm::ivec3 from = glm::max(-first, glm::ivec3(0));
        const glm::ivec3 to = glm::min(values.size - first, glm::ivec3(kBrick));
        for (int x = from.x; x < to.x; ++x)
            for (int y = from.y; y < to.y; ++y)
                for (int z = from.z; z < to.z; ++z) {
                    const float value = *values.valuesAt(uneven[i], (z * kBrick + y) * kBrick + x);
                    const openvdb::Index at = Leaf::coordToOffset(openvdb::Coord(x, y, z));
                    if (std::abs(value) < halfWidth)
                        leaves[i]->setValueOn(at, value);
                    else
                        leaves[i]->setValueOff(at, value < 0 ? -halfWidth : halfWidth);
                }
    });
    for (Leaf* leaf : leaves) grid->tree().addLeaf(leaf);
    openvdb::tools::pruneLevelSet(grid->tree());
    return grid;
}

} // namespace eikonal::volume
