// Values per voxel as textures that rays sample up to the domain's faces and a little beyond.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/voxel_textures.h"

#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace eikonal::scene {

using glm::ivec3;

namespace {

/// Makes the margin of a padded array from the voxels inside.
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

void fillBox(gpu::Texture& texture, int slice, const VoxelLayout& layout, int components,
             bool floorAtZero, const Pack& pack) {
    const ivec3 size = layout.size, outer = size + 2;
    const auto count = static_cast<size_t>(components);
    std::vector<float> padded(placeOf(outer, 0, 0, outer.z) * count);
    tbb::parallel_for(0, size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y) {
            float* out = padded.data() + placeOf(outer, 1, y + 1, z + 1) * count;
            for (int x = 0; x < size.x; ++x, out += count) pack(ivec3(x, y, z), out);
        }
    });
    extendPadding(padded, size, components, floorAtZero);
    texture.uploadSlices(slice, outer.z, padded.data());
}

/// Single samples, those of the margin too.
class Samples {
public:
    Samples(ivec3 size, int components, bool floorAtZero, const Pack& pack)
        : mSize(size), mComponents(components), mFloor(floorAtZero), mPack(pack) {}

    /// p counts from the margin's first on. As extendPadding() does it: along z from what is made
    /// along y, that from what is made along x.
    void at(ivec3 p, float* out) const {
        p = glm::min(p, mSize + 1);
        for (int axis = 2; axis >= 0; --axis) {
            const int inside = std::clamp(p[axis], 1, mSize[axis]);
            if (inside == p[axis]) continue;
            float face[4], behind[4];
            const int inward = p[axis] < inside ? 1 : -1;
            p[axis] = inside;
            at(p, face);
            p[axis] = std::clamp(inside + inward, 1, mSize[axis]);
            at(p, behind);
            for (int c = 0; c < mComponents; ++c) {
                const float value = 2 * face[c] - behind[c];
                out[c] = mFloor ? std::max(value, 0.0f) : value;
            }
            return;
        }
        mPack(p - 1, out);
    }

private:
    ivec3 mSize;
    int mComponents;
    bool mFloor;
    const Pack& mPack;
};

} // namespace

void fillBlocks(gpu::Texture& texture, int slice, const VoxelLayout& layout,
                gpu::TexelFormat format, const WriteBlock& write) {
    const auto count = static_cast<size_t>(gpu::componentsOf(format));
    const ivec3 slab(layout.texels().x, layout.texels().y, kVoxelSamples);
    std::vector<float> texels(placeOf(slab, 0, 0, slab.z) * count);
    const size_t inSlab = static_cast<size_t>(layout.atlas.x) * layout.atlas.y;
    for (size_t first = 0; first < layout.list.size(); first += inSlab) {
        const size_t end = std::min(first + inSlab, layout.list.size());
        tbb::parallel_for(first, end, [&](size_t place) {
            const ivec3 at = layout.texelOf(place);
            write(place, texels.data() + placeOf(slab, at.x, at.y, 0) * count, slab);
        });
        texture.uploadSlices(slice + layout.texelOf(first).z, kVoxelSamples, texels.data());
    }
}

void fillVoxels(gpu::Texture& texture, int slice, const VoxelLayout& layout,
                gpu::TexelFormat format, bool floorAtZero, const Pack& pack) {
    const int components = gpu::componentsOf(format);
    if (!layout.paged) return fillBox(texture, slice, layout, components, floorAtZero, pack);
    const Samples samples(layout.size, components, floorAtZero, pack);
    const auto count = static_cast<size_t>(components);
    fillBlocks(texture, slice, layout, format, [&](size_t place, float* texels, const ivec3& slab) {
        const ivec3 first = layout.firstSample(layout.list[place]);
        float value[4];
        samples.at(first, value);
        for (int z = 0; z < kVoxelSamples; ++z)
            for (int y = 0; y < kVoxelSamples; ++y) {
                float* out = texels + placeOf(slab, 0, y, z) * count;
                for (int x = 0; x < kVoxelSamples; ++x, out += count)
                    if (layout.even[place])
                        std::copy_n(value, count, out);
                    else
                        samples.at(first + ivec3(x, y, z), out);
            }
    });
}

gpu::Texture makeVoxelTexture(gpu::Device& device, const VoxelLayout& layout,
                              gpu::TexelFormat format, bool floorAtZero, const Pack& pack) {
    gpu::Texture texture(device, layout.texels(), format, gpu::Filter::linear);
    fillVoxels(texture, 0, layout, format, floorAtZero, pack);
    return texture;
}

gpu::Texture makeVoxelTable(gpu::Device& device, const VoxelLayout& layout) {
    std::vector<std::uint32_t> places(layout.table.size());
    tbb::parallel_for(size_t{0}, places.size(), [&](size_t block) {
        const glm::uvec3 place(atPlace(layout.atlas, layout.table[block]));
        places[block] = place.x | place.y << 10u | place.z << 20u;
    });
    gpu::Texture texture(device, layout.blocks, gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    texture.upload(places.data());
    return texture;
}

gpu::Need voxelNeed(const VoxelLayout& layout, const char* what, std::int64_t bytesPerTexel) {
    return {what, layout.texelCount() * bytesPerTexel, false, layout.edge()};
}

gpu::Need tableNeed(const VoxelLayout& layout) {
    return {"the table of voxels' blocks", static_cast<std::int64_t>(layout.table.size()) * 4,
            false, std::max({layout.blocks.x, layout.blocks.y, layout.blocks.z})};
}

} // namespace eikonal::scene
