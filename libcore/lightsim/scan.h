// Prefix sums of a list of counts on the device.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"

#include <cstdint>
#include <vector>

namespace eikonal::lightsim {

/// Sums run by run, sums of those and so on up to one, and back: the order of the list decides
/// where each entry goes, however the device schedules its work.
class Scan {
public:
    explicit Scan(gpu::Device& device);

    /// Replaces each of `count` 32-bit counts by the sum of those before it. Returns the sum of
    /// all, which must be below 2^32. Waits for the device.
    std::uint32_t run(gpu::Device& device, gpu::Buffer& counts, std::int64_t count);

private:
    void dispatch(const gpu::Program& program, const gpu::Buffer& counts, const gpu::Buffer& sums,
                  std::int64_t count);

    gpu::Program mSum, mTell;
    gpu::Buffer mBlock;
    std::vector<gpu::Buffer> mSums; ///< of runs, of runs of those, ...
};

} // namespace eikonal::lightsim
