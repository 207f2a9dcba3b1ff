// The refractive index over the domain, where it varies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/index.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

// Look-ups on one object's behalf reach this far beyond its boundary: a step and a spline [voxel].
constexpr float kLookUps = 4;

/// Puts the values of object k's region into the voxels that it is nearest to. `nearest` has the
/// distance of the nearest so far [voxel]. Throws DataError where both are within kLookUps.
void join(const Scene& scene, size_t k, Index& index, std::vector<float>& nearest) {
    const Object& object = scene.objects[k];
    const Region& region = scene.regions[k];
    const glm::ivec3 size = scene.size();
    for (int z = object.box.min.z; z <= object.box.max.z; ++z)
        for (int y = object.box.min.y; y <= object.box.max.y; ++y)
            for (int x = object.box.min.x; x <= object.box.max.x; ++x) {
                const size_t voxel = (static_cast<size_t>(z) * size.y + y) * size.x + x;
                const float distance = object.distance.at({x, y, z});
                if (std::max(distance, nearest[voxel]) < kLookUps)
                    throw DataError(scene.path + ": the index varies in '" + region.name +
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

Index varyingIndex(const Scene& scene) {
    Index index;
    const Region& medium = scene.medium();
    index.background = medium.index.value.x;
    index.least = index.most = index.background;
    std::vector<float> nearest;
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        if (!scene.regions[k].index.varies()) continue;
        if (nearest.empty()) {
            index.grid = scene.regions[k].index.grid;
            nearest.assign(index.grid.values.size(), 1e9f);
        }
        join(scene, k, index, nearest);
    }
    if (!medium.index.varies()) return index;
    if (!nearest.empty())
        throw DataError(scene.path +
                        ": the index varies in an object and in what surrounds it, expected "
                        "it to vary on one side of sharp boundaries");
    index.grid = medium.index.grid;
    const auto [least, most] =
        std::minmax_element(index.grid.values.begin(), index.grid.values.end());
    index.least = std::min(index.least, *least);
    index.most = std::max(index.most, *most);
    return index;
}

Index blurredIndex(const volume::Volume& volume, const volume::IndexBox& box) {
    Index index;
    index.background = volume.background("ior", vec3(1)).x;
    index.least = index.most = index.background;
    if (!volume.has("ior")) return index;
    index.grid = volume.dense("ior", box);
    index.inHalf = volume.isStoredInHalf("ior");
    const auto& values = index.grid.values;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    index.least = *least;
    index.most = *most;
    const ivec3 size = index.grid.size;
    size_t i = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i) {
                const bool face = x == 0 || y == 0 || z == 0 || x == size.x - 1 ||
                                  y == size.y - 1 || z == size.z - 1;
                if (face)
                    index.jumpAtFaces =
                        std::max(index.jumpAtFaces, std::abs(values[i] - index.background));
            }
    return index;
}

} // namespace eikonal::scene
