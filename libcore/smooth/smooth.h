// The smoothing stage: a separable Gaussian over whole grids, so that rays see no voxel's edge.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "gpu/device.h"
#include "smooth/plan.h"

#include <cstdint>
#include <limits>

namespace eikonal::smooth {

/// Smooths the plan's grids; edges clamp, and values that do not count are left out of the means.
/// Fills passes and counters of `stats`. A component is smoothed in slabs where it is larger than
/// the device's buffers, or than `slabBytes` [byte]; the values do not depend on that. Throws
/// MemoryError before the work if not even the thinnest fits.
std::vector<Item> run(gpu::Device& device, Plan plan, Stats& stats, const Progress& progress,
                      std::int64_t slabBytes = std::numeric_limits<std::int64_t>::max());

} // namespace eikonal::smooth
