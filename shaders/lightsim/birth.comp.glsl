// Photons from the photon map: one for every pixel that the light reaches (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/birth.glsl"
#include "medium/sample.glsl"

layout(local_size_x = 64) in;

float indexAtBirth(uint id, ivec2 pixel, vec3 x) {
    return indexAt(x);
}

void main() {
    bear();
}
