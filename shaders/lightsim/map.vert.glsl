// The domain's faces, or a proxy mesh, seen from the light (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/lightsim_params.h"

layout(std140, binding = kParamsBlock) uniform Params { EmissionParams params; };
layout(std430, binding = kCornersBuffer) readonly buffer Corners { vec4 corners[]; }; // three a triangle [voxel]
layout(location = 0) out vec3 place;

void main() {
    place = corners[gl_VertexID].xyz;
    gl_Position = params.clipFromVoxel * vec4(place, 1.0);
}
