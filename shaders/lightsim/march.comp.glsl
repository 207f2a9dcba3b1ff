// Photons through the volume: adaptive curved steps, every crossed voxel gets its exact share.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sun et al. 2008, §4.4, with storage-buffer atomics in place of rasterised line segments: a step
// may cross any number of voxels. A work item carries one photon for some steps; survivors go to
// the next list.
#include "shared/lightsim_params.h"
#include "lib/attenuation.glsl"
#include "lib/box.glsl"
#include "lib/octree.glsl"
#include "lib/ray.glsl"
#include "lightsim/ledger.glsl"

#if !defined(BEND) || !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || \
    !defined(OPAQUE)
#error BEND, MEDIUM, DIRECTION, OPAQUE must be 0 or 1, CHANNELS 1 or 3
#endif
const bool kBend = BEND == 1;           // the index varies
const bool kMedium = MEDIUM == 1;       // something absorbs or scatters
const bool kColour = CHANNELS == 3;     // it does so by wavelength
const bool kDirection = DIRECTION == 1; // the net direction is wanted
const bool kOpaque = OPAQUE == 1;       // opaque voxels stop photons

layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Params { PhotonParams params; };
layout(std430, binding = 1) readonly buffer Photons { Photon photons[]; };
layout(std430, binding = 2) writeonly buffer NextPhotons { Photon nextPhotons[]; };
// Fixed-point sums, one buffer a plane: low words of all voxels, then high words. Planes are the
// channels of fluence, then (kDirection) x, y, z of the weighted direction. The unit is
// 2^-kFractionBits of one voxel's length of the brightest photon. One deposit is at most √3 voxels
// × 2^22 < 2^23; a photon deposits at most once in a voxel per step, of at most 2^16 steps; a
// launch has at most 2^24 photons between resolves: sums stay below 2^63.
layout(std430, binding = 3) buffer Plane { uint words[]; } planes[CHANNELS + 3 * DIRECTION];
layout(binding = 1) uniform sampler3D field;      // (½∇n², n), padded by one voxel
layout(binding = 2) uniform usampler3D leaves;    // per 2×2×2 voxels
layout(binding = 3) uniform sampler3D absorption; // per voxel; grey: (σ_a, σ_s) [1/voxel]
layout(binding = 4) uniform sampler3D scattering; // per voxel; colour only
layout(binding = 5) uniform usampler3D opaque;    // per voxel, not 0 inside opaque material

vec4 fieldAt(vec3 x) {
    return kBend ? textureLod(field, (x + 1.5) / vec3(params.size.xyz + 2), 0.0)
                 : vec4(0.0, 0.0, 0.0, params.index.x);
}

#define ADD(PLANE, AMOUNT)                                                                         \
    {                                                                                              \
        uint before = atomicAdd(planes[PLANE].words[voxel], AMOUNT);                               \
        if (before > 0xFFFFFFFFu - (AMOUNT)) atomicAdd(planes[PLANE].words[voxels + voxel], 1u);   \
    }

// Two's complement over both words: a negative low word almost always carries, and then the high
// word stays as it is.
#define ADD_SIGNED(PLANE, AMOUNT)                                                                  \
    {                                                                                              \
        uint amount = uint(int(AMOUNT));                                                           \
        uint before = atomicAdd(planes[PLANE].words[voxel], amount);                               \
        int high = (int(AMOUNT) < 0 ? -1 : 0) + (before > 0xFFFFFFFFu - amount ? 1 : 0);           \
        if (high != 0) atomicAdd(planes[PLANE].words[voxels + voxel], uint(high));                 \
    }

void main() {
    if (gl_GlobalInvocationID.x >= params.list.x) return;
    Photon photon = photons[gl_GlobalInvocationID.x];
    vec3 x = photon.place.xyz;
    vec3 w = photon.wave.xyz;
    vec3 weight = vec3(photon.place.w, photon.wave.w, photon.state.x);
    uint steps = uint(photon.state.y);

    ivec3 size = params.size.xyz;
    uint voxels = uint(params.size.w);
    ivec3 stride = ivec3(1, size.x, size.x * size.y);
    vec3 low = vec3(-0.5);
    vec3 high = vec3(size) - 0.5;
    float dropBelow = params.limits.y;

    vec4 sampled = fieldAt(x);
    vec3 absorbed = vec3(0.0);
    vec3 scattered = vec3(0.0);
    uint deposits = 0u;
    bool alive = true;
    bool stopped = false;

    for (uint i = 0u; i < params.list.y && alive; ++i) {
        // How far: to the leaf's face, within its limits, and never beyond the domain.
        vec3 direction = w * inversesqrt(dot(w, w));
        float toFace = timeToLeave(x, direction, low, high);
        float ds = toFace;
        if (kBend) {
            ivec3 pair = clamp(ivec3(x + 0.5), ivec3(0), size - 1) >> 1;
            uint leaf = texelFetch(leaves, pair, 0).x;
            float wanted = min(distanceToLeafFace(x + 0.5, direction, leafLevel(leaf)),
                               leafLevel(leaf) == 0u ? 0.0 : leafLimit(leaf));
            ds = min(max(wanted, params.limits.x), toFace);
        }
        float tau = ds / sampled.w;
        vec3 middle = kBend ? halfKick(w, sampled, tau) : w;
        vec3 next = clamp(x + tau * middle, low, high);

        // Walk the voxels between (Amanatides and Woo 1987), t from 0 to 1 along the step.
        vec3 along = next - x;
        float stepLength = length(along);
        vec3 unit = along * (1.0 / max(stepLength, 1.0e-20));
        vec3 slope = 1.0 / max(abs(along), vec3(1.0e-20));
        ivec3 cell = clamp(ivec3(floor(x + 0.5)), ivec3(0), size - 1);
        vec3 isForward = vec3(greaterThan(along, vec3(0.0)));
        vec3 crossing = (vec3(cell) - 0.5 + isForward - x) * (2.0 * isForward - 1.0) * slope;
        ivec3 turn = ivec3(2.0 * isForward - 1.0);
        int voxel = cell.x + cell.y * stride.y + cell.z * stride.z;
        ivec3 jump = turn * stride;
        float t = 0.0;
        bool walking = stepLength > 0.0;
        while (walking) {
            float leave = min(min(crossing.x, crossing.y), min(crossing.z, 1.0));
            float pathLength = max(leave - t, 0.0) * stepLength;
            if (kOpaque && texelFetch(opaque, cell, 0).x != 0u) {
                stopped = true;
                next = x + t * along;
                break;
            }
            vec3 share = weight * pathLength;
            if (kMedium) {
                vec4 a = texelFetch(absorption, cell, 0);
                if (kColour) {
                    vec3 s = texelFetch(scattering, cell, 0).xyz;
                    vec3 depth = (a.xyz + s) * pathLength;
                    vec3 e = vec3(transmittanceOf(depth.x), transmittanceOf(depth.y),
                                  transmittanceOf(depth.z));
                    share *= vec3(meanTransmittance(depth.x, e.x), meanTransmittance(depth.y, e.y),
                                  meanTransmittance(depth.z, e.z));
                    absorbed += a.xyz * share;
                    scattered += s * share;
                    weight *= e;
                } else {
                    float depth = (a.x + a.y) * pathLength;
                    float e = transmittanceOf(depth);
                    share.x *= meanTransmittance(depth, e);
                    absorbed.x += a.x * share.x;
                    scattered.x += a.y * share.x;
                    weight.x *= e;
                }
            }
            ADD(0, uint(share.x * kFixedOne + 0.5))
#if CHANNELS == 3
            ADD(1, uint(share.y * kFixedOne + 0.5))
            ADD(2, uint(share.z * kFixedOne + 0.5))
#endif
#if DIRECTION
            float power = kColour ? dot(share, params.colour.xyz) : share.x;
            vec3 towards = unit * (power * kFixedOne);
            ADD_SIGNED(CHANNELS + 0, round(towards.x))
            ADD_SIGNED(CHANNELS + 1, round(towards.y))
            ADD_SIGNED(CHANNELS + 2, round(towards.z))
#endif
            ++deposits;
            if (leave >= 1.0) break;
            t = leave;
            bvec3 crosses = lessThanEqual(crossing, vec3(leave));
            // One axis at a time; the others follow with a path length of 0.
            crosses.y = crosses.y && !crosses.x;
            crosses.z = crosses.z && !crosses.x && !crosses.y;
            ivec3 moves = ivec3(crosses);
            crossing += vec3(moves) * slope;
            cell += moves * turn;
            voxel += moves.x * jump.x + moves.y * jump.y + moves.z * jump.z;
            walking = all(lessThan(uvec3(cell), uvec3(size)));
        }
        ++steps;
        x = next;
        sampled = fieldAt(x);
        w = kBend ? halfKick(middle, sampled, tau) : w;

        float brightest = kColour ? max(weight.x, max(weight.y, weight.z)) : weight.x;
        if (stopped) {
            alive = false;
        } else if (timeToLeave(x, w, low, high) < 1.0e-4) {
            alive = false;
            tally(kEscaped, weight.x);
            if (kColour) {
                tally(kEscaped + 1u, weight.y);
                tally(kEscaped + 2u, weight.z);
            }
        } else if (brightest < dropBelow || steps >= params.list.z) {
            alive = false;
            if (steps >= params.list.z) book(kTrapped, 1u);
            tally(kLost, weight.x);
            if (kColour) {
                tally(kLost + 1u, weight.y);
                tally(kLost + 2u, weight.z);
            }
        }
    }
    if (stopped) absorbed += weight; // opaque material takes what arrives

    if (kMedium || kOpaque) {
        tally(kAbsorbed, absorbed.x);
        tally(kScattered, scattered.x);
        if (kColour) {
            tally(kAbsorbed + 1u, absorbed.y);
            tally(kAbsorbed + 2u, absorbed.z);
            tally(kScattered + 1u, scattered.y);
            tally(kScattered + 2u, scattered.z);
        }
    }
    book(kSteps, steps - uint(photon.state.y));
    book(kDeposits, deposits);
    if (alive) {
        photon.place = vec4(x, weight.x);
        photon.wave = vec4(w, weight.y);
        photon.state = vec4(weight.z, float(steps), 0.0, 0.0);
        nextPhotons[atomicAdd(nextCount, 1u)] = photon;
    }
}
