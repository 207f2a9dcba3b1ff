// Objects' boundaries: the zeros of signed distances, and what is on each side of them.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solids are numbered so that the first of those which hold a point rules it. A ray carries one bit for
// each solid it is in; what it is in is a state that boundaries change, never looked up anew, so that
// rounding can neither lose a boundary nor make one be met twice.
#include "shared/surface_params.h"
#include "medium/sample.glsl"
#include "medium/spline.glsl"

#ifndef SOLIDS
#error SOLIDS must be 1 to 12
#endif
const int kSolids = SOLIDS;

layout(std140, binding = 4) uniform Surfaces { SurfaceParams surfaces; };
layout(binding = 9) uniform sampler3D distances; // spline coefficients [voxel], unfiltered
// Per voxel, filtered: how far off any boundary is at least [voxel]; of one solid alone with its sign.
layout(binding = 10) uniform sampler3D clearance;
// Of several solids, per voxel, 16 bits: those that hold its centre; 16 bits: those whose boundary is
// within 3.5 voxels of it.
layout(binding = 11) uniform usampler3D nearby;

// What a filtered clearance may be too large by [voxel]: a smooth one is interpolated well; of several
// solids it has a crease at every boundary; far off it is a bound for its voxel's centre alone.
const float kRough = SOLIDS == 1 ? 0.25 : 0.9;
const float kFar = 4.0;        // where clearances begin to be bounds alone [voxel]
const float kFarRough = 0.9;

// Bits of the solids whose boundary is near.
uint closeTo(vec3 x) {
    if (kSolids == 1) return 1u;
    return textureLod(nearby, (x + 0.5) * surfaces.voxel.xyz, 0.0).x >> 16u;
}

// How far off the nearest boundary is, but for kRough; of one solid with its sign.
float clearanceAt(vec3 x) {
    return textureLod(clearance, (x + 0.5) * surfaces.voxel.xyz, 0.0).x;
}

// How far a leap may go where the clearance from this side is that.
float leapBy(float free) {
    return free - (free < kFar ? kRough : kFarRough);
}

vec4 distanceAt(int k, vec3 x) { // gradient [1], distance [voxel]
    vec3 at = clamp(x - surfaces.solids[k].low.xyz, vec3(-0.999),
                    surfaces.solids[k].range.xyz + 0.999);
    vec3 cell = floor(at);
    vec3 texel = cell + vec3(1.5, 1.5, 1.5 + surfaces.solids[k].low.w);
    return splineAt(distances, texel, surfaces.texel.xyz, at - cell);
}

// The same, and how the gradient changes along d [1/voxel].
Curved curvedDistanceAt(int k, vec3 x, vec3 d) {
    vec3 at = clamp(x - surfaces.solids[k].low.xyz, vec3(-0.999),
                    surfaces.solids[k].range.xyz + 0.999);
    vec3 cell = floor(at);
    vec3 texel = cell + vec3(1.5, 1.5, 1.5 + surfaces.solids[k].low.w);
    return curvedSplineAt(distances, texel, surfaces.texel.xyz, at - cell, d);
}

// The solids that hold x.
uint insideAt(vec3 x) {
    vec3 at = (x + 0.5) * surfaces.voxel.xyz;
    uint inside = kSolids == 1 ? 0u : textureLod(nearby, at, 0.0).x & 0xFFFFu;
    uint close = closeTo(x);
    for (int k = 0; k < kSolids; ++k)
        if (((close >> k) & 1u) == 1u) {
            float free = kSolids == 1 ? clearanceAt(x) : 0.0;
            if (abs(free) < 2.0 * kRough) free = distanceAt(k, x).w;
            inside &= ~(1u << k);
            inside |= (free < 0.0 ? 1u : 0u) << k;
        }
    return inside;
}

// The region that rules where these solids are.
int regionOf(uint inside) {
    return findLSB(inside | (1u << kSolids));
}

// The index of a region at x.
float indexOf(int region, vec3 x) {
    return kField > 0 && surfaces.regions[region].index.y == 1.0 ? indexAt(x)
                                                                 : surfaces.regions[region].index.x;
}

// +1 outside the solid, −1 inside: turns its distance into that from this side.
float sideOf(uint inside, int k) {
    return ((inside >> k) & 1u) == 1u ? -1.0 : 1.0;
}
