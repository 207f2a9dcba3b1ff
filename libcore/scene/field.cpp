// The index field on the device, as shaders/transport/index_field.glsl reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/field.h"

#include "scene/lattice.h"
#include "scene/samples.h"
#include "scene/shared.h"
#include "scene/voxel_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;

/// By blocks; one that is even has the same sample everywhere.
void fillPaged(gpu::Texture& field, const VoxelLayout& layout, const Potential& own,
               const Potential& stepped, bool unbiased) {
    const auto write = [&](size_t place, float* texels, const ivec3& slab) {
        const ivec3 low = layout.firstSample(layout.list[place]);
        const ivec3 size =
            layout.even[place] ? ivec3(1) : glm::min(ivec3(kVoxelSamples), layout.size + 2 - low);
        const std::vector<vec4> samples = gradientSamples(own, stepped, unbiased, low, size);
        for (int z = 0; z < kVoxelSamples; ++z)
            for (int y = 0; y < kVoxelSamples; ++y)
                for (int x = 0; x < kVoxelSamples; ++x) {
                    const ivec3 p = glm::min(ivec3(x, y, z), size - 1);
                    const vec4& sample = samples[placeOf(size, p.x, p.y, p.z)];
                    std::copy_n(&sample.x, 4, texels + 4 * placeOf(slab, x, y, z));
                }
    };
    fillBlocks(field, 0, layout, gpu::TexelFormat::rgba32f, write);
}

gpu::Texture makeLinear(gpu::Device& device, const Potential& own, const Potential& stepped,
                        bool unbiased, const VoxelLayout& layout) {
    gpu::Texture field(device, layout.texels(), gpu::TexelFormat::rgba32f, gpu::Filter::linear);
    if (layout.paged) {
        fillPaged(field, layout, own, stepped, unbiased);
        return field;
    }
    const int slab = 16; // slices at a time, so that the host never holds the whole
    for (int z = 0; z < field.size().z; z += slab) {
        const int count = std::min(slab, field.size().z - z);
        field.uploadSlices(z, count,
                           gradientSamples(own, stepped, unbiased, {0, 0, z},
                                           {field.size().x, field.size().y, count})
                               .data());
    }
    return field;
}

/// Texel (x, y, z) holds coefficients x − 2 … x + 1 of row (y − 2, z − 2).
gpu::Texture makeCubic(gpu::Device& device, const Potential& spline) {
    const ivec3 size(spline.size.x + 1, spline.size.y + 4, spline.size.z + 4);
    gpu::Texture field(device, size, gpu::TexelFormat::rgba32f, gpu::Filter::nearest);
    std::vector<float> slice(4 * static_cast<size_t>(size.x) * size.y);
    for (int z = 0; z < size.z; ++z) {
        float* out = slice.data();
        for (int y = 0; y < size.y; ++y) {
            const float* row = spline.values.data() + placeOf(spline.outer(), kMargin - 2,
                                                              y + kMargin - 2, z + kMargin - 2);
            for (int x = 0; x < size.x; ++x, ++row, out += 4) std::copy(row, row + 4, out);
        }
        field.uploadSlices(z, 1, slice.data());
    }
    return field;
}

/// What look-ups of an index read: FieldParams::cubic, too.
struct Samples {
    gpu::Texture texture;
    vec4 cubic{0};
};

Samples makeSamples(gpu::Device& device, const volume::BrickGrid& index,
                    const volume::BrickGrid& rest, float least, const VoxelLayout& layout,
                    const FieldOptions& options) {
    const Potential own = makePotential(index, rest);
    Potential stepped = own;
    if (options.verletTau > 0) correctForVerlet(stepped, options.verletTau);
    if (options.interpolation == Interpolation::linear)
        return {makeLinear(device, own, stepped, options.unbiased, layout)};
    makeSpline(stepped);
    const double zero = own.squareAtZero, floor = static_cast<double>(least * least) / 16;
    return {makeCubic(device, stepped),
            vec4(std::sqrt(zero), options.verletTau * options.verletTau / 12, floor - zero, 0)};
}

} // namespace

int fieldSwitch(bool varies, Interpolation interpolation) {
    return !varies ? 0 : interpolation == Interpolation::linear ? 1 : 2;
}

Field::Field(gpu::Device& device, float constant, float dispersion) {
    FieldParams values{};
    values.scale.w = constant;
    values.dispersed.w = dispersion;
    mParams = gpu::Buffer(device, sizeof values, &values);
}

Field::Field(gpu::Device& device, const Index& index, const VoxelLayout& layout,
             const FieldOptions& options) {
    FieldParams values{};
    const bool linear = options.interpolation == Interpolation::linear;
    values.scale =
        vec4(1.0f / vec3(linear ? layout.texels() : index.grid.size + ivec3(1, 4, 4)), 0);
    values.high = vec4(vec3(index.grid.size - 1), options.unbiased ? 1 : 0);
    Samples plain = makeSamples(device, index.grid, index.rest, index.least, layout, options);
    mTexture = std::move(plain.texture);
    values.cubic = plain.cubic;
    if (!index.dispersed.page.empty()) {
        Samples other =
            makeSamples(device, index.dispersed, index.dispersedRest, index.least, layout, options);
        mDispersed = std::move(other.texture);
        values.dispersed = other.cubic;
    }
    mParams = gpu::Buffer(device, sizeof values, &values);
}

void Field::bind() const {
    mParams.bindUniform(kFieldBlock);
    if (mTexture.name() != 0) mTexture.bindSampler(kFieldUnit);
    if (mDispersed.name() != 0) mDispersed.bindSampler(kDispersedFieldUnit);
}

gpu::Need fieldNeed(const VoxelLayout& layout, Interpolation interpolation, bool disperses) {
    const std::int64_t bytes = disperses ? 32 : 16;
    if (interpolation == Interpolation::linear) return voxelNeed(layout, "the index field", bytes);
    const ivec3 texels = layout.size + ivec3(1, 4, 4);
    return {"the index field", std::int64_t{texels.x} * texels.y * texels.z * bytes, false,
            std::max({texels.x, texels.y, texels.z})};
}

} // namespace eikonal::scene
