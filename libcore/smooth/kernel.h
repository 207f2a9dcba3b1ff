// The taps of a Gaussian, in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace eikonal::smooth {

/// Half of a symmetric kernel: entry k weighs the voxels k before and k behind the centre, entry 0
/// the centre; entry 0 plus twice the others is 1. exp(−k²/2σ²) over its sum; σ [voxel] is the
/// standard deviation, 0 leaves the centre alone. `width` is odd.
std::vector<double> gaussianWeights(double sigma, int width);

/// The same kernel for an axis of `voxels` voxels with clamped edges: every tap from the far end on
/// reads that end, so their weights are summed there and no tap is beyond it.
std::vector<double> foldedWeights(const std::vector<double>& weights, int voxels);

} // namespace eikonal::smooth
