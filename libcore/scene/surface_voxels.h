// Fine voxels that opaque surfaces cross: where light on surfaces is stored.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::scene {

/// Most fine voxels along an edge of a voxel.
constexpr int kMostDetail = 8;

/// A list of them, as shaders/transport/surface_voxels.glsl reads it.
struct SurfaceVoxels {
    int detail = 1;     ///< fine voxels along an edge of a voxel
    glm::ivec3 size{0}; ///< voxels of the domain
    /// Voxels of the domain that have any: their places, x fastest, ascending.
    std::vector<std::uint32_t> voxels;
    /// Of each: the number of its first one, then a bit for each of its detail³ ones, x fastest.
    std::vector<std::uint32_t> records;
    std::int64_t count = 0; ///< surface voxels in all

    SurfaceVoxels() = default;
    /// `masks` has the bits of each of `places`, ascending, maskWords(detail) words each; places
    /// without any are left out. Throws MemoryError for more than 2^31 surface voxels.
    SurfaceVoxels(const glm::ivec3& size, int detail, const std::vector<std::uint32_t>& places,
                  const std::vector<std::uint32_t>& masks);

    /// Calls `visit(number, fine voxel)` for each in the order of their numbers.
    template<typename Visit> void forEach(const Visit& visit) const;
};

/// Words that hold a bit for each of a voxel's fine ones.
constexpr int maskWords(int detail) {
    return (detail * detail * detail + 31) / 32;
}

/// The list on the device.
class SurfaceTable {
public:
    SurfaceTable() = default;
    SurfaceTable(gpu::Device& device, const SurfaceVoxels& list);
    /// At the bindings of shaders/shared/bindings.h.
    void bind() const;

private:
    gpu::Buffer mParams;
    gpu::Texture mTable, mRecords;
};

/// What the list takes on the device with so many voxels of the domain in it.
std::vector<gpu::Need> surfaceTableNeeds(std::int64_t voxels, int detail);

template<typename Visit> void SurfaceVoxels::forEach(const Visit& visit) const {
    const int words = maskWords(detail);
    std::uint32_t number = 0;
    for (size_t i = 0; i < voxels.size(); ++i) {
        const std::uint32_t* bits = records.data() + i * static_cast<size_t>(words + 1) + 1;
        const auto place = static_cast<std::int64_t>(voxels[i]);
        const glm::ivec3 low =
            detail * glm::ivec3(place % size.x, place / size.x % size.y, place / size.x / size.y);
        for (int k = 0; k < detail * detail * detail; ++k)
            if ((bits[k >> 5] >> (k & 31) & 1u) != 0)
                visit(number++,
                      low + glm::ivec3(k % detail, k / detail % detail, k / (detail * detail)));
    }
}

} // namespace eikonal::scene
