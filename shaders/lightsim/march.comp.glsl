// Photons through the volume: adaptive curved steps, every crossed voxel gets its exact share.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sun et al. 2008, §4.4. A work item carries one photon for some steps; survivors go on the next list.
#include "shared/lightsim_params.h"
#include "lightsim/fates.glsl"

#if !defined(PATH) || !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || \
    !defined(OPAQUE)
#error PATH must be 0 to 5, DIRECTION, OPAQUE 0 or 1, MEDIUM 0 to 2, CHANNELS 1 or 3
#endif
const bool kMedium = MEDIUM > 0;    // something absorbs or scatters
const bool kDense = MEDIUM == 2;    // a voxel may have an optical depth above 0.25
const bool kColour = CHANNELS == 3; // it does so by wavelength
const bool kOpaque = OPAQUE == 1;   // opaque voxels stop photons

layout(local_size_x = 64) in;
#include "lightsim/deposit.glsl"
layout(binding = 3) uniform sampler3D absorption; // padded by one; grey: (σ_a, σ_s) [1/voxel]
layout(binding = 4) uniform sampler3D scattering; // colour only
#include "medium/sample.glsl"
#include "lightsim/step.glsl"

vec3 coordinate(vec3 x) {
    return (x + 1.5) * params.scale.xyz;
}

void main() {
    if (gl_GlobalInvocationID.x >= params.list.x) return;
    uint id = list[gl_GlobalInvocationID.x];
    Photon photon = photons[id];
    Carried carried = carriedBy(photon);
    vec3 x = photon.place.xyz;
    vec3 w = photon.wave.xyz;
    uint steps = photon.count.y;
    uint last = steps + params.list.y;
    uint fate = kAlive;
    vec3 centre = 0.5 * vec3(params.size.xyz) - 0.5;
    vec3 halfSize = 0.5 * vec3(params.size.xyz);
    vec4 sampled = fieldAt(x);
    float longest = 1.0e6; // adaptive: dτ [voxel]
    float error = uintBitsToFloat(photon.count.w);

    while (steps < last && fate == kAlive) {
        Step made = stepFrom(x, w, sampled, longest);
        if (kPath > kVerlet) {
            longest = made.leap.longest;
            error += made.leap.off;
        }
        vec3 next = made.next;
        vec3 along = next - x;
        vec3 sigmaA = vec3(0.0);
        vec3 sigmaS = vec3(0.0);
        if (kMedium) {
            vec3 at = coordinate(x + 0.5 * along);
            vec4 a = textureLod(absorption, at, 0.0);
            sigmaA = kColour ? a.xyz : vec3(a.x);
            sigmaS = kColour ? textureLod(scattering, at, 0.0).xyz : vec3(a.y);
        }
        deposit(carried, x, along, sigmaA, sigmaS);
        if (kOpaque && carried.ends < 1.0) {
            fate = kStopped;
            next = x + carried.ends * along;
        }
        ++steps;
        x = next;
        vec4 behind = fieldBehind(made, x, sampled);
        w = waveBehind(made, w, sampled, behind);
        sampled = behind;

        // Left the domain: on its face, on the way out.
        bool outside = any(greaterThanEqual((x - centre) * sign(w), halfSize - 1.0e-4));
        float brightest = kColour ? max(carried.weight.x, max(carried.weight.y, carried.weight.z))
                                  : carried.weight.x;
        if (fate == kAlive)
            fate = outside                            ? kEscaped
                   : brightest < params.limits.y     ? kFaded
                   : steps >= params.list.z          ? kTrapped
                                                     : kAlive;
    }
    if (kOpaque && fate == kStopped) {
        carried.absorbed += carried.weight; // opaque material takes what arrives
        carried.weight = vec3(0.0);
    }
    keep(id, carried, x, w, fate, steps, error);
}
