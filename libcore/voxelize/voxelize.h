// The voxelising stage: meshes and materials in, a scene volume out (Sun et al. 2008, §4.1).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "gpu/device.h"
#include "volume/volume.h"
#include "voxelize/lattice.h"
#include "voxelize/plan.h"

namespace eikonal::voxelize {

struct Result {
    volume::Volume volume;
    std::vector<std::string> warnings; ///< objects that cover nothing, walls too thin for distances
};

/// Fills the grids of `plan`. A grid in which nothing but the background came to lie is left out
/// and its effect is off. `stats` gets effects, passes and counters. Throws MemoryError if the
/// device can't hold `stripBytes` of the volume, or what is less of many objects.
Result voxelize(gpu::Device& device, const Params& params, const Plan& plan, Stats& stats,
                const Progress& progress = {}, std::int64_t stripBytes = kStripBytes);

} // namespace eikonal::voxelize
