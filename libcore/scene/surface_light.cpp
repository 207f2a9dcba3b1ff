// Light that lightsim stored on opaque surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/surface_light.h"

#include "base/error.h"
#include "scene/block_table.h"
#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/parallel_sort.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using volume::FineGrid;

/// A fine voxel by the place of the domain's voxel that it is in, then by its own in that.
struct Key {
    std::uint32_t place, within;
    auto operator<=>(const Key&) const = default;
};

Key keyOf(const ivec3& fine, int detail, const ivec3& size) {
    const ivec3 voxel = fine / detail, in = fine - voxel * detail;
    return {static_cast<std::uint32_t>(placeOf(size, voxel.x, voxel.y, voxel.z)),
            static_cast<std::uint32_t>((in.z * detail + in.y) * detail + in.x)};
}

/// Entries of a grid by ascending key; what lies outside the domain is left out.
std::vector<std::pair<Key, glm::vec3>> sorted(const FineGrid& grid, const ivec3& size) {
    std::vector<std::pair<Key, glm::vec3>> entries;
    entries.reserve(grid.voxels.size());
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const ivec3 fine = grid.voxels[i];
        if (glm::all(glm::greaterThanEqual(fine, ivec3(0))) &&
            glm::all(glm::lessThan(fine, size * grid.detail)))
            entries.emplace_back(keyOf(fine, grid.detail, size), grid.values[i]);
    }
    tbb::parallel_sort(entries.begin(), entries.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
    return entries;
}

/// Adds a grid's light to that of the finest one.
void add(SurfaceLight& light, const FineGrid& grid) {
    const auto entries = sorted(grid, light.voxels.size);
    const double scale = static_cast<double>(grid.detail) / light.voxels.detail;
    light.voxels.forEach([&](std::uint32_t number, const ivec3& fine) {
        const ivec3 there((glm::dvec3(fine) + 0.5) * scale);
        const Key key = keyOf(there, grid.detail, light.voxels.size);
        const auto found = std::lower_bound(
            entries.begin(), entries.end(), key,
            [](const auto& entry, const Key& wanted) { return entry.first < wanted; });
        if (found != entries.end() && found->first == key) light.values[number] += found->second;
    });
}

} // namespace

bool SurfaceLight::grey() const {
    return std::all_of(values.begin(), values.end(),
                       [](const glm::vec3& v) { return v.x == v.y && v.y == v.z; });
}

SurfaceLight readSurfaceLight(const Files& files) {
    std::vector<FineGrid> grids;
    for (const volume::Volume* volume : files.all()) {
        FineGrid grid = volume->fine("irradiance", files.domain());
        if (!grid.voxels.empty()) grids.push_back(std::move(grid));
    }
    SurfaceLight light;
    if (grids.empty()) return light;
    const auto finest =
        std::max_element(grids.begin(), grids.end(),
                         [](const auto& a, const auto& b) { return a.detail < b.detail; });
    const ivec3 size = files.domain().size();
    if (files.domain().voxels() >= std::int64_t{1} << 32)
        throw MemoryError(files.path() + ": light on surfaces in more than 2^32 voxels");
    if (finest->detail > kMostDetail)
        throw DataError(files.path() + ": grid 'irradiance' has " + std::to_string(finest->detail) +
                        " of its voxels along an edge of the scene's, expected at most " +
                        std::to_string(kMostDetail));
    const auto entries = sorted(*finest, size);
    const auto words = static_cast<size_t>(maskWords(finest->detail));
    std::vector<std::uint32_t> places, masks;
    for (const auto& [key, value] : entries) {
        if (places.empty() || places.back() != key.place) {
            places.push_back(key.place);
            masks.resize(masks.size() + words);
        }
        masks[masks.size() - words + key.within / 32] |= 1u << (key.within & 31u);
        light.values.push_back(value);
    }
    light.voxels = SurfaceVoxels(size, finest->detail, places, masks);
    for (const FineGrid& grid : grids)
        if (&grid != &*finest) add(light, grid);
    return light;
}

SurfaceLightTable::SurfaceLightTable(gpu::Device& device, const SurfaceLight& light)
    : mTable(device, light.voxels) {
    const size_t count = light.values.size(), channels = light.grey() ? 1 : 3;
    const ivec3 size = rowsFor(count * channels);
    std::vector<float> values(static_cast<size_t>(size.x) * size.y * size.z);
    for (size_t c = 0; c < channels; ++c)
        for (size_t i = 0; i < count; ++i)
            values[c * count + i] = light.values[i][static_cast<int>(c)];
    mValues = gpu::Texture(device, size, gpu::TexelFormat::r32f, gpu::Filter::nearest);
    mValues.upload(values.data());
}

void SurfaceLightTable::bind() const {
    if (mValues.name() == 0) return;
    mTable.bind();
    mValues.bindSampler(kIrradianceUnit);
}

std::vector<gpu::Need> surfaceLightNeeds(const SurfaceLight& light) {
    std::vector<gpu::Need> needs = surfaceTableNeeds(
        static_cast<std::int64_t>(light.voxels.voxels.size()), light.voxels.detail);
    const auto entries = static_cast<std::int64_t>(light.values.size()) * (light.grey() ? 1 : 3);
    needs.push_back({"the light on surfaces", 4 * entries, false, 0});
    return needs;
}

} // namespace eikonal::scene
