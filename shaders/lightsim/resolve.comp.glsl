// Fixed-point sums to floats: one plane of one light, added to what other lights left there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/lightsim_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { ResolveParams params; };
layout(std430, binding = 0) buffer Plane { uint words[]; };
layout(std430, binding = 1) buffer First { float first[]; };
layout(std430, binding = 2) buffer Second { float second[]; };
layout(std430, binding = 3) buffer Third { float third[]; };

void main() {
    // Two dimensions, since one alone may be too short for the voxels of a large volume.
    uint voxel = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * 64u) + gl_GlobalInvocationID.x;
    uint voxels = uint(params.size.w);
    if (voxel >= voxels) return;
    uint low = words[voxel];
    uint high = words[voxels + voxel];
    if (low == 0u && high == 0u) return;
    words[voxel] = 0u;
    words[voxels + voxel] = 0u;
    bool negative = high >= 0x80000000u;
    if (negative) {
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    float sum = float(high) * 4294967296.0 + float(low);
    sum = negative ? -sum : sum;
    // planes.y: 1 adds to the first target alone, 3 spreads one traced channel over three.
    first[voxel] += sum * params.fluence.x;
    if (params.planes.y == 3) {
        second[voxel] += sum * params.fluence.y;
        third[voxel] += sum * params.fluence.z;
    }
}
