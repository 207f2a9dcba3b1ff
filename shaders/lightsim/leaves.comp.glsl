// The dense level array: for every 2×2×2 voxels the leaf that covers them (Sun et al. 2008, §4.2).
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Read from the coarsest level down: the first node whose range is within ε, or within ε' with a
// limited step (§5.3), is the leaf. Voxels in none are leaves by themselves, level 0. The extinction
// is held constant over a step too (003 leaves that out): a leaf's optical depth must be known to ε.
#include "shared/bindings.h"
#include "shared/lightsim_params.h"
#include "lib/octree.glsl"

layout(local_size_x = 64) in;
layout(std140, binding = kParamsBlock) uniform Params { OctreeParams params; };
layout(std430, binding = kPyramidBuffer) readonly buffer Pyramid { vec4 range[]; };
layout(std430, binding = kLevelsBuffer) readonly buffer Levels { ivec4 levels[]; }; // nodes x y z, first node
layout(r32ui, binding = kLeavesImage) writeonly uniform uimage3D leaves;

void main() {
    ivec3 pair = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(pair, params.nodes.xyz))) return;
    uint leaf = packLeaf(0u, 0.0);
    for (int level = params.size.w; level >= 1; --level) {
        ivec4 at = levels[level];
        ivec3 node = pair >> (level - 1);
        vec4 ends = range[at.w + (node.z * at.y + node.y) * at.x + node.x];
        float spread = ends.y - ends.x;
        if ((ends.w - ends.z) * float(1 << level) > params.limits.x) continue;
        if (spread < params.limits.x) {
            // 003 sets no limit here. But a kick grows with the step, and a spread below ε over a
            // large leaf may sit in two voxels of it: the limit falls from unlimited at spread 0
            // to that of ε' at spread ε.
            leaf = packLeaf(uint(level), params.limits.z * params.limits.x / max(spread, 1.0e-12));
            break;
        }
        if (spread < params.limits.y) {
            leaf = packLeaf(uint(level), params.limits.z);
            break;
        }
    }
    imageStore(leaves, pair, uvec4(leaf, 0u, 0u, 0u));
}
