// Objects' boundaries: signed distances, and how far off the nearest one is.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/limits.h"
#include "shared/scene_params.h"
#include "transport/object_set.glsl"
#include "transport/spline.glsl"

#ifndef PACKED
#error PACKED must be 0 or 1
#endif
const bool kPacked = PACKED == 1; // distances take 3/8 of the memory, and twice the look-ups

layout(std140, binding = kSceneBlock) uniform Scene { SceneParams scene; };
layout(binding = kDistancesUnit) uniform sampler3D distances; // spline coefficients [voxel], unfiltered
// Where each object's blocks of cells are in it: tables one behind the other along z; of many a list.
layout(binding = kBlocksUnit) uniform usampler3D blocks;
layout(binding = kClearanceUnit) uniform sampler3D clearance;
// Of several objects, per cube, 16 bits: those that hold its centre; 16 bits: those whose boundary is
// within kNearby of a voxel of it. Of many the place of both sets in a list, the latter first.
layout(binding = kNearbyUnit) uniform usampler3D nearby;
layout(binding = kSetsUnit) uniform usampler3D sets;

// What a filtered clearance may be too large by [cube's edge]: a smooth one is interpolated well; far off it is a
// bound for its cube's centre alone. Of several objects it has no sign, and a crease at every boundary: where it is
// below kCreased one may be within the cubes that it is filtered from.
const float kRough = 0.25;
const float kCreased = kObjects > 1 ? 0.75 : 0.0;
const float kFarRough = 0.9;

// Where an entry of a list lies in its texture.
ivec3 placeInRows(uint entry) {
    const uint row = (1u << kRowBits) - 1u;
    return ivec3(entry & row, entry >> kRowBits & row, entry >> 2 * kRowBits);
}

uint nearbyAt(vec3 x) {
    return textureLod(nearby, (x + 0.5) * scene.clearance.xyz, 0.0).x;
}

// The objects whose boundary is near.
ObjectSet closeTo(vec3 x) {
#if NEAR > 0
    return texelFetch(sets, placeInRows(nearbyAt(x)), 0).xy;
#else
    return kObjects == 1 ? 1u : nearbyAt(x) >> 16u;
#endif
}

// The objects that hold the centre of x's cube; none of one object alone.
ObjectSet holding(vec3 x) {
#if NEAR > 0
    return texelFetch(sets, placeInRows(nearbyAt(x)), 0).zw;
#else
    return kObjects == 1 ? 0u : nearbyAt(x) & 0xFFFFu;
#endif
}

// How far off the nearest boundary is, but for kRough; of one object alone with its sign.
float clearanceAt(vec3 x) {
    return textureLod(clearance, (x + 0.5) * scene.clearance.xyz, 0.0).x;
}

// Clearances up to this are exact [voxel].
float exactClearance() {
    return kExactClearance * scene.clearance.w;
}

// How far is surely free of boundaries where the clearance from this side is that.
float freeBy(float free) {
    float edge = scene.clearance.w;
    bool even = free < exactClearance() && free >= kCreased * edge;
    return free - (even ? kRough : kFarRough) * edge;
}

// Shorter ways are not worth a leap [voxel].
float leastLeap() {
    return kRough * scene.clearance.w;
}

// Where the spline of a cell is looked up.
struct Cell {
    Rows rows;
    vec3 texel; // centre of its first one
    vec3 at;    // within it, 0 to 1
    float far;  // no boundary is near: what stands for the distance [voxel]; else 0
};

// Where the block of an object's cells is in the atlas, or kFarBlock and its like.
uint placeOf(int k, ivec3 block) {
    if (!kMany) return texelFetch(blocks, block + ivec3(0, 0, k * int(scene.reach.w)), 0).x;
    BlockBox box = scene.boxes[k];
    ivec3 at = block - box.low.xyz;
    bool within = all(greaterThanEqual(at, ivec3(0))) && all(lessThan(at, box.size.xyz));
    int entry = within ? box.low.w + (at.z * box.size.y + at.y) * box.size.x + at.x : 0;
    uint place = texelFetch(blocks, placeInRows(uint(entry)), 0).x;
    return within ? place : kFarBlock;
}

Cell cellAt(int k, vec3 x) {
    x = clamp(x, vec3(-0.999), scene.reach.xyz);
    vec3 cell = floor(x);
    ivec3 corner = ivec3(cell) + 1;
    uint place = placeOf(k, corner >> kBlockBits);
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
