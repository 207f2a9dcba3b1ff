// All that receives the light of a simulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/receivers.h"

namespace eikonal::lightsim {

Receivers::Receivers(gpu::Device& device, const Plan& plan, const Params& params,
                     const scene::Transport& transport, const Media& media, gpu::Profiler& profiler)
    : mPhotonsLand(!plan.beams) {
    if (plan.receivesInVolume()) mVoxels.emplace(device, plan, params);
    if (!plan.surfaces.empty()) mSurfaces.emplace(device, plan, transport, media, profiler);
}

void Receivers::bind() const {
    if (mVoxels) mVoxels->bind();
    if (mSurfaces) mSurfaces->bind();
}

void Receivers::clear() {
    if (mVoxels) mVoxels->clearPlanes();
    if (mSurfaces) mSurfaces->clearSums();
}

void Receivers::resolve(gpu::Device& device, const glm::dvec3& rgb, double power, double unit) {
    if (mVoxels) mVoxels->resolve(device, rgb, power, unit);
    if (mSurfaces && mPhotonsLand) mSurfaces->collect(device, rgb, power, unit);
}

void Receivers::readPoints(gpu::Device& device, const Plan& plan) {
    mPoints.push_back(mSurfaces->readPoints(device, plan.points, plan.scene.worldFromVoxelTurn()));
}

Result Receivers::finish(gpu::Device& device, const Plan& plan, const Params& params,
                         Stats& stats) {
    gpu::Profiler profiler(stats);
    if (mVoxels && params.smoothing > 0) {
        profiler.begin("smooth");
        mVoxels->smooth(device, params.smoothing);
        profiler.end();
    }
    profiler.begin("download");
    Result result;
    if (mVoxels) result = mVoxels->download(plan);
    if (mSurfaces && plan.points.empty()) result.irradiance = mSurfaces->finish(device);
    if (mSurfaces && !plan.points.empty() && !params.lightsApart) readPoints(device, plan);
    result.points = std::move(mPoints);
    profiler.end();
    profiler.collect();
    return result;
}

} // namespace eikonal::lightsim
