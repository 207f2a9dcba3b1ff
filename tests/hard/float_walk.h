// The steps of rays in float, as devices take them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace eikonal::hard {

/// How far a walk's invariants strayed from their values at the start.
struct Drift {
    double index = 0;           ///< most of | |w| − n | [1]
    double angularMomentum = 0; ///< most of the change of n r sinφ [voxel]
};

/// Steps of `tau` round Maxwell's fish-eye n = 2/(1 + r²) of radius `radius` [voxel], from its unit
/// circle and at `tangent` to it, by drift–kick–drift or kick–drift–kick.
Drift walkInFloat(double radius, double tangent, double tau, int steps, bool kicksFirst);

} // namespace eikonal::hard
