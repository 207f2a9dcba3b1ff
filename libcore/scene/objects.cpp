// What bounds the objects of a scene with sharp boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/objects.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

/// The mean length of the gradient within two voxels of the boundary.
float slopeOf(const Object& object) {
    const ivec3 size = object.box.size();
    const auto at = [&](int x, int y, int z) {
        return object.distance[(static_cast<size_t>(z) * size.y + y) * size.x + x];
    };
    double sum = 0;
    std::int64_t count = 0;
    for (int z = 1; z + 1 < size.z; ++z)
        for (int y = 1; y + 1 < size.y; ++y)
            for (int x = 1; x + 1 < size.x; ++x) {
                if (std::abs(at(x, y, z)) > std::min(2.0f, object.band - 1.5f)) continue;
                sum += static_cast<double>(glm::length(vec3(at(x + 1, y, z) - at(x - 1, y, z),
                                                            at(x, y + 1, z) - at(x, y - 1, z),
                                                            at(x, y, z + 1) - at(x, y, z - 1)) *
                                                       0.5f));
                ++count;
            }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 1.0f;
}

/// Two neighbours on either side of a boundary are no further apart than one voxel; where nearly
/// the whole band lies between them, one has lost its sign. Throws DataError naming it.
void refuseLostSigns(const volume::DenseGrid& dense, float band, const ivec3& origin,
                     const std::string& where) {
    const ivec3 size = dense.size, strides(1, size.x, size.x * size.y);
    const float kMost = 1.5f * band;
    size_t i = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    const ivec3 at(x, y, z);
                    if (at[axis] + 1 == size[axis]) continue;
                    const float a = dense.values[i];
                    const float b = dense.values[i + static_cast<size_t>(strides[axis])];
                    if (std::abs(a - b) <= kMost) continue;
                    const ivec3 voxel = at + origin;
                    throw DataError(where + ": the signed distance jumps from " + toText(a) +
                                    " to " + toText(b) + " beside voxel (" +
                                    std::to_string(voxel.x) + ", " + std::to_string(voxel.y) +
                                    ", " + std::to_string(voxel.z) +
                                    "), expected a change of about a voxel: a sign is lost");
                }
}

} // namespace

Object readObject(const volume::Volume& volume, const std::string& sdf,
                  const volume::IndexBox& box) {
    const volume::DenseGrid dense = volume.dense(sdf, box);
    const auto h = static_cast<float>(volume.frame().voxelSize);
    const std::string where = volume.path() + ": grid '" + sdf + "'";
    const float outside = volume.background(sdf, vec3(0)).x;
    if (outside < 0)
        throw DataError(where + ": it is " + toText(outside) +
                        " outside, expected 0 or above: it is inside out");
    Object object;
    for (float value : dense.values) object.band = std::max(object.band, std::abs(value) / h);
    refuseLostSigns(dense, object.band * h, box.min, where);
    // Within the band and inside: nothing else is ever looked up.
    const ivec3 size = dense.size;
    const float within = std::min(object.band, kKept) * h;
    volume::IndexBox& kept = object.box;
    kept = {size, ivec3(-1)};
    size_t i = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i)
                if (dense.values[i] < within) {
                    kept.min = glm::min(kept.min, ivec3(x, y, z));
                    kept.max = glm::max(kept.max, ivec3(x, y, z));
                }
    if (kept.empty()) kept = {ivec3(0), ivec3(0)}; // outside the domain: its first voxel will do
    object.distance.reserve(static_cast<size_t>(kept.voxels()));
    for (int z = kept.min.z; z <= kept.max.z; ++z)
        for (int y = kept.min.y; y <= kept.max.y; ++y)
            for (int x = kept.min.x; x <= kept.max.x; ++x)
                object.distance.push_back(
                    dense.values[(static_cast<size_t>(z) * size.y + y) * size.x + x] / h);
    object.slope = slopeOf(object);
    return object;
}

} // namespace eikonal::scene
