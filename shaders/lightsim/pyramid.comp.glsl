// One level of the min–max pyramid of index and extinction (Sun et al. 2008, §4.2).
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Level k has nodes of 2^k voxels. Source 0: level 1 from the voxels. Source 1: level 1 again, each
// node widened by its 26 neighbours, since the field within a node depends on samples up to three voxels
// beyond its faces, on the third by little: two are looked at, since three would take a third more steps
// for a quarter less error. Source 2: level k from k − 1. One program serves all, and its loops run to a
// count that the compiler does not know: it is compiled on every run.
#include "shared/bindings.h"
#include "shared/lightsim_params.h"

#if !defined(INDEX) || !defined(EXTINCTION)
#error INDEX and EXTINCTION must be 0 or 1
#endif
const bool kIndex = INDEX == 1;           // the index varies
const bool kExtinction = EXTINCTION == 1; // the extinction varies

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { OctreeParams params; };
layout(std430, binding = kIndexBuffer) readonly buffer Index { float index[]; };
layout(std430, binding = kPyramidBuffer) buffer Pyramid { vec4 range[]; }; // n: least, most; σ_t: least, most
layout(std430, binding = kExtinctionBuffer) readonly buffer Extinction { float extinction[]; };

vec4 joined(vec4 a, vec4 b) {
    return vec4(min(a.x, b.x), max(a.y, b.y), min(a.z, b.z), max(a.w, b.w));
}

vec4 sourceAt(ivec3 p) {
    if (params.target.y == 0) {
        // Beyond the volume the nearest voxel answers: it adds nothing to the range.
        ivec3 v = min(p, params.size.xyz - 1);
        int at = (v.z * params.size.y + v.y) * params.size.x + v.x;
        float n = kIndex ? index[at] : 0.0;
        float sigma = kExtinction ? extinction[at] : 0.0;
        return vec4(n, n, sigma, sigma);
    }
    ivec3 s = clamp(p, ivec3(0), params.source.xyz - 1);
    return range[params.source.w + (s.z * params.source.y + s.y) * params.source.x + s.x];
}

void main() {
    ivec3 node = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(node, params.nodes.xyz))) return;
    bool widens = params.target.y == 1;
    ivec3 first = widens ? node - 1 : 2 * node;
    int edge = params.target.z;
    vec4 result = sourceAt(widens ? node : first);
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) result = joined(result, sourceAt(first + ivec3(x, y, z)));
    range[params.target.x + (node.z * params.nodes.y + node.y) * params.nodes.x + node.x] = result;
}
