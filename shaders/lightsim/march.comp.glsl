// Photons through the volume: adaptive curved steps, every crossed voxel gets its exact share.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sun et al. 2008, §4.4, with storage-buffer atomics in place of rasterised line segments: a step
// may cross any number of voxels. A work item carries one photon for some steps; survivors go on
// the next list. Within the loops there is no atomic add but a deposit's own: software devices
// serialise the lanes of every one of them, taken or not.
#include "shared/lightsim_params.h"
#include "lib/attenuation.glsl"
#include "lib/octree.glsl"
#include "lib/ray.glsl"
#include "lightsim/fates.glsl"

#if !defined(PATH) || !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || \
    !defined(OPAQUE)
#error PATH must be 0 to 5, DIRECTION, OPAQUE 0 or 1, MEDIUM 0 to 2, CHANNELS 1 or 3
#endif
const int kStraight = 0, kEuler = 1, kVerlet = 2, kSharma = 3, kRk4 = 4, kAdaptive = 5;
const int kPath = PATH;                 // straight where the index does not vary
const bool kMedium = MEDIUM > 0;        // something absorbs or scatters
const bool kDense = MEDIUM == 2;        // a voxel may have an optical depth above 0.25
const bool kColour = CHANNELS == 3;     // it does so by wavelength
const bool kOpaque = OPAQUE == 1;       // opaque voxels stop photons

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { PhotonParams params; };
layout(std430, binding = 0) buffer Count { uint nextCount; uint overflowed; };
layout(std430, binding = 1) buffer Photons { Photon photons[]; };
layout(std430, binding = 2) readonly buffer List { uint list[]; };
layout(std430, binding = 3) writeonly buffer NextList { uint nextList[]; };
// Fixed-point sums per voxel, one buffer a plane: the channels of fluence, then, where DIRECTION is 1,
// the net direction's x, y, z. Integer sums do not depend on the order of the adds. The host chooses the unit so that every
// photon of a batch may cross one voxel; a sum that still nears the end of its range, from photons
// that come back, is noticed in `overflowed`, and the batch is run again with a smaller unit. A
// direction's component d in [−1, 1] adds (1 + d)/2 of the deposit, so these sums stay below those
// of fluence and need no watch.
layout(std430, binding = 4) buffer Plane { uint sums[]; } planes[CHANNELS + 3 * DIRECTION];
layout(binding = 2) uniform usampler3D leaves;    // per 2×2×2 voxels
layout(binding = 3) uniform sampler3D absorption; // padded by one; grey: (σ_a, σ_s) [1/voxel]
layout(binding = 4) uniform sampler3D scattering; // colour only
layout(binding = 5) uniform usampler3D opaque;    // per voxel, not 0 inside opaque material
#include "medium/sample.glsl"

const uint kNearFull = 0xE0000000u;

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
}

Attenuation dimmingOf(float depth) {
    return kDense ? attenuationOf(depth) : thinAttenuationOf(depth);
}

// A step of several look-ups, of at most τ; the adaptive one is made again, shorter, until its error is
// what it may be. `longest` is what the next one may be.
struct Leap {
    Advance step;
    float tau;
    float longest;
    float off; // estimated error of where the photon leaves [voxel]
};

Leap leapOf(Ray ray, vec4 first, float tau, float longest) {
    Leap leap;
    leap.tau = tau;
    leap.longest = longest;
    leap.off = 0.0;
    if (kPath == kAdaptive) {
        bool good = false;
        for (int tries = 0; tries < 12 && !good; ++tries) {
            leap.step = embeddedStep(ray, first, leap.tau);
            leap.off = leap.step.offX + leap.step.offW * params.tracing.z / leap.step.last.w;
            // Below one rounding of w no step gets any better.
            float allowed = max(params.tracing.y * leap.tau * leap.step.last.w, 6.0e-8 * params.tracing.z);
            float change = 0.9 * sqrt(sqrt(allowed / max(leap.off, 1.0e-30)));
            leap.longest = leap.tau * clamp(change, 0.2, 4.0);
            good = leap.off <= allowed;
            if (!good) leap.tau = leap.longest;
        }
    } else if (kPath == kRk4) {
        leap.step = rk4Step(ray, tau);
    } else {
        leap.step = sharmaStep(ray, tau);
    }
    return leap;
}

void main() {
    if (gl_GlobalInvocationID.x >= params.list.x) return;
    uint id = list[gl_GlobalInvocationID.x];
    Photon photon = photons[id];
    vec3 x = photon.place.xyz;
    vec3 w = photon.wave.xyz;
    vec3 weight = vec3(photon.place.w, photon.wave.w, photon.absorbed.w);
    vec3 absorbed = photon.absorbed.xyz;
    vec3 scattered = photon.scattered.xyz;
    float phase = photon.scattered.w;
    uint steps = photon.count.y;
    uint deposits = photon.count.z;
    uint fate = kAlive;
    uint last = steps + params.list.y;
    uint fullest = 0u;

    ivec3 size = params.size.xyz;
    ivec3 stride = ivec3(1, size.x, size.x * size.y);
    vec3 centre = 0.5 * vec3(size) - 0.5;
    vec3 halfSize = 0.5 * vec3(size);
    float unit = params.limits.z;
    vec4 sampled = fieldAt(x);
    float longest = 1.0e6; // adaptive: dτ [voxel]
    float error = uintBitsToFloat(photon.count.w);

    while (steps < last && fate == kAlive) {
        // How far: to the leaf's face, within its limits, and never beyond the domain.
        vec3 direction = w / sampled.w;
        vec3 signs = vec3(direction.x < 0.0 ? -1.0 : 1.0, direction.y < 0.0 ? -1.0 : 1.0,
                          direction.z < 0.0 ? -1.0 : 1.0);
        vec3 inverses = 1.0 / max(abs(direction), vec3(1.0e-12));
        vec3 reach = (halfSize - (x - centre) * signs) * inverses;
        float toFace = max(min(reach.x, min(reach.y, reach.z)), 0.0);
        uint leaf = texelFetch(leaves, clamp(ivec3(x + 0.5 + 1.0e-4 * signs), ivec3(0), size - 1) >> 1,
                               0).x;
        uint level = leafLevel(leaf);
        float ds = min(distanceToLeafFace(x, signs, inverses, level), leafLimit(leaf));
        ds = min(min(max(ds, params.limits.x), params.tracing.x), toFace);
        float tau = ds / sampled.w;
        vec3 middle = kPath == kVerlet ? halfKick(w, sampled, tau) : w;
        vec3 next = x + tau * middle;
        Leap leap;
        if (kPath > kVerlet) {
            leap = leapOf(Ray(x, w), sampled, min(tau, longest), longest);
            longest = leap.longest;
            error += leap.off;
            next = leap.step.ray.x;
        }
        next = clamp(next, centre - halfSize, centre + halfSize);

        // Walk the voxels between (Amanatides and Woo 1987), t from 0 to 1 along the step.
        vec3 along = next - x;
        float stepLength = sqrt(dot(along, along));
        vec3 slope = 1.0 / max(abs(along), vec3(1.0e-12));
        vec3 turn = vec3(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0,
                         along.z < 0.0 ? -1.0 : 1.0);
        vec3 towards = 0.5 + 0.5 * along / max(stepLength, 1.0e-12);
        // Steps mostly start on a voxel's face: a nudge finds the voxel that lies ahead.
        vec3 cell = clamp(floor(x + 0.5 + 1.0e-4 * turn), vec3(0.0), vec3(size - 1));
        vec3 crossing = (0.5 + (cell - x) * turn) * slope;
        ivec3 jump = ivec3(turn) * stride;
        int voxel = int(cell.x) + int(cell.y) * stride.y + int(cell.z) * stride.z;
        vec3 sigmaA = vec3(0.0);
        vec3 sigmaS = vec3(0.0);
        if (kMedium) {
            vec3 at = coordinate(x + 0.5 * along);
            vec4 a = textureLod(absorption, at, 0.0);
            sigmaA = kColour ? a.xyz : vec3(a.x);
            sigmaS = kColour ? textureLod(scattering, at, 0.0).xyz : vec3(a.y);
        }
        vec3 sigmaT = sigmaA + sigmaS;
        vec3 spent = vec3(0.0); // weight times length over the whole step
        float t = 0.0;
        bool walking = true;
        while (walking) {
            float leave = min(min(crossing.x, crossing.y), crossing.z);
            // Rounding must not leave a crumb of the step in a voxel beyond its end.
            walking = leave < 0.999999;
            leave = walking ? leave : 1.0;
            float pathLength = max(leave - t, 0.0) * stepLength;
            if (kOpaque && texelFetch(opaque, ivec3(cell), 0).x != 0u) {
                fate = kStopped;
                next = x + t * along;
                break;
            }
            vec3 share = weight * pathLength;
            if (kMedium && kColour) {
                Attenuation red = dimmingOf(sigmaT.x * pathLength);
                Attenuation green = dimmingOf(sigmaT.y * pathLength);
                Attenuation blue = dimmingOf(sigmaT.z * pathLength);
                share *= vec3(red.mean, green.mean, blue.mean);
                weight *= vec3(red.through, green.through, blue.through);
                spent += share;
            } else if (kMedium) {
                Attenuation grey = dimmingOf(sigmaT.x * pathLength);
                share.x *= grey.mean;
                weight.x *= grey.through;
                spent.x += share.x;
            }
            // Rounded up as often as the fraction says: nothing is gained or lost on average. By way
            // of int, to which processors convert in one instruction.
            phase = fract(phase + 0.61803399);
            uint amount = uint(int(share.x * unit + phase));
            fullest = max(fullest, atomicAdd(planes[0].sums[voxel], amount));
#if CHANNELS == 3
            fullest = max(fullest, atomicAdd(planes[1].sums[voxel], uint(int(share.y * unit + phase))));
            fullest = max(fullest, atomicAdd(planes[2].sums[voxel], uint(int(share.z * unit + phase))));
#endif
#if DIRECTION
            float power = unit * (kColour ? dot(share, params.colour.xyz) : share.x);
            atomicAdd(planes[CHANNELS + 0].sums[voxel], uint(int(towards.x * power + phase)));
            atomicAdd(planes[CHANNELS + 1].sums[voxel], uint(int(towards.y * power + phase)));
            atomicAdd(planes[CHANNELS + 2].sums[voxel], uint(int(towards.z * power + phase)));
#endif
            ++deposits;
            t = leave;
            // Through an edge or a corner all its axes move at once.
            bvec3 moves = lessThanEqual(crossing, vec3(leave));
            crossing.x += moves.x ? slope.x : 0.0;
            crossing.y += moves.y ? slope.y : 0.0;
            crossing.z += moves.z ? slope.z : 0.0;
            voxel += (moves.x ? jump.x : 0) + (moves.y ? jump.y : 0) + (moves.z ? jump.z : 0);
            if (kOpaque) cell += vec3(moves) * turn;
        }
        absorbed += sigmaA * spent;
        scattered += sigmaS * spent;
        ++steps;
        x = next;
        if (kPath == kEuler) w = eulerStep(Ray(x, w), sampled, ds).w;
        if (kPath == kAdaptive) sampled = leap.step.last;
        else if (kPath > kStraight) sampled = fieldAt(x);
        if (kPath == kVerlet) w = halfKick(middle, sampled, tau);
        if (kPath > kVerlet) w = leap.step.ray.w;
        // Linear look-ups are the gradient of no potential, so |w| would drift from n over many turns.
        // A share a step keeps it there, and takes little of n's own wavering within a voxel into w.
        if (kField == 1 && kPath > kEuler) w *= mix(1.0, sampled.w * inversesqrt(dot(w, w)), 0.1);

        // Left the domain: on its face, on the way out.
        bool outside = any(greaterThanEqual((x - centre) * sign(w), halfSize - 1.0e-4));
        float brightest = kColour ? max(weight.x, max(weight.y, weight.z)) : weight.x;
        if (fate == kAlive)
            fate = outside                            ? kEscaped
                   : brightest < params.limits.y     ? kFaded
                   : steps >= params.list.z          ? kTrapped
                                                     : kAlive;
    }
    if (kOpaque && fate == kStopped) {
        absorbed += weight; // opaque material takes what arrives
        weight = vec3(0.0);
    }
    photon.place = vec4(x, weight.x);
    photon.wave = vec4(w, weight.y);
    photon.absorbed = vec4(absorbed, weight.z);
    photon.scattered = vec4(scattered, phase);
    photon.count = uvec4(fate, steps, deposits, floatBitsToUint(error));
    photons[id] = photon;
    if (fate == kAlive) nextList[atomicAdd(nextCount, 1u)] = id;
    if (fullest >= kNearFull) atomicOr(overflowed, 1u);
}
