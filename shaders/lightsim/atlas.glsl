// Kernels that run over all bricks that receive light: a work item a voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/bricks.glsl"
#include "shared/lightsim_params.h"

#if !defined(DIRECTION) || !defined(FLUENCE)
#error DIRECTION must be 0 or 1, FLUENCE 1 or 3
#endif
const bool kDirection = DIRECTION == 1;
// Channels of fluence, then the direction's three planes, power times direction.
const int kTotals = FLUENCE + 3 * DIRECTION;

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { ResolveParams params; };

// The brick's place on the list. Along three dimensions, since one alone may be too short.
int slotOf() {
    return int(gl_GlobalInvocationID.y + gl_GlobalInvocationID.z * gl_NumWorkGroups.y);
}

ivec3 voxelInBrick() {
    int place = int(gl_GlobalInvocationID.x);
    return ivec3(place, place >> kBrickBits, place >> (2 * kBrickBits)) & (kBrickEdge - 1);
}

// In an atlas where bricks are so far apart along z.
ivec3 texelInAtlas(int slot, ivec3 voxel, int apart) {
    ivec3 place = ivec3(slot % params.atlas.x, slot / params.atlas.x % params.atlas.y,
                        slot / (params.atlas.x * params.atlas.y) * apart);
    return (place << kBrickBits) + voxel;
}

// Where a plane begins, from the first one on.
ivec3 planeAt(int plane) {
    return ivec3(0, 0, plane * params.bricks.w);
}
