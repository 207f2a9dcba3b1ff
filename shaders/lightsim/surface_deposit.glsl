// Light that lands on opaque surfaces: fixed-point sums by surface voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where CHANNELS is known.
#include "shared/bindings.h"
#include "shared/limits.h"
#include "transport/surface_voxels.glsl"

// A plane for each traced channel, one behind the other.
layout(r32ui, binding = kSurfaceSumsImage) uniform uimage3D surfaceSums;

const uint kMissedSurface = 0xFFFFFFFFu;

// Adds power in fixed point to the surface voxel there, or the next along a step. Returns the largest sum
// that it was added to, or kMissedSurface.
uint putOnSurface(ivec3 fine, ivec3 along, vec3 amount, inout float phase) {
    int number = surfaceVoxelOf(fine);
    for (int step = 1; step <= 2 && number < 0; ++step) {
        number = surfaceVoxelOf(fine + step * along);
        if (number < 0) number = surfaceVoxelOf(fine - step * along);
    }
    // Rounded up as often as the fraction says: nothing is gained or lost on average.
    phase = fract(phase + 0.61803399);
    if (number < 0) return kMissedSurface;
    uint fullest = 0u;
    for (int c = 0; c < CHANNELS; ++c) {
        uint whole = uint(amount[c] + phase);
        if (whole > 0u) {
            ivec3 texel = surfaceTexel(number + c * int(surface.table.w));
            fullest = max(fullest, imageAtomicAdd(surfaceSums, texel, whole));
        }
    }
    return fullest;
}
