// All that receives the light of a simulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "lightsim/voxels.h"

namespace eikonal::lightsim {

class Receivers {
public:
    Receivers(gpu::Device& device, const Plan& plan, const Params& params);

    /// Before photons are traced.
    void bind() const;
    /// Forgets what the last batch left.
    void clear();
    /// Takes up what a batch left. `rgb` is the light's, a photon of weight 1 has `power` of it [m²
    /// or sr], `unit` of fixed point stands for a voxel's length at weight 1.
    void resolve(gpu::Device& device, const glm::dvec3& rgb, double power, double unit);
    /// After the last batch.
    Result finish(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats);

private:
    VoxelReceiver mVoxels;
};

} // namespace eikonal::lightsim
