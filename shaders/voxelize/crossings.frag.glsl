// Each fragment is one sub-column passing through the surface: booked where it happens.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/voxelize_params.h"

layout(std140, binding = kParamsBlock) uniform Params { StripParams params; };
layout(std430, binding = kChangesBuffer) buffer Changes { int changes[]; }; // z fastest, then x, y
layout(location = 0) flat in vec4 depth;
layout(location = 1) flat in vec4 slope;

void main() {
    int samples = params.size.w;
    ivec2 column = ivec2(gl_FragCoord.xy) / samples - ivec2(0, params.place.x);
    if (column.x >= params.size.x || column.y < 0 || column.y >= params.size.y) return;
    // Held to the triangle's own depths: the plane of one seen edge-on is too steep for floats.
    float z = depth.x + dot(slope.zw, gl_FragCoord.xy - slope.xy);
    z = clamp(z, depth.y, depth.z);
    // The first sub-sample, at k + 1/2, that lies at or behind the crossing.
    int first = max(int(ceil(z - 0.5)), 0);
    int voxel = first / samples;
    int passed = first - voxel * samples;
    if (voxel >= params.size.z) return;
    int sign = depth.w > 0.0 ? 1 : -1;
    int at = (column.y * params.size.x + column.x) * params.size.z + voxel;
    atomicAdd(changes[at], sign * (samples - passed));
    if (passed > 0 && voxel + 1 < params.size.z) atomicAdd(changes[at + 1], sign * passed);
}
