// What tables of voxels share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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

} // namespace eikonal::scene
