// Prefix sums of a list of counts on the device.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/scan.h"

#include "lightsim/dispatch.h"
#include "lightsim/shared.h"

namespace eikonal::lightsim {

namespace {

std::int64_t runsOf(std::int64_t count) {
    return (count + kScanRun - 1) / kScanRun;
}

} // namespace

Scan::Scan(gpu::Device& device)
    : mSum(device, "lightsim/scan.comp.glsl", {{"SUMS", 1}}),
      mTell(device, "lightsim/scan.comp.glsl", {{"SUMS", 0}}), mBlock(device, 16) {}

void Scan::dispatch(const gpu::Program& program, const gpu::Buffer& counts, const gpu::Buffer& sums,
                    std::int64_t count) {
    const uvec4 list(static_cast<std::uint32_t>(count), 0, 0, 0);
    mBlock.upload(&list, sizeof list);
    mBlock.bindUniform(kParamsBlock);
    counts.bindStorage(kScanCountsBuffer);
    sums.bindStorage(kScanSumsBuffer);
    dispatchList(program, runsOf(count));
}

std::uint32_t Scan::run(gpu::Device& device, gpu::Buffer& counts, std::int64_t count) {
    std::vector<std::int64_t> sizes{count};
    while (sizes.back() > 1) sizes.push_back(runsOf(sizes.back()));
    for (size_t level = 0; level + 1 < sizes.size(); ++level) {
        if (mSums.size() <= level) mSums.emplace_back();
        if (mSums[level].bytes() < 4 * sizes[level + 1])
            mSums[level] = gpu::Buffer(device, 4 * sizes[level + 1]);
        dispatch(mSum, level == 0 ? counts : mSums[level - 1], mSums[level], sizes[level]);
    }
    gpu::Buffer& top = sizes.size() == 1 ? counts : mSums[sizes.size() - 2];
    std::uint32_t sum = 0;
    top.download(&sum, sizeof sum);
    const std::uint32_t zero = 0;
    top.upload(&zero, sizeof zero);
    for (size_t level = sizes.size() - 1; level-- > 0;)
        dispatch(mTell, level == 0 ? counts : mSums[level - 1], mSums[level], sizes[level]);
    return sum;
}

} // namespace eikonal::lightsim
