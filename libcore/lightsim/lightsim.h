// The light stage: photons through a scene volume, fluence and direction out (Sun et al. 2008).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "lightsim/plan.h"
#include "lightsim/result.h"

#include <functional>

namespace eikonal::lightsim {

/// What a light alone gives, by its place in Params::lights.
using TakeLight = std::function<void(size_t light, const Result& result)>;

/// Sends every light through the scene. Fills passes, counters and energy of `stats`. Of lights
/// apart, but for points, `take` gets each one's result as soon as it is there. Throws MemoryError
/// before the work if the device can't hold it.
Result simulate(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats,
                const Progress& progress, const TakeLight& take = {});

/// The octree that `simulate` steps by: per voxel the level of its leaf, and the longest step
/// there [voxel], 1e6 standing for no limit.
struct OctreeDump {
    volume::DenseGrid level, stepLimit;
};
OctreeDump dumpOctree(const Plan& plan, const Params& params);

} // namespace eikonal::lightsim
