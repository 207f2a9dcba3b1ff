// Where each object's blocks of cells stand in one table for all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/block_table.h"

#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <glm/common.hpp>

namespace eikonal::scene {

using glm::ivec3;

namespace {

/// The box of blocks that are in the object or near its boundary.
volume::IndexBox blocksOf(const Object& object) {
    const ivec3 blocks = cellBlocks(object.distance.size);
    volume::IndexBox box;
    for (const std::uint32_t cell : object.cells) {
        const ivec3 block = atPlace(blocks, cell);
        box.include({block, block});
    }
    // A voxel is a corner of the cells on both its sides.
    if (!object.inside.empty())
        box.include({object.inside.min >> volume::kBrickBits,
                     glm::min((object.inside.max + 1) >> volume::kBrickBits, blocks - 1)});
    return box;
}

} // namespace

ivec3 rowsFor(size_t entries) {
    constexpr size_t kRow = size_t{1} << kRowBits;
    const auto over = [](size_t a, size_t b) { return (a + b - 1) / b; };
    const size_t x = std::clamp(entries, size_t{1}, kRow);
    const size_t y = std::clamp(over(entries, kRow), size_t{1}, kRow);
    const size_t z = std::max(over(entries, kRow * kRow), size_t{1});
    return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
}

BlockTable::BlockTable(const std::vector<Object>& objects) {
    const ivec3 all = cellBlocks(objects.front().distance.size);
    const bool many = areMany(objects);
    int entries = 0;
    for (const Object& object : objects) {
        BlockRange box{ivec3(0), all, entries};
        if (many) {
            const volume::IndexBox blocks = blocksOf(object);
            box = blocks.empty() ? BlockRange{ivec3(0), ivec3(0), entries}
                                 : BlockRange{blocks.min, blocks.size(), entries};
        }
        boxes.push_back(box);
        entries += box.size.x * box.size.y * box.size.z;
    }
    size = many ? rowsFor(static_cast<size_t>(entries))
                : ivec3(all.x, all.y, all.z * static_cast<int>(objects.size()));
}

} // namespace eikonal::scene
