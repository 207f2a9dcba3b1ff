// The index field on the device, as shaders/transport/index_field.glsl reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/field.h"

#include "scene/samples.h"
#include "scene/shared.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;

size_t placeOf(const Potential& potential, int x, int y, int z) {
    const ivec3 outer = potential.outer();
    return (static_cast<size_t>(z + kMargin) * outer.y + (y + kMargin)) * outer.x + (x + kMargin);
}

gpu::Texture makeLinear(gpu::Device& device, const Potential& own, const Potential& stepped,
                        bool unbiased) {
    gpu::Texture field(device, own.size + 2, gpu::TexelFormat::rgba32f, gpu::Filter::linear);
    const int slab = 16; // slices at a time, so that the host never holds the whole
    for (int z = 0; z < field.size().z; z += slab) {
        const int count = std::min(slab, field.size().z - z);
        field.uploadSlices(z, count, gradientSamples(own, stepped, unbiased, z, count).data());
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
            const float* row = spline.values.data() + placeOf(spline, -2, y - 2, z - 2);
            for (int x = 0; x < size.x; ++x, ++row, out += 4) std::copy(row, row + 4, out);
        }
        field.uploadSlices(z, 1, slice.data());
    }
    return field;
}

} // namespace

int fieldSwitch(bool varies, Interpolation interpolation) {
    return !varies ? 0 : interpolation == Interpolation::linear ? 1 : 2;
}

Field::Field(gpu::Device& device, float constant) {
    FieldParams values{};
    values.scale.w = constant;
    mParams = gpu::Buffer(device, sizeof values, &values);
}

Field::Field(gpu::Device& device, const volume::BrickGrid& index, float least,
             const FieldOptions& options) {
    FieldParams values{};
    const bool linear = options.interpolation == Interpolation::linear;
    values.scale = vec4(1.0f / vec3(index.size + (linear ? ivec3(2) : ivec3(1, 4, 4))), 0);
    values.high = vec4(vec3(index.size - 1), options.unbiased ? 1 : 0);
    const Potential own = makePotential(index);
    Potential stepped = own;
    if (options.verletTau > 0) correctForVerlet(stepped, options.verletTau);
    if (linear) {
        mTexture = makeLinear(device, own, stepped, options.unbiased);
    } else {
        makeSpline(stepped);
        mTexture = makeCubic(device, stepped);
        const double zero = own.squareAtZero, floor = static_cast<double>(least * least) / 16;
        values.cubic =
            vec4(std::sqrt(zero), options.verletTau * options.verletTau / 12, floor - zero, 0);
    }
    mParams = gpu::Buffer(device, sizeof values, &values);
}

void Field::bind() const {
    mParams.bindUniform(kFieldBlock);
    if (mTexture.name() != 0) mTexture.bindSampler(kFieldUnit);
}

gpu::Need fieldNeed(ivec3 size, Interpolation interpolation) {
    const bool linear = interpolation == Interpolation::linear;
    const auto voxels = [&](int more) {
        return std::int64_t{size.x + more} * (size.y + more) * (size.z + more);
    };
    return {"the index field", voxels(linear ? 2 : 4) * 16, false,
            std::max({size.x, size.y, size.z}) + (linear ? 2 : 4)};
}

} // namespace eikonal::scene
