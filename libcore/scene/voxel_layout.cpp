// Where a scene's voxels lie in textures that rays interpolate.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/voxel_layout.h"

#include "scene/lattice.h"
#include "scene/samples.h"
#include "scene/scene.h"
#include "scene/shared.h"

#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using volume::BrickGrid;
using volume::kBrick;
using volume::kBrickBits;

/// A grid that textures are made of, and how far round a sample it is looked at [voxel].
struct Looked {
    const BrickGrid* grid;
    int round;
};

std::vector<Looked> gridsOf(const Scene& scene) {
    std::vector<Looked> grids;
    if (scene.index.varies()) grids.push_back({&scene.index.grid, kMargin});
    for (const volume::BrickGrid* grid :
         {&scene.index.dispersed, &scene.index.rest, &scene.index.dispersedRest})
        if (!grid->page.empty()) grids.push_back({grid, kMargin});
    const auto add = [&](const Values& values) {
        if (values.varies()) grids.push_back({&values.grid, 0});
    };
    for (const Region& region : scene.regions)
        for (const RegionValues values :
             {&Region::absorption, &Region::scattering, &Region::anisotropy, &Region::emission,
              &Region::albedo, &Region::opacity, &Region::absorptionExtraordinary})
            add(region.*values);
    add(scene.light.fluence);
    add(scene.light.direction);
    return grids;
}

/// Adds the grid's value within [low, high] of the domain to `key` if it is one.
bool addIfEven(const BrickGrid& grid, ivec3 low, ivec3 high, std::vector<float>& key) {
    low = glm::clamp(low, ivec3(0), grid.size - 1);
    high = glm::clamp(high, ivec3(0), grid.size - 1);
    const auto count = static_cast<size_t>(grid.components);
    const ivec3 from = (low - grid.first) >> kBrickBits, to = (high - grid.first) >> kBrickBits;
    const float* value = nullptr;
    for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                const size_t brick = placeOf(grid.bricks, x, y, z);
                if (grid.page[brick] >= 0) return false;
                const float* here = grid.valuesOf(brick);
                if (!value) value = here;
                if (!std::equal(here, here + count, value)) return false;
            }
    key.insert(key.end(), value, value + count);
    return true;
}

/// The values of a block that is even in every grid.
std::optional<std::vector<float>> evenValues(const std::vector<Looked>& grids, ivec3 firstSample) {
    std::vector<float> key;
    const ivec3 low = firstSample - 1, high = low + kVoxelCells;
    for (const Looked& looked : grids)
        if (!addIfEven(*looked.grid, low - looked.round, high + looked.round, key))
            return std::nullopt;
    return key;
}

} // namespace

ivec3 VoxelLayout::texels() const {
    return paged ? atlas * kVoxelSamples : size + 2;
}

std::int64_t VoxelLayout::texelCount() const {
    return std::int64_t{texels().x} * texels().y * texels().z;
}

int VoxelLayout::edge() const {
    return std::max({texels().x, texels().y, texels().z});
}

ivec3 VoxelLayout::firstSample(std::uint32_t block) const {
    return kVoxelCells * atPlace(blocks, block);
}

ivec3 VoxelLayout::texelOf(size_t place) const {
    return kVoxelSamples * atPlace(atlas, place);
}

VoxelLayout layoutOf(const Scene& scene, std::int64_t largest) {
    VoxelLayout layout;
    layout.size = scene.size();
    const std::vector<Looked> grids = gridsOf(scene);
    const std::int64_t whole = layout.texelCount();
    if (whole <= largest || grids.empty()) return layout;
    // Cells lie between samples 0 and size + 1.
    layout.blocks = (layout.size + kVoxelCells) / kVoxelCells;
    const size_t count = placeOf(layout.blocks, 0, 0, layout.blocks.z);
    std::vector<std::optional<std::vector<float>>> even(count);
    tbb::parallel_for(size_t{0}, count, [&](size_t block) {
        even[block] = evenValues(grids, layout.firstSample(static_cast<std::uint32_t>(block)));
    });
    std::map<std::vector<float>, std::uint32_t> known;
    layout.table.resize(count);
    for (size_t block = 0; block < count; ++block) {
        const auto next = static_cast<std::uint32_t>(layout.list.size());
        layout.table[block] =
            even[block] ? known.try_emplace(*even[block], next).first->second : next;
        if (layout.table[block] != next) continue;
        layout.list.push_back(static_cast<std::uint32_t>(block));
        layout.even.push_back(even[block].has_value());
    }
    layout.atlas = atlasOf(static_cast<std::int64_t>(layout.list.size()), ivec3(kVoxelSamples));
    layout.paged = true;
    if (layout.texelCount() < whole) return layout;
    VoxelLayout box;
    box.size = layout.size;
    return box;
}

} // namespace eikonal::scene
