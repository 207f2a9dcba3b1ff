// What voxels have got so far, in floats: channels of fluence, then the direction's planes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/atlas.glsl"

layout(r32f, binding = kTotalsImage) uniform image3D totals;

// To the plane that begins there.
void give(ivec3 texel, int plane, float amount) {
    ivec3 at = texel + planeAt(plane);
    imageStore(totals, at, vec4(imageLoad(totals, at).x + amount));
}
