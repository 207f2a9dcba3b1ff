// The trees of VDB grids as they lie in files. Knows nothing of OpenVDB.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/vdb_bytes.h"
#include "volume/volume.h"

#include <optional>
#include <string>

namespace eikonal::volume {

/// How a tree's values are stored.
struct TreeLayout {
    enum class Leaves { values, bits, mask };

    Leaves leaves = Leaves::values;
    std::uint64_t valueBytes = 0;  ///< of a background, a tile, an inactive value
    std::uint64_t storedBytes = 0; ///< of a value in a node's array: less if stored in half
    bool half = false;
    std::uint32_t compression = 0;
};

/// The layout of a grid type such as "Tree_float_5_4_3", or nothing if it is not known.
std::optional<TreeLayout> layoutOf(const std::string& type, bool half, std::uint32_t compression);

struct TreeFacts {
    IndexBox active;
    std::uint64_t buffers = 0; ///< where the leaves' values begin
};

/// Walks through a tree: every count and length against what is left and what a node can hold.
/// Leaves the reader behind it. Throws VdbDamage.
TreeFacts walkTree(ByteReader& in, const TreeLayout& layout);

} // namespace eikonal::volume
