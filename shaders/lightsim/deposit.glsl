// Light left along a straight piece of a path: every voxel it crosses gets its exact share.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sun et al. 2008, §4.4, with storage-buffer atomics in place of rasterised line segments: a piece may
// cross any number of voxels. The entry file says by kMedium, kDense, kColour and kOpaqueVoxels what there
// is to do. Within the loop there is no atomic add but a deposit's own: software devices serialise the
// lanes of every one of them, taken or not.
#include "lib/attenuation.glsl"
#include "lightsim/bricks.glsl"

// Fixed-point sums per voxel, in planes: the channels of fluence, then, where DIRECTION is 1,
// the net direction's x, y, z. Integer sums do not depend on the order of the adds. The host chooses
// the unit so that every photon of a batch may cross one voxel; a sum that still nears the end of its
// range, from photons that come back, is noticed in `overflowed`, and the batch is run again with a
// smaller unit. A direction's component d in [−1, 1] adds (1 + d)/2 of the deposit, so these sums stay
// below those of fluence and need no watch.
layout(r32ui, binding = kPlanesImage) uniform uimage3D sums;
#ifndef SPARSE
#error SPARSE must be 0 or 1
#endif
const bool kSparse = SPARSE == 1; // some bricks receive no light
layout(binding = kOpaqueUnit) uniform usampler3D opaque; // per voxel, not 0 inside opaque material

// What a photon carries beside its path.
struct Load {
    vec3 absorbed;  // weight that the path has taken
    vec3 scattered;
    float phase;    // of the rounding, in [0, 1)
    uint deposits;
    uint fullest;   // the largest sum met
    float chance;   // decides which way it goes at an interface, in (0, 1)
    float worth;    // what share of that number's digits is left
    uint id;        // its pixel of the photon map
#if BOUNCES == 1
    int bounces;
    vec3 outward;   // normal of the surface it has landed on; 0: of none
    vec3 albedo;    // of that
#endif
};

// Whether it leaves light where it goes: what comes straight from a light is another pass's.
bool isCounted(Load load) {
#if BOUNCES == 1
    return load.bounces > 0;
#else
    return true;
#endif
}

// Adds to the plane `plane` of a voxel.
uint add(ivec3 texel, int plane, float amount) {
    // By way of int, to which processors convert in one instruction.
    return imageAtomicAdd(sums, texel + ivec3(0, 0, plane * params.bricks.w), uint(int(amount)));
}

Attenuation dimmingOf(float depth) {
    return kDense ? attenuationOf(depth) : thinAttenuationOf(depth);
}

// Walks the voxels from x to x + along (Amanatides and Woo 1987), t [voxel] from 0 on, through a medium of
// these coefficients [1/voxel].
// Returns the share of the way before an opaque voxel, 1 where there is none.
float deposit(inout Path path, inout Load load, vec3 x, vec3 along, vec3 sigmaA, vec3 sigmaS) {
    ivec3 size = params.size.xyz;
    float unit = params.limits.z;
    float stepLength = sqrt(dot(along, along));
    vec3 slope = stepLength / max(abs(along), vec3(1.0e-12));
    vec3 turn = vec3(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0,
                     along.z < 0.0 ? -1.0 : 1.0);
    vec3 towards = 0.5 + 0.5 * along / max(stepLength, 1.0e-12);
    // Steps mostly start on a voxel's face: a nudge finds the voxel that lies ahead.
    vec3 cell = clamp(floor(x + 0.5 + 1.0e-4 * turn), vec3(0.0), vec3(size - 1));
    vec3 crossing = (0.5 + (cell - x) * turn) * slope;
    ivec3 voxel = ivec3(cell) + params.first.xyz;
    vec3 sigmaT = sigmaA + sigmaS;
    vec3 spent = vec3(0.0); // weight times length over the whole piece
    float t = 0.0;
    float ends = 1.0;
    bool walking = true;
    while (walking) {
        float leave = min(min(crossing.x, crossing.y), crossing.z);
        // Rounding must not leave a crumb of the step in a voxel beyond its end.
        walking = leave < 0.999999 * stepLength;
        leave = walking ? leave : stepLength;
        float pathLength = max(leave - t, 0.0);
        if (kOpaqueVoxels && texelFetch(opaque, voxel - params.first.xyz, 0).x != 0u) {
            ends = t / stepLength;
            break;
        }
        vec3 share = path.throughput * pathLength;
        if (kMedium && kColour) {
            Attenuation red = dimmingOf(sigmaT.x * pathLength);
            Attenuation green = dimmingOf(sigmaT.y * pathLength);
            Attenuation blue = dimmingOf(sigmaT.z * pathLength);
            share *= vec3(red.mean, green.mean, blue.mean);
            path.throughput *= vec3(red.through, green.through, blue.through);
            spent += share;
        } else if (kMedium) {
            Attenuation grey = dimmingOf(sigmaT.x * pathLength);
            share.x *= grey.mean;
            path.throughput.x *= grey.through;
            spent.x += share.x;
        }
        ivec3 texel = voxel;
        bool receives = kVolume && isCounted(load);
        if (kVolume && kSparse) {
            uint brick = brickOf(voxel, params.bricks.xy);
            receives = receives && brick != kNoBrick;
            texel = texelOf(brick, voxel, params.bricks.z);
        }
        if (receives) {
            // Rounded up as often as the fraction says: nothing is gained or lost on average.
            load.phase = fract(load.phase + 0.61803399);
            load.fullest = max(load.fullest, add(texel, 0, share.x * unit + load.phase));
            if (kColour) {
                load.fullest = max(load.fullest, add(texel, 1, share.y * unit + load.phase));
                load.fullest = max(load.fullest, add(texel, 2, share.z * unit + load.phase));
            }
            if (kDirection) {
                float power = unit * (kColour ? dot(share, params.colour.xyz) : share.x);
                add(texel, CHANNELS + 0, towards.x * power + load.phase);
                add(texel, CHANNELS + 1, towards.y * power + load.phase);
                add(texel, CHANNELS + 2, towards.z * power + load.phase);
            }
            ++load.deposits;
        }
        t = leave;
        // Through an edge or a corner all its axes move at once.
        bvec3 moves = lessThanEqual(crossing, vec3(leave));
        crossing.x += moves.x ? slope.x : 0.0;
        crossing.y += moves.y ? slope.y : 0.0;
        crossing.z += moves.z ? slope.z : 0.0;
        voxel += ivec3(vec3(moves) * turn);
    }
    load.absorbed += sigmaA * spent;
    load.scattered += sigmaS * spent;
    return ends;
}
