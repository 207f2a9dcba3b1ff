// How far a photon may step: as its leaf of the octree lets it (Sun et al. 2008, §4.4).
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a PhotonParams, is declared.
#include "lib/box.glsl"
#include "lib/octree.glsl"

layout(binding = kLeavesUnit) uniform usampler3D leaves; // per 2×2×2 voxels

// From x along a direction of length 1 [voxel].
float leafLimitFrom(vec3 x, vec3 direction) {
    ivec3 size = params.size.xyz;
    vec3 signs = signsOf(direction);
    uint leaf = texelFetch(leaves, clamp(ivec3(x + 0.5 + 1.0e-4 * signs), ivec3(0), size - 1) >> 1, 0).x;
    float face = distanceToLeafFace(x, signs, inversesOf(direction), leafLevel(leaf));
    return min(max(min(face, leafLimit(leaf)), params.limits.x), transport.steps.w);
}
