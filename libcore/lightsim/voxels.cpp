// Voxels that receive light: fixed-point sums that become fluence and mean direction.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/voxels.h"

#include "lightsim/shared.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::lightsim {

double unitFor(double photons) {
    const double range = kNearFull;
    return std::exp2(std::min(24.0, std::floor(std::log2(range / (std::sqrt(3.0) * photons)))));
}

VoxelReceiver::VoxelReceiver(gpu::Device& device, const Plan& plan, const Params& params)
    : mResolve(device, "lightsim/resolve.comp.glsl",
               {{"CHANNELS", plan.tracedChannels()},
                {"FLUENCE", plan.fluenceChannels()},
                {"DIRECTION", plan.wants(Output::direction)}}),
      mBlock(device, sizeof(ResolveParams)), mSize(plan.scene.size()),
      mVoxelSize(plan.scene.voxelSize()) {
    if (params.smoothing > 0)
        mSmooth = gpu::Program(
            device, "lightsim/smooth.comp.glsl",
            {{"FLUENCE", plan.fluenceChannels()}, {"DIRECTION", plan.wants(Output::direction)}});
    const std::int64_t bytes = plan.voxels() * 4;
    const int totals = plan.fluenceChannels() + plan.directionChannels();
    for (int i = 0; i < plan.planes(); ++i) mPlanes.emplace_back(device, bytes);
    for (int i = 0; i < totals; ++i) mTotals.emplace_back(device, bytes);
    for (gpu::Buffer& total : mTotals) total.clear();
    clearPlanes();
}

void VoxelReceiver::bindPlanes() const {
    for (size_t i = 0; i < mPlanes.size(); ++i)
        mPlanes[i].bindStorage(kPlanesBuffer + static_cast<unsigned>(i));
}

void VoxelReceiver::clearPlanes() {
    for (gpu::Buffer& plane : mPlanes) plane.clear();
}

void VoxelReceiver::resolve(gpu::Device& device, const glm::dvec3& rgb, double power, double unit) {
    // Track-length estimate: power × path length / voxel volume. [1/m² per unit of fixed point]
    const double share = power / (mVoxelSize * mVoxelSize) / unit;
    const double all = rgb.x + rgb.y + rgb.z;
    const std::int64_t voxels = std::int64_t{mSize.x} * mSize.y * mSize.z;
    ResolveParams values{};
    values.size = ivec4(mSize, static_cast<int>(voxels));
    values.fluence = vec4(share * rgb, 0);
    values.colour = vec4(rgb / all, share * all);
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    bindPlanes();
    for (size_t i = 0; i < mTotals.size(); ++i)
        mTotals[i].bindStorage(kTotalsBuffer + static_cast<unsigned>(i));
    // Rows of 2^20 voxels: a device takes 65,535 groups along one dimension, maybe not more.
    const std::int64_t row = 1 << 20;
    mResolve.dispatch(
        {static_cast<int>(std::min(voxels, row)), static_cast<int>((voxels + row - 1) / row), 1});
    gpu::barrier();
    device.check("resolve");
}

void VoxelReceiver::smooth(gpu::Device& device, int rounds) {
    mPlanes.clear(); // their memory serves the other buffers
    std::vector<gpu::Buffer> others;
    for (const gpu::Buffer& total : mTotals) others.emplace_back(device, total.bytes());
    ResolveParams values{};
    values.size = ivec4(mSize, 0);
    for (int pass = 0; pass < 3 * rounds; ++pass) {
        values.planes.z = pass % 3;
        mBlock.upload(&values, sizeof values);
        mBlock.bindUniform(kParamsBlock);
        for (size_t i = 0; i < mTotals.size(); ++i) {
            mTotals[i].bindStorage(kSourcesBuffer + static_cast<unsigned>(i));
            others[i].bindStorage(kTotalsBuffer + static_cast<unsigned>(i));
        }
        mSmooth.dispatch(mSize);
        gpu::barrier();
        std::swap(mTotals, others);
    }
    device.check("smooth");
}

Result VoxelReceiver::download(const Plan& plan) const {
    const auto voxels = static_cast<size_t>(plan.voxels());
    std::vector<std::vector<float>> values;
    for (const gpu::Buffer& total : mTotals) {
        values.emplace_back(voxels);
        total.download(values.back().data(), total.bytes());
    }
    const auto channels = static_cast<size_t>(plan.fluenceChannels());
    const auto fluence = [&](size_t c) -> const std::vector<float>& {
        return values[std::min(c, channels - 1)];
    };
    Result result;
    if (plan.wants(Output::fluence)) {
        result.fluence = {mSize, 3, std::vector<float>(voxels * 3)};
        for (size_t i = 0; i < voxels; ++i)
            for (size_t c = 0; c < 3; ++c) result.fluence.values[3 * i + c] = fluence(c)[i];
    }
    if (!plan.wants(Output::direction)) return result;
    result.direction = {mSize, 3, std::vector<float>(voxels * 3, 0.0f)};
    const glm::mat3 worldFromVoxel(plan.scene.worldFromVoxelTurn());
    for (size_t i = 0; i < voxels; ++i) {
        const float power = fluence(0)[i] + fluence(1)[i] + fluence(2)[i];
        if (!(power > 0)) continue;
        glm::vec3 mean(values[channels][i], values[channels + 1][i], values[channels + 2][i]);
        mean /= power;
        const float length = glm::length(mean);
        if (length > 1) mean /= length; // rounding of the fixed-point sums
        mean = worldFromVoxel * mean;
        for (int c = 0; c < 3; ++c) result.direction.values[3 * i + c] = mean[c];
    }
    return result;
}

} // namespace eikonal::lightsim
