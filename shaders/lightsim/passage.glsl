// What a photon among sharp boundaries carries beside its light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/random.glsl"

struct Passage {
    uint inside;   // the solids it is in, a bit each
    uint met;      // boundaries met
    float chance;  // decides between reflection and refraction, in (0, 1)
    float worth;   // what share of its digits is left
    float departs; // how steeply the photon leaves the boundary it is on; 0: on none
};

layout(std430, binding = 10) buffer Passages { uvec4 passages[]; };

Passage passageOf(uint id) {
    uvec4 kept = passages[id];
    return Passage(kept.x & 0xFFFFu, kept.x >> 16u, uintBitsToFloat(kept.y), uintBitsToFloat(kept.z),
                   uintBitsToFloat(kept.w));
}

void keepPassage(uint id, Passage p) {
    passages[id] = uvec4(p.inside | p.met << 16u, floatBitsToUint(p.chance), floatBitsToUint(p.worth),
                         floatBitsToUint(p.departs));
}

// In (0, 1), never an end: where nothing is reflected nothing may chance to be.
float chanceOf(uint bits) {
    return (float(bits >> 9u) + 0.5) * 1.1920928955078125e-7;
}
