// All that receives the light of a simulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "lightsim/sources.h"
#include "lightsim/surfaces.h"
#include "lightsim/voxels.h"

#include <optional>

namespace eikonal::lightsim {

class Receivers {
public:
    Receivers(gpu::Device& device, const Plan& plan, const Params& params,
              const scene::Transport& transport, const Media& media, gpu::Profiler& profiler);

    /// Before photons are traced.
    void bind() const;
    /// Forgets what the last batch left.
    void clear();
    /// Takes up what a batch left. A photon of weight 1 has that power, `unit` of fixed point
    /// stands for a voxel's length at weight 1.
    void resolve(gpu::Device& device, const Unit& of, double unit, bool bounced);
    VoxelReceiver& voxels() { return *mVoxels; }
    SurfaceReceiver& surfaces() { return *mSurfaces; }
    /// After finish(): what comes next is received anew.
    void renew(gpu::Device& device, const Plan& plan, const Params& params);
    /// The light of points since they were read last.
    void readPoints(gpu::Device& device, const Plan& plan);
    /// After the last batch.
    Result finish(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats);

private:
    BouncedLight takeBounced(const Plan& plan);

    std::optional<VoxelReceiver> mVoxels;
    std::optional<SurfaceReceiver> mSurfaces;
    std::vector<std::vector<LightAtPoint>> mPoints;
    bool mPhotonsLand;       ///< on surfaces; else beams do
    bool mBounces;           ///< surfaces send light on
    double mPhotonPower = 0; ///< of the brightest photon that may have bounced [W], the mean of rgb
};

} // namespace eikonal::lightsim
