// Light at single points of opaque surfaces, between the surface voxels' columns round each.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "transport/surface_columns.glsl"

#ifndef FLUENCE
#error FLUENCE must be 1 or 3
#endif

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { LayoutParams params; };
layout(std430, binding = kSurfacePointsBuffer) readonly buffer SurfacePoints { SurfacePoint points[]; };
layout(std430, binding = kPointLightsBuffer) writeonly buffer PointLights { PointLight lights[]; };
layout(r32f, binding = kIrradianceImage) uniform readonly image3D irradiance; // [W/m²], then that of flow

float stored(int number, int plane) {
    return imageLoad(irradiance, surfaceTexel(number + plane * params.list.z)).x;
}

void main() {
    uint item = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * (gl_NumWorkGroups.x << 6);
    if (item >= uint(params.list.x)) return;
    SurfacePoint point = points[item];
    PointLight light = PointLight(vec4(0.0), vec4(0.0));
    if (point.normal.xyz != vec3(0.0)) {
        Columns columns = columnsAt(point.place.xyz, point.normal.xyz);
        for (int i = 0; i < 4; ++i) {
            int number = columns.numbers[i];
            if (number < 0) continue;
            for (int c = 0; c < 3; ++c) {
                light.irradiance[c] += columns.weights[i] * stored(number, min(c, FLUENCE - 1));
                light.flow[c] += columns.weights[i] * stored(number, FLUENCE + c);
            }
        }
    }
    lights[item] = light;
}
