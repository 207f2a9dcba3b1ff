// Fine voxels that opaque surfaces cross: where light on surfaces is stored.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface_voxels.h"

#include "base/error.h"
#include "scene/block_table.h"
#include "scene/shared.h"

#include <algorithm>
#include <bit>

namespace eikonal::scene {

namespace {

/// Entries of a table for so many voxels, a power of two: at most half of them are taken.
std::uint32_t entriesFor(std::int64_t voxels) {
    return std::bit_ceil(static_cast<std::uint32_t>(2 * voxels + 2));
}

/// How far a hash of 32 bits is shifted to be an entry's place.
std::uint32_t shiftFor(std::uint32_t entries) {
    return 32 - static_cast<std::uint32_t>(std::countr_zero(entries));
}

} // namespace

SurfaceVoxels::SurfaceVoxels(const glm::ivec3& domain, int edge,
                             const std::vector<std::uint32_t>& places,
                             const std::vector<std::uint32_t>& masks)
    : detail(edge), size(domain) {
    const auto words = static_cast<size_t>(maskWords(edge));
    for (size_t i = 0; i < places.size(); ++i) {
        const std::uint32_t* bits = masks.data() + i * words;
        std::int64_t found = 0;
        for (size_t w = 0; w < words; ++w) found += std::popcount(bits[w]);
        if (found == 0) continue;
        if (count + found > INT32_MAX)
            throw MemoryError("more than 2^31 fine voxels that opaque surfaces cross; lower "
                              "--surface-detail");
        voxels.push_back(places[i]);
        records.push_back(static_cast<std::uint32_t>(count));
        records.insert(records.end(), bits, bits + words);
        count += found;
    }
}

SurfaceTable::SurfaceTable(gpu::Device& device, const SurfaceVoxels& list) {
    const std::uint32_t entries = entriesFor(static_cast<std::int64_t>(list.voxels.size()));
    const std::uint32_t shift = shiftFor(entries);
    const auto words = static_cast<std::uint32_t>(maskWords(list.detail));
    std::vector<std::uint32_t> table(2 * static_cast<size_t>(entries), kNoVoxel);
    std::vector<std::uint32_t> records;
    records.reserve(2 * list.voxels.size() * words);
    for (size_t i = 0; i < list.voxels.size(); ++i) {
        const std::uint32_t key = list.voxels[i];
        std::uint32_t slot = key * 2654435769u >> shift;
        while (table[2 * static_cast<size_t>(slot)] != kNoVoxel) slot = (slot + 1) & (entries - 1);
        table[2 * static_cast<size_t>(slot)] = key;
        table[2 * static_cast<size_t>(slot) + 1] = static_cast<std::uint32_t>(i) * words;
        const std::uint32_t* record = list.records.data() + i * (words + 1);
        std::uint32_t number = record[0];
        for (std::uint32_t w = 1; w <= words; ++w) {
            records.push_back(record[w]);
            records.push_back(number);
            number += static_cast<std::uint32_t>(std::popcount(record[w]));
        }
    }
    SurfaceParams values{};
    values.size = ivec4(list.size, list.detail);
    values.table = uvec4(entries - 1, shift, words, static_cast<uint>(list.count));
    mParams = gpu::Buffer(device, sizeof values, &values);
    const auto rows = [&](std::vector<std::uint32_t>& pairs) {
        const glm::ivec3 size = rowsFor(std::max<size_t>(pairs.size() / 2, 1));
        pairs.resize(2 * static_cast<size_t>(size.x) * size.y * size.z);
        gpu::Texture texture(device, size, gpu::TexelFormat::rg32ui, gpu::Filter::nearest);
        texture.upload(pairs.data());
        return texture;
    };
    mTable = rows(table);
    mRecords = rows(records);
}

void SurfaceTable::bind() const {
    mParams.bindUniform(kSurfaceBlock);
    mTable.bindSampler(kSurfaceTableUnit);
    mRecords.bindSampler(kSurfaceRecordsUnit);
}

std::vector<gpu::Need> surfaceTableNeeds(std::int64_t voxels, int detail) {
    return {{"the table of surface voxels", std::int64_t{8} * entriesFor(voxels), false, 0},
            {"the surface voxels", 8 * voxels * maskWords(detail), false, 0}};
}

} // namespace eikonal::scene
