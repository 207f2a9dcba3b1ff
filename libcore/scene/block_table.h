// Where each object's blocks of cells stand in one table for all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/objects.h"

#include <cstdint>
#include <vector>

namespace eikonal::scene {

/// The blocks of cells that an object has entries for.
struct BlockRange {
    glm::ivec3 low{0}, size{0}; ///< [block]
    int begin = 0;              ///< of its entries, x fastest
};

/// Few objects have a table of the whole domain each, one behind the other along z. Of many each
/// has one of the box that its boundary and its inside are in; no other block is in it or near it.
struct BlockTable {
    explicit BlockTable(const std::vector<Object>& objects);

    std::vector<BlockRange> boxes; ///< per object
    glm::ivec3 size{0};            ///< of a texture that holds all entries, x fastest [texel]

    size_t entries() const { return static_cast<size_t>(size.x) * size.y * size.z; }
    /// The entry of an object's block, which is in its box.
    size_t at(size_t object, const glm::ivec3& block) const {
        const BlockRange& box = boxes[object];
        const glm::ivec3 in = block - box.low;
        return static_cast<size_t>(box.begin) +
               (static_cast<size_t>(in.z) * box.size.y + in.y) * box.size.x + in.x;
    }
};

/// The size of a texture for a list, as kernels find entries in it.
glm::ivec3 rowsFor(size_t entries);

} // namespace eikonal::scene
