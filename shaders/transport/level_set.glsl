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
const int kObjectSlots = OBJECTS > 0 ? OBJECTS : 1;

layout(std140, binding = kSceneBlock) uniform Scene { SceneParams scene; };
layout(binding = kDistancesUnit) uniform sampler3D distances; // spline coefficients [voxel], unfiltered
// Per voxel, filtered: how far off any boundary is at least [voxel]; of one object alone with its sign.
layout(binding = kClearanceUnit) uniform sampler3D clearance;
// Of several objects, per voxel, 16 bits: those that hold its centre; 16 bits: those whose boundary is
// within kNearby of it.
layout(binding = kNearbyUnit) uniform usampler3D nearby;

// What a filtered clearance may be too large by [voxel]: a smooth one is interpolated well; of several
// objects it has a crease at every boundary; far off it is a bound for its voxel's centre alone.
const float kRough = kObjects == 1 ? 0.25 : 0.9;
const float kFarRough = 0.9;

// Bits of the objects whose boundary is near.
uint closeTo(vec3 x) {
    return kObjects == 1 ? 1u : textureLod(nearby, (x + 0.5) * scene.voxel.xyz, 0.0).x >> 16u;
}

// How far off the nearest boundary is, but for kRough; of one object alone with its sign.
float clearanceAt(vec3 x) {
    return textureLod(clearance, (x + 0.5) * scene.voxel.xyz, 0.0).x;
}

// How far is surely free of boundaries where the clearance from this side is that.
float freeBy(float free) {
    return free - (free < kExactClearance ? kRough : kFarRough);
}

vec4 distanceAt(int k, vec3 x) { // gradient [1], distance [voxel]
    vec3 at = clamp(x - scene.objects[k].low.xyz, vec3(-0.999),
                    scene.objects[k].range.xyz + 0.999);
    vec3 cell = floor(at);
    vec3 texel = cell + vec3(1.5, 1.5, 1.5 + scene.objects[k].low.w);
    return splineAt(distances, texel, scene.texel.xyz, at - cell);
}

// The same, and how the gradient changes along d [1/voxel].
Curved curvedDistanceAt(int k, vec3 x, vec3 d) {
    vec3 at = clamp(x - scene.objects[k].low.xyz, vec3(-0.999),
                    scene.objects[k].range.xyz + 0.999);
    vec3 cell = floor(at);
    vec3 texel = cell + vec3(1.5, 1.5, 1.5 + scene.objects[k].low.w);
    return curvedSplineAt(distances, texel, scene.texel.xyz, at - cell, d);
}
