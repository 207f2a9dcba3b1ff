// Values per voxel as a texture that rays sample up to the domain's faces and a little beyond.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/padded.h"

#include <algorithm>

namespace eikonal::scene {

using glm::ivec3;

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

} // namespace eikonal::scene
