// All that receives the light of a simulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/receivers.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::vec3;

/// What bounces falls on fine voxels, too.
void addBounced(volume::FineGrid& irradiance, const BouncedLight& bounced) {
    tbb::parallel_for(size_t{0}, irradiance.voxels.size(), [&](size_t i) {
        const vec3 x =
            (vec3(irradiance.voxels[i]) + 0.5F) / static_cast<float>(irradiance.detail) - 0.5F;
        irradiance.values[i] += bounced.ofFine(static_cast<std::uint32_t>(i), x).irradiance;
    });
}

} // namespace

Receivers::Receivers(gpu::Device& device, const Plan& plan, const Params& params,
                     const scene::Transport& transport, const Media& media, gpu::Profiler& profiler)
    : mPhotonsLand(!plan.beams), mBounces(plan.bounces > 0) {
    if (plan.receivesInVolume()) mVoxels.emplace(device, plan, params);
    if (!plan.surfaces.empty()) mSurfaces.emplace(device, plan, transport, media, profiler);
}

void Receivers::renew(gpu::Device& device, const Plan& plan, const Params& params) {
    if (mVoxels) mVoxels.emplace(device, plan, params);
    if (mSurfaces) mSurfaces->renew(device);
    mPhotonPower = 0;
}

void Receivers::bind() const {
    if (mVoxels) mVoxels->bind();
    if (mSurfaces) mSurfaces->bind();
}

void Receivers::clear() {
    if (mVoxels) mVoxels->clearPlanes();
    if (mSurfaces) mSurfaces->clearSums();
}

void Receivers::resolve(gpu::Device& device, const Unit& of, double unit, bool bounced) {
    if (mVoxels) mVoxels->resolve(device, of, unit);
    if (mSurfaces && (bounced || mPhotonsLand))
        mSurfaces->collect(device, of.rgb, of.power, unit, bounced);
    if (bounced)
        mPhotonPower = std::max(mPhotonPower, of.power * (of.rgb.x + of.rgb.y + of.rgb.z) / 3);
}

BouncedLight Receivers::takeBounced(const Plan& plan) {
    const double edge = plan.scene.voxelSize();
    return {plan.scene.size(), mSurfaces->takeBounced(), mPhotonPower / (edge * edge)};
}

void Receivers::readPoints(gpu::Device& device, const Plan& plan) {
    std::vector<LightAtPoint> lights =
        mSurfaces->readPoints(device, plan.points, plan.scene.worldFromVoxelTurn());
    if (mBounces) {
        const BouncedLight bounced = takeBounced(plan);
        const glm::mat3 turn(plan.scene.worldFromVoxelTurn());
        for (size_t i = 0; i < lights.size(); ++i) {
            if (plan.points[i].normal == vec3(0)) continue;
            const LightAtPoint more = bounced.at(plan.points[i].place, plan.points[i].normal);
            lights[i].irradiance += more.irradiance;
            lights[i].flow += turn * more.flow;
        }
    }
    mPoints.push_back(std::move(lights));
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
    if (mSurfaces && plan.points.empty()) {
        result.irradiance = mSurfaces->finish(device);
        if (mBounces) addBounced(result.irradiance, takeBounced(plan));
    }
    if (mSurfaces && !plan.points.empty() && !params.lightsApart) readPoints(device, plan);
    result.points = std::move(mPoints);
    profiler.end();
    profiler.collect();
    return result;
}

} // namespace eikonal::lightsim
