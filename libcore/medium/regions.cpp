// What the regions between sharp boundaries have, and what can be traced of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "medium/regions.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace eikonal::medium {

namespace {

// Look-ups on one object's behalf reach this far beyond its boundary: a step and a spline [voxel].
constexpr float kLookUps = 4;

/// Puts the values of solid k's region into the voxels that it is nearest to. `nearest` has the
/// distance of the nearest so far [voxel]. Throws DataError where both are within kLookUps.
void join(const Objects& objects, size_t k, const std::string& path, Index& index,
          std::vector<float>& nearest) {
    const Solid& solid = objects.solids[k];
    const Region& region = objects.regions[k];
    const glm::ivec3 size = objects.size;
    size_t i = 0;
    for (int z = solid.box.min.z; z <= solid.box.max.z; ++z)
        for (int y = solid.box.min.y; y <= solid.box.max.y; ++y)
            for (int x = solid.box.min.x; x <= solid.box.max.x; ++x, ++i) {
                const size_t voxel = (static_cast<size_t>(z) * size.y + y) * size.x + x;
                const float distance = solid.distance[i];
                if (std::max(distance, nearest[voxel]) < kLookUps)
                    throw DataError(path + ": the index varies in '" + region.name +
                                    "' and in another object less than " +
                                    std::to_string(static_cast<int>(2 * kLookUps)) +
                                    " voxels off, expected one of them, or more room");
                if (distance >= nearest[voxel]) continue;
                nearest[voxel] = distance;
                const float n = region.index.grid.values[voxel];
                index.grid.values[voxel] = n;
                if (distance > kLookUps) continue;
                index.least = std::min(index.least, n);
                index.most = std::max(index.most, n);
            }
}

} // namespace

Index varyingIndex(const Objects& objects, const std::string& path) {
    Index index;
    const Region& medium = objects.regions.back();
    index.background = medium.index.value.x;
    index.least = index.most = index.background;
    std::vector<float> nearest;
    for (size_t k = 0; k < objects.solids.size(); ++k) {
        if (!objects.regions[k].index.varies()) continue;
        if (nearest.empty()) {
            index.grid = objects.regions[k].index.grid;
            nearest.assign(index.grid.values.size(), 1e9f);
        }
        join(objects, k, path, index, nearest);
    }
    if (!medium.index.varies()) return index;
    if (!nearest.empty())
        throw DataError(path + ": the index varies in an object and in what surrounds it, expected "
                               "it to vary on one side of sharp boundaries");
    index.grid = medium.index.grid;
    const auto [least, most] =
        std::minmax_element(index.grid.values.begin(), index.grid.values.end());
    index.least = std::min(index.least, *least);
    index.most = std::max(index.most, *most);
    return index;
}

void requireConstants(const Objects& objects, const std::string& path,
                      const std::vector<std::pair<const char*, RegionValues>>& grids) {
    for (const Region& region : objects.regions)
        for (const auto& [grid, values] : grids)
            if ((region.*values).varies())
                throw DataError(path + ": grid '" + grid + "' of '" + region.name +
                                "' varies, expected one value on each side of sharp boundaries "
                                "(--boundary blurred takes any)");
}

std::vector<std::string> distanceWarnings(const Objects& objects) {
    std::vector<std::string> warnings;
    const float kSteep = 1.2f; // noise and creases stay below
    for (size_t k = 0; k < objects.solids.size(); ++k)
        if (objects.solids[k].slope > kSteep)
            warnings.push_back("the signed distance of '" + objects.regions[k].name +
                               "' grows by " +
                               toText(std::round(objects.solids[k].slope * 100) / 100) +
                               " a voxel, expected 1: rays may leap over its boundary");
    return warnings;
}

bool anyHas(const Objects& objects, RegionValues values) {
    return std::any_of(objects.regions.begin(), objects.regions.end(),
                       [&](const Region& region) { return !(region.*values).isZero(); });
}

std::string whoHas(const Objects& objects, RegionValues values) {
    for (const Region& region : objects.regions)
        if (!(region.*values).isZero()) return "'" + region.name + "' has it";
    return "nothing has it";
}

std::pair<bool, std::string> whatRefracts(const Objects& objects) {
    for (const Region& region : objects.regions)
        if (region.index.varies() || region.index.value != objects.regions.back().index.value)
            return {true, "'" + region.name + "' has an index of its own"};
    return {false, "the index is the same everywhere"};
}

} // namespace eikonal::medium
