// Several domains in one picture: rays go from one to the next.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "view/view.h"

namespace eikonal::view {

/// Rays between domains, and what kernels know of the other ones.
class Domains {
public:
    Domains(gpu::Device& device, const std::vector<Plan>& plans, const Params& params);

    /// Before a launch of rays from the eye: none is on its way.
    void clear();
    /// For a launch of that domain's kernel, of rays from the eye or of those that arrive.
    void bind(size_t domain, bool arrivals);
    /// How many rays are on their way.
    std::uint32_t waiting() const;

private:
    std::vector<gpu::Buffer> mBlocks;
    std::vector<std::vector<std::byte>> mValues;
    gpu::Buffer mDepartures, mPending;
};

/// What they take on the device.
std::vector<gpu::Need> domainNeeds(const Params& params);

/// Where one domain disperses light all kernels trace it by wavelength.
void shareDispersion(std::vector<Plan>& plans);

} // namespace eikonal::view
