// Grids by bricks, made voxel by voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/bricks.h"

#include <tbb/parallel_for.h>

namespace eikonal::volume {

/// A grid of what `value(voxel, out)` says, once for a brick that `isEven(brick)`. Beyond the box a
/// brick goes on as the box's nearest voxels.
template<typename IsEven, typename Value>
BrickGrid makeBricks(const glm::ivec3& size, const glm::ivec3& first, int components,
                     const IsEven& isEven, const Value& value) {
    BrickGrid grid(size, first, 0, components);
    const auto count = static_cast<size_t>(components);
    std::vector<size_t> uneven;
    for (size_t brick = 0; brick < grid.page.size(); ++brick) {
        const glm::ivec3 low = grid.voxelOf(brick);
        if (isEven(brick)) {
            value(glm::max(low, glm::ivec3(0)), grid.even.data() + brick * count);
            continue;
        }
        grid.page[brick] = static_cast<std::int32_t>(uneven.size());
        uneven.push_back(brick);
    }
    grid.values.resize(uneven.size() * kBrickVoxels * count);
    tbb::parallel_for(size_t{0}, uneven.size(), [&](size_t i) {
        const glm::ivec3 low = grid.voxelOf(uneven[i]);
        float* out = grid.values.data() + i * kBrickVoxels * count;
        for (int z = 0; z < kBrick; ++z)
            for (int y = 0; y < kBrick; ++y)
                for (int x = 0; x < kBrick; ++x, out += count)
                    value(glm::clamp(low + glm::ivec3(x, y, z), glm::ivec3(0), size - 1), out);
    });
    return grid;
}

} // namespace eikonal::volume
