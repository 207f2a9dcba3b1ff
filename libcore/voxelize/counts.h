// How many samples of each voxel lie inside an object, by bricks.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/bricks.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::voxelize {

/// The counts of a strip of rows, which begin with a brick's. Most bricks are even: wholly inside
/// or outside.
struct Counts {
    glm::ivec3 size{0};                ///< of the strip [voxel]
    glm::ivec3 bricks{0};              ///< along each axis
    std::vector<std::int32_t> page;    ///< per brick, x fastest: its place in `values`; −1: even
    std::vector<std::uint16_t> even;   ///< per brick: the count of its voxels where it is even
    std::vector<std::uint16_t> values; ///< volume::kBrickVoxels each, x fastest

    Counts() = default;
    explicit Counts(const glm::ivec3& strip)
        : size(strip), bricks((strip + volume::kBrick - 1) / volume::kBrick),
          page(static_cast<size_t>(bricks.x) * bricks.y * bricks.z, -1), even(page.size(), 0) {}

    size_t brickAt(const glm::ivec3& brick) const {
        return (static_cast<size_t>(brick.z) * bricks.y + brick.y) * bricks.x + brick.x;
    }
    bool isEven(size_t brick) const { return page[brick] < 0; }
    /// Of a brick's voxel, x fastest.
    std::uint16_t at(size_t brick, size_t voxel) const {
        if (isEven(brick)) return even[brick];
        return values[static_cast<size_t>(page[brick]) * volume::kBrickVoxels + voxel];
    }
};

} // namespace eikonal::voxelize
