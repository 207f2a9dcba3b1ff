// Values per voxel as a texture that rays sample up to the domain's faces and a little beyond.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"

#include <glm/vec3.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace eikonal::scene {

/// Packs up to four values per voxel into a texture padded by one voxel, extended linearly but not
/// below 0 where `floorAtZero`. `pack(voxel, out)` fills componentsOf(format) floats.
template<typename Pack>
gpu::Texture makePadded(gpu::Device& device, glm::ivec3 size, gpu::TexelFormat format,
                        bool floorAtZero, const Pack& pack);

/// Extends the padding of a padded array of `components` from the voxels inside.
void extendPadding(std::vector<float>& padded, glm::ivec3 size, int components, bool floorAtZero);

template<typename Pack>
gpu::Texture makePadded(gpu::Device& device, glm::ivec3 size, gpu::TexelFormat format,
                        bool floorAtZero, const Pack& pack) {
    const auto components = static_cast<size_t>(gpu::componentsOf(format));
    const glm::ivec3 outer = size + 2;
    std::vector<float> padded(static_cast<size_t>(outer.x) * outer.y * outer.z * components);
    tbb::parallel_for(0, size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y) {
            const size_t row = (static_cast<size_t>(z + 1) * outer.y + (y + 1)) * outer.x + 1;
            float* out = padded.data() + row * components;
            for (int x = 0; x < size.x; ++x, out += components) pack(glm::ivec3(x, y, z), out);
        }
    });
    extendPadding(padded, size, static_cast<int>(components), floorAtZero);
    gpu::Texture texture(device, outer, format, gpu::Filter::linear);
    texture.upload(padded.data());
    return texture;
}

} // namespace eikonal::scene
