// Where voxels lie in textures that are interpolated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/limits.h"
#include "transport/params.glsl"

#ifndef PAGED
#error PAGED must be 0 (voxels lie in a box, padded by one) or 1 (in blocks)
#endif
#if PAGED
layout(binding = kVoxelBlocksUnit) uniform usampler3D voxelBlocks; // where each block lies

// Blocks share the samples on their faces, so that what a texture interpolates is within one.
vec3 texelAt(vec3 x) {
    vec3 size = 2.0 * transport.halfSize.xyz;
    vec3 p = clamp(x + 1.0, vec3(0.0), size + 1.0);
    ivec3 block = ivec3(min(p, size)) >> kVoxelBlockBits;
    uint place = texelFetch(voxelBlocks, block, 0).x;
    vec3 low = vec3(place & 1023u, (place >> 10u) & 1023u, place >> 20u) * float(kVoxelSamples);
    return low + (p - vec3(block << kVoxelBlockBits)) + 0.5;
}
#else
vec3 texelAt(vec3 x) {
    return x + 1.5;
}
#endif

vec3 coordinate(vec3 x) {
    return texelAt(x) * transport.scale.xyz;
}
