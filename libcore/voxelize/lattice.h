// The voxels of a domain, and the samples in them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

namespace eikonal::voxelize {

/// The voxels of the domain, and how finely each is sampled. Sub-sample k of voxel i lies at
/// i - 1/2 + (k + 1/2) / supersample along each axis [voxel].
struct Lattice {
    glm::dvec3 low{0};    ///< the domain's low corner in the world [unit]
    double voxelSize = 1; ///< [unit]
    glm::ivec3 size{1};   ///< [voxel]
    int supersample = 4;  ///< 1, 2, 4 or 8

    /// The power of two at or above the longer of the edges drawn, x and y [sample].
    int view() const {
        return static_cast<int>(
            std::bit_ceil(static_cast<unsigned>(std::max(size.x, size.y) * supersample)));
    }
    /// Sub-samples in a voxel.
    int most() const { return supersample * supersample * supersample; }
};

// The device's largest share of the volume at once: every OpenGL 4.5 device allows a storage
// buffer this large, so that all work in the same strips.
constexpr std::int64_t kStripBytes = std::int64_t{1} << 27;

/// The same of so many objects: the host may have two bytes for each in every voxel of a strip.
constexpr std::int64_t stripBytesFor(size_t objects) {
    return kStripBytes / std::max<std::int64_t>(1, static_cast<std::int64_t>(objects) / 8);
}

} // namespace eikonal::voxelize
