// Voxels that receive light: fixed-point sums that become fluence and mean direction.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "lightsim/plan.h"
#include "lightsim/result.h"

namespace eikonal::lightsim {

/// The largest fixed-point unit, a power of two, with which every photon of a batch may cross one
/// voxel from corner to corner and still leave an eighth of the range free (kNearFull in
/// shaders/lightsim/deposit.glsl). Not above 2^24, the digits of a float: a deposit then fits an
/// int, too.
double unitFor(double photons);

class VoxelReceiver {
public:
    VoxelReceiver(gpu::Device& device, const Plan& plan, const Params& params);

    size_t planes() const { return mPlanes.size(); }
    void bindPlanes() const;
    void clearPlanes();
    /// Adds what the planes hold to the totals, and clears them. `rgb` is the light's, a photon of
    /// weight 1 has `power` of it [m² or sr], `unit` stands for a voxel's length at weight 1.
    void resolve(gpu::Device& device, const glm::dvec3& rgb, double power, double unit);
    /// Rounds of 3×3×3 smoothing, after which nothing more is received.
    void smooth(gpu::Device& device, int rounds);
    Result download(const Plan& plan) const;

private:
    gpu::Program mResolve, mSmooth;
    gpu::Buffer mBlock;
    std::vector<gpu::Buffer> mPlanes, mTotals; ///< totals: channels of fluence, then of direction
    glm::ivec3 mSize;
    double mVoxelSize;
};

} // namespace eikonal::lightsim
