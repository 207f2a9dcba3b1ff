// Which of the rays that leave an interface a photon is, by its number.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lib/random.glsl"

// Below this share of its digits a photon's number is renewed: 13 of 23 bits are left to decide by.
const float kLeastWorth = 1.0 / 1024.0;

// In (0, 1), never an end: where nothing is reflected nothing may chance to be.
float chanceOf(uint bits) {
    return (float(bits >> 9u) + 0.5) * 1.1920928955078125e-7;
}

// Whether the number is within the first `share` of (0, 1). It is used again: where it lies within its
// part is again a number in (0, 1), and neighbours' again lie evenly. With few digits left it is renewed
// from `seed`.
bool isWithin(inout float chance, inout float worth, float share, uint seed) {
    bool within = chance < share;
    float part = within ? share : 1.0 - share;
    if (share > 0.0 && share < 1.0) {
        chance = (within ? chance : chance - share) / part;
        worth *= part;
        if (worth < kLeastWorth) {
            chance = chanceOf(pcgHash(seed));
            worth = 1.0;
        }
    }
    return within;
}
