// Where voxels that receive light lie: by bricks, in atlases of sums.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/limits.h"

// A buffer, since software devices take longer to read a texel.
layout(std430, binding = kBricksBuffer) readonly buffer Bricks { uint bricks[]; };

// The table's entry of a voxel that is counted from the first brick's first on; `stride` of bricks along y, z.
uint brickOf(ivec3 voxel, ivec2 stride) {
    ivec3 at = voxel >> kBrickBits;
    return bricks[at.x + at.y * stride.x + at.z * stride.y];
}

// The first of a voxel's texels in an atlas where bricks are so far apart along z.
ivec3 texelOf(uint brick, ivec3 voxel, int apart) {
    ivec3 place = ivec3(brick & 1023u, (brick >> 10u) & 1023u, int(brick >> 20u) * apart);
    return (place << kBrickBits) + (voxel & (kBrickEdge - 1));
}
