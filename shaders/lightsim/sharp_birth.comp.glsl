// Photons from the photon map, born within the object that holds their place, or around them all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/ray.glsl"
#include "lightsim/birth.glsl"
#include "medium/sample.glsl"
#include "medium/surface.glsl"
#include "lightsim/passage.glsl"

layout(local_size_x = 64) in;

// Every photon has one number that decides at boundaries whether it is reflected. The numbers are a
// lattice of rank 1 over the whole photon map, x·a + y·b modulo 1, here of 32 bits: in any patch of it
// they lie evenly in (0, 1), so that of neighbours just the share R is reflected, where numbers by
// chance would scatter by √(R (1 − R) N). This a and b, 0.6885 and 0.4172, were the best of 4000 pairs
// for squares of 4 to 32 pixels and R of 0.02 to 0.3: one photon off in a patch, where the powers of the
// plastic number have up to two, and orders that divide squares by four are no better than chance where
// a patch is none of their squares. Seeds shift the lattice.
float indexAtBirth(uint id, ivec2 pixel, vec3 x) {
    uvec2 at = uvec2(pixel * params.batch.z + params.batch.xy);
    float chance = chanceOf(at.x * 2957188063u + at.y * 1791843177u + pcgHash(uint(params.map.z)));
    uint inside = insideAt(x);
    keepPassage(id, Passage(inside, 0u, chance, 1.0, 0.0));
    return indexOf(regionOf(inside), x);
}

void main() {
    bear();
}
