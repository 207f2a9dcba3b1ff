// The smoothing stage: a separable Gaussian over whole grids, so that rays see no voxel's edge.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/smooth.h"

#include "gpu/program.h"
#include "gpu/resources.h"
#include "smooth/kernel.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <utility>

namespace eikonal::smooth {

namespace {

using glm::ivec3;
using glm::ivec4;
using gpu::Buffer;
#include "shared/bindings.h"
#include "shared/smooth_params.h"
static_assert(sizeof(SmoothParams) == 48);

/// How the kernel walks a box of `size` voxels along `axis`.
SmoothParams walk(ivec3 size, int axis, int radius) {
    const int runs = (size[axis] + kOutputs - 1) / kOutputs;
    const int x = 1, y = size.x, z = size.x * size.y;
    if (axis == 0) return {{runs, size.y, size.z, size.x}, {0, y, z, x}, {kOutputs, 0, radius, 0}};
    if (axis == 1) return {{size.x, runs, size.z, size.y}, {x, 0, z, y}, {0, kOutputs, radius, 0}};
    return {{size.x, runs, size.y, size.z}, {x, 0, y, z}, {0, kOutputs, radius, 0}};
}

/// The planes that smoothing works on at a time, and what it holds on the device.
class Smoother {
public:
    Smoother(gpu::Device& device, const Plan& plan, std::int64_t slabBytes);

    /// Smooths a scalar field in place.
    void smooth(std::vector<float>& values);

private:
    void smoothAxis(ivec3 size, int axis);

    gpu::Device& mDevice;
    ivec3 mSize;
    int mHalo;   // planes that a slab reads on either side of those it makes
    int mPlanes; // along z, of a slab with its halo
    gpu::Program mProgram;
    Buffer mSource, mTarget, mParams;
    Buffer mWeights[3];
    int mRadius[3];
};

Smoother::Smoother(gpu::Device& device, const Plan& plan, std::int64_t slabBytes)
    : mDevice(device), mSize(plan.size) {
    const std::int64_t planeBytes = std::int64_t{mSize.x} * mSize.y * 4;
    const std::int64_t most = std::min(slabBytes, device.limits().storageBufferBytes) / planeBytes;
    std::vector<float> weights[3];
    for (int axis = 0; axis < 3; ++axis) {
        const auto folded = foldedWeights(plan.weights, mSize[axis]);
        weights[axis].assign(folded.begin(), folded.end());
        mRadius[axis] = static_cast<int>(folded.size()) - 1;
    }
    mHalo = mRadius[2];
    mPlanes =
        static_cast<int>(std::clamp<std::int64_t>(most, std::min(2 * mHalo + 1, mSize.z), mSize.z));
    const std::string what = "a slab of " + std::to_string(mSize.x) + " x " +
                             std::to_string(mSize.y) + " x " + std::to_string(mPlanes) + " voxels";
    device.requireFit({{what, planeBytes * mPlanes, true, 0},
                       {"its smoothed copy", planeBytes * mPlanes, true, 0}});
    mProgram = gpu::Program(device, "smooth/gaussian.comp.glsl", {});
    for (int axis = 0; axis < 3; ++axis)
        mWeights[axis] = Buffer(device, static_cast<std::int64_t>(weights[axis].size()) * 4,
                                weights[axis].data());
    mSource = Buffer(device, planeBytes * mPlanes);
    mTarget = Buffer(device, planeBytes * mPlanes);
    mParams = Buffer(device, sizeof(SmoothParams));
}

void Smoother::smooth(std::vector<float>& values) {
    const std::int64_t plane = std::int64_t{mSize.x} * mSize.y;
    // Slabs after the first need planes as they were before; only then is a copy held.
    const bool whole = mPlanes == mSize.z;
    const std::vector<float> copy = whole ? std::vector<float>{} : values;
    const float* source = whole ? values.data() : copy.data();
    for (int from = 0; from < mSize.z;) {
        const int low = std::max(from - mHalo, 0);
        const int high = std::min(low + mPlanes, mSize.z);
        const int to = high == mSize.z ? high : high - mHalo;
        // Clamping at a slab's inner ends spoils nothing but its halo.
        const ivec3 size(mSize.x, mSize.y, high - low);
        mSource.upload(source + plane * low, plane * size.z * 4);
        for (int axis = 0; axis < 3; ++axis) smoothAxis(size, axis);
        mSource.download(values.data() + plane * from, plane * (to - from) * 4,
                         plane * (from - low) * 4);
        mDevice.check("smoothing");
        from = to;
    }
}

void Smoother::smoothAxis(ivec3 size, int axis) {
    if (mRadius[axis] == 0) return;
    const SmoothParams values = walk(size, axis, mRadius[axis]);
    mParams.upload(&values, sizeof values);
    mParams.bindUniform(kParamsBlock);
    mSource.bindStorage(kSourceBuffer);
    mTarget.bindStorage(kTargetBuffer);
    mWeights[axis].bindStorage(kWeightsBuffer);
    mProgram.dispatch({values.counts.x * values.counts.y, values.counts.z, 1});
    gpu::barrier();
    std::swap(mSource, mTarget);
}

// Below this share of the kernel that counts, rounding would show: such a value stays.
constexpr float kLeastShare = 1e-3f;

/// Smooths one component of the values that count, by themselves: the weights of those are made to
/// sum to 1 (Knutsson and Westin 1993). `share` is what their weights sum to.
void smoothCounting(Smoother& smoother, const std::vector<float>& counts,
                    const std::vector<float>& share, std::vector<float>& values) {
    const auto first = std::find(counts.begin(), counts.end(), 1.0f);
    if (first == counts.end()) return;
    // Differences from one of them, so that a constant stays one to the last bit.
    const float from = values[static_cast<size_t>(first - counts.begin())];
    float low = from, high = from;
    std::vector<float> sums(values.size());
    for (size_t i = 0; i < values.size(); ++i) {
        if (counts[i] == 0) continue;
        sums[i] = values[i] - from;
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
    }
    smoother.smooth(sums);
    for (size_t i = 0; i < values.size(); ++i)
        if (counts[i] > 0 && share[i] >= kLeastShare)
            values[i] = std::clamp(from + sums[i] / share[i], low, high);
}

/// Smooths one component of an item.
void smoothComponent(Smoother& smoother, const Item& item, const std::vector<float>& share,
                     std::vector<float>& values) {
    if (!item.counts.empty()) return smoothCounting(smoother, item.counts, share, values);
    if (!item.object) return smoother.smooth(values);
    // Beyond the band distances are not known, only that they are larger.
    const std::vector<float> before = values;
    smoother.smooth(values);
    for (size_t i = 0; i < values.size(); ++i)
        if (std::abs(before[i]) >= item.background.x) values[i] = before[i];
}

} // namespace

std::vector<Item> run(gpu::Device& device, Plan plan, Stats& stats, const Progress& progress,
                      std::int64_t slabBytes) {
    if (plan.items.empty()) return {};
    gpu::Profiler profiler(stats);
    profiler.begin("smooth");
    Smoother smoother(device, plan, slabBytes);
    double done = 0;
    for (Item& item : plan.items) {
        const auto components = static_cast<size_t>(item.values.components);
        std::vector<float>& values = item.values.values;
        std::vector<float> component(components > 1 ? item.values.voxels() : 0);
        std::vector<float> share = item.counts;
        if (!share.empty()) smoother.smooth(share);
        for (size_t c = 0; c < components; ++c) {
            if (components > 1) {
                for (size_t i = 0; i < component.size(); ++i)
                    component[i] = values[components * i + c];
                smoothComponent(smoother, item, share, component);
                for (size_t i = 0; i < component.size(); ++i)
                    values[components * i + c] = component[i];
            } else {
                smoothComponent(smoother, item, share, values);
            }
            done += 1.0 / static_cast<double>(components);
            report(progress, done / static_cast<double>(plan.items.size()));
        }
        stats.count("voxels", static_cast<double>(item.values.voxels()));
    }
    profiler.end();
    profiler.collect();
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return std::move(plan.items);
}

} // namespace eikonal::smooth
