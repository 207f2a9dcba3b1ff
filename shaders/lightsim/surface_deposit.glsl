// Light that lands on opaque surfaces: fixed-point sums by surface voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where CHANNELS is known, and SURFACE_FLOW: whether the direction that light travels in is summed, too.
#include "shared/bindings.h"
#include "shared/limits.h"
#include "transport/surface_voxels.glsl"

const bool kFlow = SURFACE_FLOW == 1;

// A plane for each traced channel, one behind the other, then three of flow.
// In a buffer: software devices add to one in an eighth of what adding to an image takes.
layout(std430, binding = kSurfaceSumsBuffer) buffer SurfaceSums { uint surfaceSums[]; };

const uint kMissedSurface = 0xFFFFFFFFu;

// Light in fixed point: its power by channel, and that times the unit vector along which it travels.
struct Light {
    vec3 power;
    vec3 flow;
};

// Of power that travels along `direction`. `colour` weighs the channels.
Light lightOf(vec3 power, vec3 direction, vec3 colour) {
    return Light(power, kFlow ? (CHANNELS == 3 ? dot(power, colour) : power.x) * direction : vec3(0.0));
}

Light scaled(Light light, float share) {
    return Light(share * light.power, share * light.flow);
}

// Adds light to the surface voxel there, or the next along a step. Returns the largest sum that it was added
// to, or kMissedSurface.
uint putOnSurface(ivec3 fine, ivec3 along, Light light, inout float phase) {
    int number = -1;
    for (int k = 0; k < 5 && number < 0; ++k) // 0, 1, −1, 2, −2
        number = surfaceVoxelOf(fine + ((k & 1) == 1 ? 1 : -1) * ((k + 1) >> 1) * along);
    // Rounded up as often as the fraction says: nothing is gained or lost on average.
    phase = fract(phase + 0.61803399);
    if (number < 0) return kMissedSurface;
    uint fullest = 0u;
    for (int c = 0; c < CHANNELS; ++c) {
        uint whole = uint(light.power[c] + phase);
        if (whole > 0u) {
            fullest = max(fullest, atomicAdd(surfaceSums[number + c * int(surface.table.w)], whole));
        }
    }
    // Half of it: signed sums end halfway.
    for (int c = 0; c < 3 && kFlow; ++c) {
        int at = number + (CHANNELS + c) * int(surface.table.w);
        atomicAdd(surfaceSums[at], uint(int(floor(0.5 * light.flow[c] + phase))));
    }
    return fullest;
}
