// Fixed-point sums to floats: one batch of one light, added to what was there before.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/lightsim_params.h"

#if !defined(CHANNELS) || !defined(FLUENCE) || !defined(DIRECTION)
#error CHANNELS and FLUENCE must be 1 or 3, DIRECTION 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { ResolveParams params; };
layout(std430, binding = kPlanesBuffer) buffer Plane { uint sums[]; } planes[CHANNELS + 3 * DIRECTION];
layout(std430, binding = kTotalsBuffer) buffer Result { float values[]; } results[FLUENCE + 3 * DIRECTION];

void main() {
    // Two dimensions, since one alone may be too short for the voxels of a large volume.
    uint voxel = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * 64u) + gl_GlobalInvocationID.x;
    if (voxel >= uint(params.size.w)) return;
    vec3 sum = vec3(float(planes[0].sums[voxel]));
    planes[0].sums[voxel] = 0u;
#if CHANNELS == 3
    sum.y = float(planes[1].sums[voxel]);
    sum.z = float(planes[2].sums[voxel]);
    planes[1].sums[voxel] = 0u;
    planes[2].sums[voxel] = 0u;
#endif
    results[0].values[voxel] += sum.x * params.fluence.x;
#if FLUENCE == 3
    results[1].values[voxel] += sum.y * params.fluence.y;
    results[2].values[voxel] += sum.z * params.fluence.z;
#endif
#if DIRECTION
    // The planes hold (1 + d)/2 of the power: see deposit.glsl.
    float power = dot(sum, params.colour.xyz);
    results[FLUENCE + 0].values[voxel] +=
        (2.0 * float(planes[CHANNELS + 0].sums[voxel]) - power) * params.colour.w;
    results[FLUENCE + 1].values[voxel] +=
        (2.0 * float(planes[CHANNELS + 1].sums[voxel]) - power) * params.colour.w;
    results[FLUENCE + 2].values[voxel] +=
        (2.0 * float(planes[CHANNELS + 2].sums[voxel]) - power) * params.colour.w;
    planes[CHANNELS + 0].sums[voxel] = 0u;
    planes[CHANNELS + 1].sums[voxel] = 0u;
    planes[CHANNELS + 2].sums[voxel] = 0u;
#endif
}
