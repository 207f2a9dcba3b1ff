// Opaque surfaces that receive light: fixed-point sums that become irradiance.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"
#include "lightsim/bounces.h"
#include "lightsim/media.h"
#include "lightsim/plan.h"
#include "lightsim/points.h"
#include "lightsim/result.h"
#include "lightsim/shared.h"
#include "scene/surface_voxels.h"
#include "scene/transport.h"

#include <optional>
#include <vector>

namespace eikonal::lightsim {

class SurfaceReceiver {
public:
    SurfaceReceiver() = default;
    /// Finds the surface voxels and how much of a surface each has.
    SurfaceReceiver(gpu::Device& device, const Plan& plan, const scene::Transport& transport,
                    const Media& media, gpu::Profiler& profiler);

    /// What power is added to, and the table of surface voxels.
    void bind() const;
    /// For points: which bricks hold surface voxels at all.
    void bindReceiving() const;
    void clearSums();
    /// Adds what the sums hold to the power, or to that of what bounces, and clears them. `rgb` is
    /// the light's, `unit` of fixed point stands for `power` of it [m² or sr].
    void collect(gpu::Device& device, const glm::dvec3& rgb, double power, double unit,
                 bool bounced = false);
    /// Power over area, after which nothing more is received until renew().
    volume::FineGrid finish(gpu::Device& device);
    /// What comes next is summed anew.
    void renew(gpu::Device& device);
    /// The light of points, flow turned to the world; what comes after is summed anew.
    std::vector<LightAtPoint> readPoints(gpu::Device& device,
                                         const std::vector<PointOnSurface>& points,
                                         const glm::dmat3& turn);

    /// What bounces, by the domain's voxels; what comes after is summed anew.
    SurfacePatches takeBounced();

    std::int64_t count() const { return mVoxels.count; }
    int detail() const { return mVoxels.detail; }

private:
    gpu::Texture makeIrradiance(gpu::Device& device);
    void link(SurfacePatches& patches) const;

    scene::SurfaceVoxels mVoxels;
    scene::SurfaceTable mTable;
    gpu::Program mCollect, mIrradiance;
    gpu::Buffer mBlock, mList, mAreas, mReceiving, mSums;
    gpu::Texture mPower, mBounced; ///< [W]
    std::optional<PointReader> mReader;
    int mChannels = 1, mStored = 1;
    bool mFlow = false; ///< flow is summed, too
    double mVoxelSize = 1;
};

/// What they take on the device.
std::vector<gpu::Need> surfaceNeeds(const Plan& plan);

} // namespace eikonal::lightsim
