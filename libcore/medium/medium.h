// A scene volume on the device: the index field, and which effects its grids call for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "volume/volume.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::medium {

/// A coefficient grid on the host, or its one value where it does not vary.
struct Coefficient {
    volume::DenseGrid grid; ///< empty if absent
    bool present = false;   ///< the file has it and some value is not 0
    bool grey = true;       ///< R = G = B everywhere

    /// Component c of voxel i; a grid of one component answers for all three; 0 if not present.
    float at(size_t i, int c) const {
        if (!present) return 0.0f;
        return grid.components == 1 ? grid.values[i] : grid.values[3 * i + static_cast<size_t>(c)];
    }
};

/// Reads a grid over `box`. An absent grid, or one that is 0 all over, is not present and holds no
/// memory.
Coefficient readCoefficient(const volume::Volume& volume, const std::string& grid,
                            const volume::IndexBox& box);

/// The refractive index over the domain.
struct Index {
    volume::DenseGrid grid; ///< empty where the file has none
    float background = 1;   ///< outside the domain
    float least = 1, most = 1;

    bool varies() const { return most > least; }
    /// The largest jump between the domain's outermost voxels and the outside.
    float jumpAtFaces = 0;
};

/// Reads `ior` over `box`. An absent grid is index 1.
Index readIndex(const volume::Volume& volume, const volume::IndexBox& box);

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
    size_t voxel = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y) {
            const size_t row = (static_cast<size_t>(z + 1) * outer.y + (y + 1)) * outer.x + 1;
            float* out = padded.data() + row * components;
            for (int x = 0; x < size.x; ++x, out += components) pack(voxel++, out);
        }
    extendPadding(padded, size, static_cast<int>(components), floorAtZero);
    gpu::Texture texture(device, outer, format, gpu::Filter::linear);
    texture.upload(padded.data());
    return texture;
}

} // namespace eikonal::medium
