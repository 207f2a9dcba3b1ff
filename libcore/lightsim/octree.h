// The tolerance octree (Sun et al. 2008, §4.2, §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/lightsim.h"

#include <cstdint>
#include <vector>

namespace eikonal::lightsim {

/// For every 2×2×2 voxels the leaf that covers them, x fastest, packed by packLeaf().
struct Leaves {
    glm::ivec3 pairs{0};
    std::vector<std::uint32_t> packed;
};

Leaves makeLeaves(const Plan& plan, const Params& params);

/// A leaf as shaders/lib/octree.glsl unpacks it: its level, 0 to 31, in the low 5 bits, the step
/// limit [voxel] above them, cut to sixteenths and to 0 … 10^6.
std::uint32_t packLeaf(int level, float limit);

} // namespace eikonal::lightsim
