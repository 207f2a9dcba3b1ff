// A picture in the making: colours, rays' paths and counters, strip by strip.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "view/shared.h"
#include "view/view.h"

namespace eikonal::view {

/// Rows traced by one launch: about a million pixels (of several domains a sixteenth, for the rays
/// between them), so that the largest buffer stays at 64 MiB, half of what every device holds, and
/// progress is shown now and then.
int rowsPerStrip(const Params& params, bool several);

/// How many of a ray's branches may wait. What is mirrored when they are as many goes along with
/// what is refracted, as where it is too dim to follow.
int branchesWaiting(const Params& params);

/// Whether the kernel writes each ray's path, which AOVs and coloured opacities are made from.
bool wantsPaths(const Plan& plan, const Params& params);

/// What a strip takes on the device.
std::vector<gpu::Need> pictureNeeds(const std::vector<Plan>& plans, const Params& params);

class Picture {
public:
    Picture(gpu::Device& device, const std::vector<Plan>& plans, const Params& params);

    void bind() const;
    /// Before a launch: none of its rays rests yet.
    void clearRests();
    /// How many of the last launch's rays go on in another one.
    int resting() const;
    /// Fetches a strip from the device.
    void readStrip(int row, int rows);
    /// Adds what was counted to the statistics.
    void readCounters(const std::vector<Plan>& plans, const Params& params, Stats& stats) const;
    /// Colours, opacities by wavelength where the medium is coloured, and the AOVs asked for.
    image::Image assemble(const std::vector<Plan>& plans, const Params& params) const;

private:
    gpu::Buffer mColours, mPaths, mCounters, mRests;
    std::vector<vec4> mPixels;
    std::vector<PixelPath> mPixelPaths;
    int mWidth;
};

} // namespace eikonal::view
