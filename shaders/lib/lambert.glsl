// Directions that a matt surface sends light in.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/random.glsl"

// A direction about `normal`, as many as its cosine is large. Photons that start side by side have
// numbers that lie evenly in the unit square: the plastic number's powers, of 32 bits.
vec3 lambertAbout(vec3 normal, uint id, uint seed) {
    uint hash = pcgHash(seed);
    float off = uniformOf(id * 3242174889u + hash);
    float turn = 6.283185307179586 * uniformOf(id * 2447445414u + pcgHash(hash));
    vec3 helper = abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 right = normalize(cross(normal, helper));
    vec3 up = cross(right, normal);
    return normalize(sqrt(1.0 - off) * normal + sqrt(off) * (cos(turn) * right + sin(turn) * up));
}
