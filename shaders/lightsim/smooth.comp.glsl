// One axis of the 3×3×3 smoothing of the light (Sun et al. 2008, §4.4): weights 1 2 1, edges clamp.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/lightsim_params.h"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { ResolveParams params; };
layout(std430, binding = kSourceBuffer) readonly buffer Source { float source[]; };
layout(std430, binding = kTargetBuffer) writeonly buffer Target { float target[]; };

void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(p, params.size.xyz))) return;
    int axis = params.planes.z;
    int stride = axis == 0 ? 1 : axis == 1 ? params.size.x : params.size.x * params.size.y;
    int at = (p.z * params.size.y + p.y) * params.size.x + p.x;
    int before = p[axis] > 0 ? at - stride : at;
    int after = p[axis] < params.size[axis] - 1 ? at + stride : at;
    target[at] = 0.25 * (source[before] + 2.0 * source[at] + source[after]);
}
