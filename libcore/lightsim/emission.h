// How photons leave a light: one for every pixel of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/photon_map.h"
#include "lightsim/photons.h"

namespace eikonal::lightsim {

/// A part of a window of a light's photon map.
struct Batch {
    Window window;
    glm::ivec4 place{0, 0, 1, 0}; ///< its pixels are every z-th of the window's, from x, y on
};

/// The interleaved parts of a window, none of more than kBatchPixels.
std::vector<Batch> batchesOf(const Window& window);

class Emission {
public:
    Emission(gpu::Device& device, const Plan& plan, const Params& params);

    /// The windows through which a light in voxel space sees what photons start on.
    std::vector<Window> windowsOf(const Light& light, const Params& params) const;

    /// Fills `photons` and its list. Returns how many there are.
    std::uint32_t emit(gpu::Device& device, const scene::Transport& transport, const Batch& batch,
                       Photons& photons);

private:
    gpu::Program mMapProgram, mProgram;
    gpu::Buffer mSurface, mBlock;
    std::int64_t mCorners = 0;
    VoxelBox mDomain, mTarget;
    int mReceivers; ///< that receive light, along an edge of a voxel
    std::uint32_t mSeed = 0;
    bool mManyObjects; ///< more than a photon's own bits tell
};

} // namespace eikonal::lightsim
