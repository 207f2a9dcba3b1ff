// What tables of voxels share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace eikonal::scene {

/// From the centre of a cube to its corner, by its edge; rounded up.
constexpr float kCornerWay = 0.8661f;

/// Where (x, y, z) is in an array of that size, x fastest.
inline size_t placeOf(const glm::ivec3& size, int x, int y, int z) {
    return (static_cast<size_t>(z) * size.y + y) * size.x + x;
}

/// (x, y, z) of a place.
inline glm::ivec3 atPlace(const glm::ivec3& size, size_t place) {
    const auto i = static_cast<int>(place);
    return {i % size.x, i / size.x % size.y, i / size.x / size.y};
}

/// Every device takes textures of so many texels an edge.
constexpr int kMostTexels = 2048;

/// How many blocks of that many texels lie along each axis of an atlas of `count` of them. It is
/// narrow along x, so that a block's rows are close to each other in memory; no edge is above
/// kMostTexels.
inline glm::ivec3 atlasOf(std::int64_t count, const glm::ivec3& block) {
    const glm::ivec3 most = glm::ivec3(kMostTexels) / block;
    const auto over = [](std::int64_t a, std::int64_t b) {
        return static_cast<int>((a + b - 1) / b);
    };
    const int x = over(std::max<std::int64_t>(count, 1), std::int64_t{most.y} * most.z);
    const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count) / x)));
    const int y = std::clamp(std::max(side, over(count, std::int64_t{x} * most.z)), 1, most.y);
    return {x, y, std::max(over(count, std::int64_t{x} * y), 1)};
}

} // namespace eikonal::scene
