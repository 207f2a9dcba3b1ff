// Scalar grids as bricks: out of OpenVDB's trees.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/bricks.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/entries.h"

#include <algorithm>
#include <glm/common.hpp>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

namespace {

using glm::ivec3;

/// Voxel (x, y, z) of a leaf is at 64 x + 8 y + z.
template<typename Leaf> void copyLeaf(const Leaf& leaf, float* out) {
    const auto* in = leaf.buffer().data();
    for (int z = 0; z < kBrick; ++z)
        for (int y = 0; y < kBrick; ++y)
            for (int x = 0; x < kBrick; ++x)
                *out++ = static_cast<float>(in[kBrick * (kBrick * x + y) + z]);
}

template<typename Grid>
void fill(const openvdb::GridBase& base, const IndexBox& box, BrickGrid& out) {
    const auto& tree = static_cast<const Grid&>(base).tree();
    using Leaf = typename Grid::TreeType::LeafNodeType;
    std::vector<const Leaf*> leaves(out.page.size());
    tbb::parallel_for(0, out.bricks.z, [&](int z) {
        typename Grid::ConstAccessor accessor(tree);
        size_t brick = static_cast<size_t>(z) * out.bricks.y * out.bricks.x;
        for (int y = 0; y < out.bricks.y; ++y)
            for (int x = 0; x < out.bricks.x; ++x, ++brick) {
                const ivec3 p = box.min + out.first + kBrick * ivec3(x, y, z);
                const openvdb::Coord at(p.x, p.y, p.z);
                leaves[brick] = accessor.template probeConstNode<Leaf>(at);
                if (!leaves[brick]) out.even[brick] = static_cast<float>(accessor.getValue(at));
            }
    });
    std::vector<size_t> uneven;
    for (size_t brick = 0; brick < leaves.size(); ++brick)
        if (leaves[brick]) {
            out.page[brick] = static_cast<std::int32_t>(uneven.size());
            uneven.push_back(brick);
        }
    out.values.resize(uneven.size() * kBrickVoxels);
    tbb::parallel_for(size_t{0}, uneven.size(), [&](size_t i) {
        copyLeaf(*leaves[uneven[i]], out.values.data() + i * kBrickVoxels);
    });
}

/// The first voxel of a brick within the box whose value breaks the rule, and how.
std::optional<std::string> faultOf(const GridRule* rule, const BrickGrid& grid, size_t brick,
                                   const IndexBox& box) {
    const bool even = grid.page[brick] < 0;
    const float* values =
        even ? &grid.even[brick]
             : grid.values.data() + static_cast<size_t>(grid.page[brick]) * kBrickVoxels;
    for (int i = 0; i < (even ? 1 : kBrickVoxels); ++i) {
        const auto wrong = fault(rule, values[i]);
        if (!wrong) continue;
        ivec3 p = grid.voxelOf(brick) + ivec3(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick);
        if (even) p = glm::max(p, ivec3(0));
        if (p != glm::clamp(p, ivec3(0), grid.size - 1)) continue;
        const ivec3 voxel = p + box.min;
        return "voxel (" + std::to_string(voxel.x) + ", " + std::to_string(voxel.y) + ", " +
               std::to_string(voxel.z) + ") " + *wrong;
    }
    return std::nullopt;
}

/// Throws DataError for the first value within the box that breaks the rule.
void check(const GridRule* rule, const BrickGrid& grid, const IndexBox& box,
           const std::string& where) {
    const size_t plane = static_cast<size_t>(grid.bricks.x) * grid.bricks.y;
    std::vector<std::string> faults(static_cast<size_t>(grid.bricks.z));
    tbb::parallel_for(size_t{0}, faults.size(), [&](size_t z) {
        for (size_t brick = z * plane; brick < (z + 1) * plane; ++brick)
            if (const auto wrong = faultOf(rule, grid, brick, box)) {
                faults[z] = *wrong;
                return;
            }
    });
    for (const std::string& wrong : faults)
        if (!wrong.empty()) throw DataError(where + ": " + wrong);
}

} // namespace

BrickGrid::BrickGrid(const ivec3& boxSize, const ivec3& firstVoxel, float value, int perVoxel)
    : components(perVoxel), size(boxSize), first(firstVoxel),
      bricks((boxSize - firstVoxel + kBrick - 1) / kBrick) {
    const size_t count = static_cast<size_t>(bricks.x) * bricks.y * bricks.z;
    page.assign(count, -1);
    even.assign(count * static_cast<size_t>(components), value);
}

bool BrickGrid::isCut(size_t brick) const {
    const ivec3 low = voxelOf(brick);
    return low != glm::max(low, ivec3(0)) || low + kBrick != glm::min(low + kBrick, size);
}

ivec3 BrickGrid::voxelOf(size_t brick) const {
    const auto b = static_cast<int>(brick);
    return first + kBrick * ivec3(b % bricks.x, b / bricks.x % bricks.y, b / bricks.x / bricks.y);
}

BrickGrid Volume::bricks(const std::string& grid, const IndexBox& box) const {
    require(grid);
    Entry& entry = mImpl->numbers(grid);
    if (entry.type != GridType::scalar)
        throw InternalError(mImpl->where(grid) + ": bricks are of scalars");
    const ivec3 low(box.min.x & (kBrick - 1), box.min.y & (kBrick - 1), box.min.z & (kBrick - 1));
    try {
        BrickGrid out(box.size(), -low, 0);
        if (entry.grid->isType<openvdb::FloatGrid>())
            fill<openvdb::FloatGrid>(*entry.grid, box, out);
        else
            fill<openvdb::DoubleGrid>(*entry.grid, box, out);
        check(ruleFor(grid), out, box, mImpl->where(grid));
        return out;
    } catch (const std::bad_alloc&) {
        throw MemoryError(mImpl->where(grid) + " needs more memory than there is");
    }
}

} // namespace eikonal::volume
