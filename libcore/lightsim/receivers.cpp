// All that receives the light of a simulation.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/receivers.h"

namespace eikonal::lightsim {

Receivers::Receivers(gpu::Device& device, const Plan& plan, const Params& params)
    : mVoxels(device, plan, params) {}

void Receivers::bind() const {
    mVoxels.bind();
}

void Receivers::clear() {
    mVoxels.clearPlanes();
}

void Receivers::resolve(gpu::Device& device, const glm::dvec3& rgb, double power, double unit) {
    mVoxels.resolve(device, rgb, power, unit);
}

Result Receivers::finish(gpu::Device& device, const Plan& plan, const Params& params,
                         Stats& stats) {
    gpu::Profiler profiler(stats);
    if (params.smoothing > 0) {
        profiler.begin("smooth");
        mVoxels.smooth(device, params.smoothing);
        profiler.end();
    }
    profiler.begin("download");
    Result result = mVoxels.download(plan);
    profiler.end();
    profiler.collect();
    return result;
}

} // namespace eikonal::lightsim
