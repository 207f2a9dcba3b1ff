// Objects' boundaries: signed distances, and how far off the nearest one is.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/limits.h"
#include "shared/scene_params.h"
#include "transport/spline.glsl"

#ifndef OBJECTS
#error OBJECTS must be 0 (blurred boundaries) to 12
#endif
const int kObjects = OBJECTS;
#ifndef PACKED
#error PACKED must be 0 or 1
#endif
const bool kPacked = PACKED == 1; // distances take 3/8 of the memory, and twice the look-ups
const int kObjectSlots = OBJECTS > 0 ? OBJECTS : 1;

layout(std140, binding = kSceneBlock) uniform Scene { SceneParams scene; };
layout(binding = kDistancesUnit) uniform sampler3D distances; // spline coefficients [voxel], unfiltered
layout(binding = kBlocksUnit) uniform usampler3D blocks; // where each object's blocks of cells are in it
layout(binding = kClearanceUnit) uniform sampler3D clearance;
// Of several objects, per cube, 16 bits: those that hold its centre; 16 bits: those whose boundary is
// within kNearby of a voxel of it.
layout(binding = kNearbyUnit) uniform usampler3D nearby;

// What a filtered clearance may be too large by [cube's edge]: a smooth one is interpolated well; of
// several objects it has a crease at every boundary; far off it is a bound for its cube's centre alone.
const float kRough = kObjects == 1 ? 0.25 : 0.9;
const float kFarRough = 0.9;

// The same [voxel].
float roughness() {
    return kRough * scene.clearance.w;
}

// Bits of the objects whose boundary is near.
uint closeTo(vec3 x) {
    return kObjects == 1 ? 1u : textureLod(nearby, (x + 0.5) * scene.clearance.xyz, 0.0).x >> 16u;
}

// How far off the nearest boundary is, but for roughness(); of one object alone with its sign.
float clearanceAt(vec3 x) {
    return textureLod(clearance, (x + 0.5) * scene.clearance.xyz, 0.0).x;
}

// Clearances up to this are exact [voxel].
float exactClearance() {
    return kExactClearance * scene.clearance.w;
}

// How far is surely free of boundaries where the clearance from this side is that.
float freeBy(float free) {
    return free - (free < exactClearance() ? kRough : kFarRough) * scene.clearance.w;
}

// Where the spline of a cell is looked up.
struct Cell {
    Rows rows;
    vec3 texel; // centre of its first one
    vec3 at;    // within it, 0 to 1
    float far;  // no boundary is near: what stands for the distance [voxel]; else 0
};

Cell cellAt(int k, vec3 x) {
    x = clamp(x, vec3(-0.999), scene.reach.xyz);
    vec3 cell = floor(x);
    ivec3 corner = ivec3(cell) + 1;
    ivec3 block = corner >> kBlockBits;
    uint place = texelFetch(blocks, block + ivec3(0, 0, k * int(scene.reach.w)), 0).x;
    ivec3 first = ivec3(place & 1023u, place >> 10 & 1023u, place >> 20 & 1023u);
    ivec3 within = corner & kBlockCells - 1;
    ivec3 texel = first * ivec3(kPacked ? kPackedTexels : kBlockCells, kBlockRows, kBlockRows) +
                  ivec3(kPacked ? within.x >> 2 : within.x, within.yz);
    return Cell(Rows(kPacked, within.x & 3), vec3(texel) + 0.5, x - cell,
                place < kFarBlock ? 0.0 : place == kFarBlock ? kNearby : -kNearby);
}

// What no boundary is near to only rounding and steep distances lead to; all of it is computed in any case,
// since software devices walk both sides of a branch.
vec4 distanceAt(int k, vec3 x) { // gradient [1], distance [voxel]
    Cell cell = cellAt(k, x);
    vec4 sum = splineAt(distances, cell.rows, cell.texel, scene.texel.xyz, cell.at);
    return cell.far == 0.0 ? sum : vec4(0.0, 0.0, 0.0, cell.far);
}

// The same, and how the gradient changes along d [1/voxel].
Curved curvedDistanceAt(int k, vec3 x, vec3 d) {
    Cell cell = cellAt(k, x);
    Curved curved = curvedSplineAt(distances, cell.rows, cell.texel, scene.texel.xyz, cell.at, d);
    if (cell.far != 0.0) curved.sum = vec4(0.0, 0.0, 0.0, cell.far);
    return curved;
}
