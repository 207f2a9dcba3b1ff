// A scene volume on the device: the index field, and which effects its grids call for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "medium/medium.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace eikonal::medium {

using glm::ivec3;
using glm::vec3;

Coefficient readCoefficient(const volume::Volume& volume, const std::string& grid,
                            const volume::IndexBox& box) {
    Coefficient coefficient;
    if (!volume.has(grid)) return coefficient;
    coefficient.grid = volume.dense(grid, box);
    const auto& values = coefficient.grid.values;
    coefficient.present = std::any_of(values.begin(), values.end(), [](float v) { return v != 0; });
    if (!coefficient.present) {
        coefficient.grid = {};
        return coefficient;
    }
    if (coefficient.grid.components == 3)
        for (size_t i = 0; i < values.size() && coefficient.grey; i += 3)
            coefficient.grey = values[i] == values[i + 1] && values[i] == values[i + 2];
    return coefficient;
}

Index readIndex(const volume::Volume& volume, const volume::IndexBox& box) {
    Index index;
    index.background = volume.background("ior", vec3(1)).x;
    index.least = index.most = index.background;
    if (!volume.has("ior")) return index;
    index.grid = volume.dense("ior", box);
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

void extendPadding(std::vector<float>& padded, ivec3 size, int components, bool floorAtZero) {
    const ivec3 outer = size + 2;
    const auto at = [&](int x, int y, int z) {
        return padded.data() + ((static_cast<size_t>(z) * outer.y + y) * outer.x + x) * components;
    };
    const auto extend = [&](float* out, const float* face, const float* behind) {
        for (int c = 0; c < components; ++c) {
            const float value = 2 * face[c] - behind[c];
            out[c] = floorAtZero ? std::max(value, 0.0f) : value;
        }
    };
    // Axis after axis, each pass including the padding made by those before: edges and corners
    // are then extended along every axis they stick out in.
    for (int z = 1; z <= size.z; ++z)
        for (int y = 1; y <= size.y; ++y) {
            extend(at(0, y, z), at(1, y, z), at(std::min(2, size.x), y, z));
            extend(at(size.x + 1, y, z), at(size.x, y, z), at(std::max(size.x - 1, 1), y, z));
        }
    for (int z = 1; z <= size.z; ++z)
        for (int x = 0; x < outer.x; ++x) {
            extend(at(x, 0, z), at(x, 1, z), at(x, std::min(2, size.y), z));
            extend(at(x, size.y + 1, z), at(x, size.y, z), at(x, std::max(size.y - 1, 1), z));
        }
    for (int y = 0; y < outer.y; ++y)
        for (int x = 0; x < outer.x; ++x) {
            extend(at(x, y, 0), at(x, y, 1), at(x, y, std::min(2, size.z)));
            extend(at(x, y, size.z + 1), at(x, y, size.z), at(x, y, std::max(size.z - 1, 1)));
        }
}

} // namespace eikonal::medium
