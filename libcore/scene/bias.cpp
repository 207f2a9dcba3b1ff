// What linear interpolation of central differences is off by, as far as samples can tell.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/bias.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec2;
using glm::vec3;

// Fourth differences by second ones, below which samples are smooth and above which they are not:
// tan²(π/λ) of waves of 7.5 and of 5.6 voxels. A kink and a jump have ½ and more.
constexpr float kSmooth = 0.2f, kRough = 0.4f;

class Samples {
public:
    explicit Samples(const Potential& potential) : mPotential(potential) {
        const ivec3 outer = potential.outer();
        mStrides[1] = outer.x;
        mStrides[2] = std::ptrdiff_t{outer.x} * outer.y;
    }

    const float* at(const ivec3& voxel) const {
        const ivec3 p = voxel + kMargin;
        return mPotential.values.data() + (p.z * mStrides[2] + p.y * mStrides[1] + p.x);
    }
    /// U's second difference along an axis.
    float bend(const float* u, int axis) const {
        const std::ptrdiff_t s = mStrides[axis];
        return u[s] - 2 * u[0] + u[-s];
    }
    /// (fourth, second) differences about a voxel, or about the nearest one that has all of them
    /// inside the domain: what goes on beyond a face has none of its own.
    vec2 roughness(const ivec3& voxel) const {
        const ivec3 size = mPotential.size, inside = glm::clamp(voxel, ivec3(0), size - 1);
        vec2 sum(0);
        for (int axis = 0; axis < 3; ++axis) {
            if (size[axis] < 5) continue;
            ivec3 p = inside;
            p[axis] = std::clamp(p[axis], 2, size[axis] - 3);
            const float* u = at(p);
            const std::ptrdiff_t s = mStrides[axis];
            const float before = bend(u - s, axis), here = bend(u, axis), after = bend(u + s, axis);
            sum.x += std::abs(before - 2 * here + after);
            sum.y += std::abs(before) + 2 * std::abs(here) + std::abs(after);
        }
        return sum;
    }

private:
    const Potential& mPotential;
    std::ptrdiff_t mStrides[3]{1, 0, 0};
};

template<typename Visit> void forEachVoxel(const Bias& box, const Visit& visit) {
    tbb::parallel_for(0, box.size.z, [&](int z) {
        for (int y = 0; y < box.size.y; ++y)
            for (int x = 0; x < box.size.x; ++x) visit(box.low + ivec3(x, y, z));
    });
}

} // namespace

Bias biasOf(const Potential& potential, const ivec3& low, const ivec3& size) {
    const Samples samples(potential);
    const Bias around{low - 1, size + 2, {}};
    std::vector<vec2> rough(static_cast<size_t>(around.size.x) * around.size.y * around.size.z);
    forEachVoxel(around, [&](const ivec3& voxel) {
        rough[static_cast<size_t>(around.at(voxel))] = samples.roughness(voxel);
    });
    const std::ptrdiff_t strides[] = {1, around.size.x,
                                      std::ptrdiff_t{around.size.x} * around.size.y};
    Bias bias{low, size, std::vector<vec3>(static_cast<size_t>(size.x) * size.y * size.z)};
    forEachVoxel(bias, [&](const ivec3& voxel) {
        const vec2* r = rough.data() + around.at(voxel);
        vec2 sum = *r; // with its six neighbours, so that no kink is missed between samples
        for (const std::ptrdiff_t s : strides) sum += r[s] + r[-s];
        const float share =
            std::clamp((kRough - sum.x / std::max(sum.y, 1e-30f)) / (kRough - kSmooth), 0.0f, 1.0f);
        const float* u = samples.at(voxel);
        const vec3 bend(samples.bend(u, 0), samples.bend(u, 1), samples.bend(u, 2));
        bias.values[static_cast<size_t>(bias.at(voxel))] =
            share * ((bend.x + bend.y + bend.z) / 12 + bend / 6.0f);
    });
    return bias;
}

} // namespace eikonal::scene
