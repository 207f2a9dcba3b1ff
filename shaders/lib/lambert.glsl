// Directions that a matt surface sends light in.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/random.glsl"

// A direction about `normal`, as many as its cosine is large. Photons that start side by side have
// numbers that lie evenly in the unit square: the plastic number's powers, of 32 bits. Those of the next
// bounces must not follow from the first one's.
vec3 lambertAbout(vec3 normal, uint id, int bounce, uint seed) {
    uint hash = pcgHash(seed);
    uint off = id * 3242174889u + hash;
    uint turn = id * 2447445414u + pcgHash(hash);
    if (bounce > 1) {
        off = pcgHash(id ^ pcgHash(hash + uint(bounce)));
        turn = pcgHash(off ^ hash);
    }
    float sine2 = uniformOf(off);
    float angle = 6.283185307179586 * uniformOf(turn);
    vec3 helper = abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 right = normalize(cross(normal, helper));
    vec3 up = cross(right, normal);
    return normalize(sqrt(1.0 - sine2) * normal + sqrt(sine2) * (cos(angle) * right + sin(angle) * up));
}
