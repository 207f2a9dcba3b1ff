// Fixed-point sums to floats: one batch of one light, added to what was there before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/totals.glsl"

#if !defined(CHANNELS)
#error CHANNELS must be 1 or 3
#endif
const bool kColour = CHANNELS == 3;
layout(r32ui, binding = kPlanesImage) uniform uimage3D sums;

// Of the plane that begins there.
float taken(ivec3 texel, int plane) {
    ivec3 at = texel + planeAt(plane);
    uint sum = imageLoad(sums, at).x;
    imageStore(sums, at, uvec4(0u));
    return float(sum);
}

void main() {
    int slot = slotOf();
    if (slot >= params.size.w) return;
    ivec3 voxel = voxelInBrick();
    ivec3 source = texelInAtlas(slot, voxel, params.apart.x);
    ivec3 target = texelInAtlas(slot, voxel, params.apart.y);
    vec3 sum = vec3(taken(source, 0));
    if (kColour) sum.yz = vec2(taken(source, 1), taken(source, 2));
    for (int c = 0; c < FLUENCE; ++c) give(target, c, sum[c] * params.fluence[c]);
    if (kDirection) {
        // The planes hold (1 + d)/2 of the power: see deposit.glsl.
        float power = dot(sum, params.colour.xyz);
        for (int i = 0; i < 3; ++i)
            give(target, FLUENCE + i, (2.0 * taken(source, CHANNELS + i) - power) * params.colour.w);
    }
}
