// Where a function that is positive at both ends of a step may still have fallen below 0.
// SPDX-License-Identifier: GPL-3.0-or-later

// The least value of the cubic with values f0, f1 and slopes d0, d1 at 0 and 1, within (0, 1): its
// place and value, or (0, f0) where it has no minimum there.
vec2 dipOf(float f0, float d0, float f1, float d1) {
    float c2 = 3.0 * (f1 - f0) - 2.0 * d0 - d1;
    float c3 = d0 + d1 - 2.0 * (f1 - f0);
    // d0 + 2 c2 t + 3 c3 t² = 0, the root where it rises.
    float root = c2 * c2 - 3.0 * c3 * d0;
    if (root < 0.0) return vec2(0.0, f0);
    float below = c2 + sqrt(root);
    float t = below > 0.0 ? -d0 / below : -1.0;
    if (t <= 0.0 || t >= 1.0) return vec2(0.0, f0);
    return vec2(t, f0 + t * (d0 + t * (c2 + t * c3)));
}
