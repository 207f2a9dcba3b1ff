// Light under a ball of glass: what lightsim makes of it, what Snell and Fresnel do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace eikonal::sharp {

/// A sun aslant through a ball of glass, radius 0.5, n 1.5, and the fluence in the plane of voxels
/// at 0.75 below its centre, in a domain of 1.6 units and `voxels` a side. Both smoothed by one
/// round of 1 2 1. √(Σ (found − wanted)² / Σ wanted²) over the plane.
double fluenceError(int voxels, std::int64_t photons);

} // namespace eikonal::sharp
