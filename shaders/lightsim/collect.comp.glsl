// What a batch left in the fixed-point sums of surface voxels, added to their power.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "transport/surface_voxels.glsl"

#if !defined(CHANNELS) || !defined(FLUENCE) || !defined(SURFACE_FLOW)
#error CHANNELS and FLUENCE must be 1 or 3, SURFACE_FLOW 0 or 1
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { LayoutParams params; };
layout(std430, binding = kSurfaceSumsBuffer) readonly buffer SurfaceSums { uint sums[]; };
layout(r32f, binding = kSurfacePowerImage) uniform image3D power; // [W], then that of flow

void main() {
    int number = int(gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6));
    if (number >= params.list.z) return;
    for (int c = 0; c < FLUENCE; ++c) {
        int from = number + (CHANNELS == 3 ? c : 0) * params.list.z;
        ivec3 to = surfaceTexel(number + c * params.list.z);
        float sum = float(sums[from]) * params.weight[c];
        imageStore(power, to, vec4(imageLoad(power, to).x + sum, 0.0, 0.0, 0.0));
    }
    for (int c = 0; c < 3 && SURFACE_FLOW == 1; ++c) { // the means of the channels, in halves
        int from = number + (CHANNELS + c) * params.list.z;
        ivec3 to = surfaceTexel(number + (FLUENCE + c) * params.list.z);
        float sum = float(int(sums[from])) * 2.0 * params.weight.w;
        imageStore(power, to, vec4(imageLoad(power, to).x + sum, 0.0, 0.0, 0.0));
    }
}
