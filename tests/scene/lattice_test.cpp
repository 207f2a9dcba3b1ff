// Atlases of blocks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/lattice.h"

#include <gtest/gtest.h>

using namespace eikonal;
using glm::ivec3;

TEST(Atlas, HoldsItsBlocksWithinWhatDevicesTake) {
    for (const ivec3& block :
         {ivec3(8), ivec3(8, 8, 32), ivec3(8, 8, 56), ivec3(9), ivec3(3, 11, 11)})
        for (const std::int64_t count : {1, 2, 2000, 2700, 3024, 50'000, 300'000, 1'500'000}) {
            const ivec3 bricks = scene::atlasOf(count, block);
            EXPECT_GE(std::int64_t{bricks.x} * bricks.y * bricks.z, count);
            // Hardly more than it must, where there are many.
            if (count >= 2000) {
                EXPECT_LT(std::int64_t{bricks.x} * bricks.y * bricks.z, count + count / 10)
                    << count;
            }
            const ivec3 most = ivec3(scene::kMostTexels) / block;
            if (std::int64_t{most.x} * most.y * most.z < count) continue; // no atlas holds them
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_LE(bricks[axis] * block[axis], scene::kMostTexels) << count << " " << axis;
        }
}
