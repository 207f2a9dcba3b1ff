// A grid as bricks of voxels, most of which are one value everywhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::volume {

/// Voxels along a brick's edge, as of OpenVDB's leaves.
constexpr int kBrickBits = 3;
constexpr int kBrick = 1 << kBrickBits;
constexpr int kBrickVoxels = kBrick * kBrick * kBrick;

/// Values at voxels of a box, whose first is at the origin. Bricks lie where OpenVDB's leaves do,
/// so that the first of them may begin before the box.
struct BrickGrid {
    int components = 1;
    glm::ivec3 size{0};             ///< of the box [voxel]
    glm::ivec3 first{0};            ///< of the first brick's first voxel, −7 to 0
    glm::ivec3 bricks{0};           ///< along each axis
    std::vector<std::int32_t> page; ///< per brick, x fastest: its place in `values`; −1: it is even
    std::vector<float> even;        ///< per brick and component: its value where it is even
    std::vector<float> values;      ///< kBrickVoxels each, x fastest, components interleaved

    BrickGrid() = default;
    /// All bricks are even, of that value.
    BrickGrid(const glm::ivec3& size, const glm::ivec3& first, float value, int components = 1);

    size_t brickOf(const glm::ivec3& voxel) const {
        const glm::ivec3 b = (voxel - first) >> kBrickBits;
        return (static_cast<size_t>(b.z) * bricks.y + b.y) * bricks.x + b.x;
    }
    /// The value at a voxel of the box.
    float at(const glm::ivec3& voxel, int component = 0) const {
        const size_t brick = brickOf(voxel);
        const auto c = static_cast<size_t>(component), count = static_cast<size_t>(components);
        if (page[brick] < 0) return even[brick * count + c];
        const glm::ivec3 p = (voxel - first) & (kBrick - 1);
        const auto place = static_cast<size_t>((p.z * kBrick + p.y) * kBrick + p.x);
        return values[(static_cast<size_t>(page[brick]) * kBrickVoxels + place) * count + c];
    }
    /// The one value of a brick that is even, else its kBrickVoxels values; outside the box too.
    const float* valuesOf(size_t brick) const;
    /// The values of one of a brick's voxels, x fastest.
    const float* valuesAt(size_t brick, int voxel) const {
        return valuesOf(brick) + (page[brick] < 0 ? 0 : voxel * components);
    }
    /// Whether the box ends within a brick.
    bool isCut(size_t brick) const;
    /// The box's values of row (y, z), x from 0 on, of a grid of one component.
    void copyRow(int y, int z, float* out) const { copyBox({0, y, z}, {size.x, 1, 1}, out); }
    /// The values of a part, x fastest, whose first voxel is `low`; beyond the box those of its
    /// nearest voxels. Of a grid of one component.
    void copyBox(const glm::ivec3& low, const glm::ivec3& edges, float* out) const;
    /// Calls `visit(values)` with a brick's values within the box: once for an even one,
    /// else of each voxel, `components` floats.
    template<typename Visit> void forEachValue(size_t brick, const Visit& visit) const;
    /// The first voxel of a brick; of one at the rim it may lie outside the box.
    glm::ivec3 voxelOf(size_t brick) const;
};

template<typename Visit> void BrickGrid::forEachValue(size_t brick, const Visit& visit) const {
    const float* all = valuesOf(brick);
    if (page[brick] < 0) return visit(all);
    const glm::ivec3 low = voxelOf(brick);
    const glm::ivec3 from = glm::max(-low, glm::ivec3(0));
    const glm::ivec3 to = glm::min(size - low, glm::ivec3(kBrick));
    for (int z = from.z; z < to.z; ++z)
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x)
                visit(all + static_cast<size_t>((z * kBrick + y) * kBrick + x) * components);
}

} // namespace eikonal::volume
