// Photons among sharp boundaries: Snell's and Fresnel's laws there, the ray equation in between.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A photon goes one way at a boundary, by its number. A work item carries one photon for some steps;
// survivors go on the next list.
#include "shared/lightsim_params.h"
#include "lib/box.glsl"
#include "lib/fresnel.glsl"
#include "lightsim/fates.glsl"

#if !defined(PATH) || !defined(CHANNELS) || !defined(MEDIUM) || !defined(DIRECTION) || \
    !defined(OPAQUE)
#error PATH must be 0 to 5, DIRECTION, OPAQUE 0 or 1, MEDIUM 0 to 2, CHANNELS 1 or 3
#endif
const bool kMedium = MEDIUM > 0;         // some region absorbs or scatters
const bool kDense = MEDIUM == 2;         // a voxel may have an optical depth above 0.25
const bool kColour = CHANNELS == 3;      // regions or their mirrors differ by wavelength
const bool kOpaque = false;              // no voxel stops photons,
const bool kOpaqueSolids = OPAQUE == 1;  // some objects do, at their boundaries

layout(local_size_x = 64) in;
#include "lightsim/deposit.glsl"
#include "medium/sample.glsl"
#include "lightsim/step.glsl"
#include "medium/meet.glsl"
#include "medium/region.glsl"
#include "lightsim/passage.glsl"
#include "lightsim/sharp_walk.glsl"

void main() {
    if (gl_GlobalInvocationID.x >= params.list.x) return;
    uint id = list[gl_GlobalInvocationID.x];
    Photon photon = photons[id];
    Carried carried = carriedBy(photon);
    Flight flight = Flight(Ray(photon.place.xyz, photon.wave.xyz), passageOf(id), kAlive, photon.count.y,
                           uintBitsToFloat(photon.count.w));
    uint last = flight.steps + params.list.y;
    // Cut open by the domain's face.
    if (kOpaqueSolids && isOpaque(regionOf(flight.passage.inside))) flight.fate = kStopped;

    while (flight.steps < last && flight.fate == kAlive) {
        if (kPath > kStraight) walkClear(flight, carried, last);
        if (flight.fate == kAlive) {
            Meeting met = walkOn(flight, carried);
            if (met.solid >= 0) pass(flight, carried, met, id);
            if (flight.fate == kAlive) flight.fate = fateOf(flight, carried);
        }
    }
    if (kOpaqueSolids && flight.fate == kStopped) {
        carried.absorbed += carried.weight; // opaque material takes what arrives
        carried.weight = vec3(0.0);
    }
    keepPassage(id, flight.passage);
    keep(id, carried, flight.ray.x, flight.ray.w, flight.fate, flight.steps, flight.error);
}
