// Cubic B-splines: a smooth curve through samples, by weights of four coefficients along an axis.
// SPDX-License-Identifier: GPL-3.0-or-later

// The weights of coefficients i − 1 … i + 2 at i + t, t in [0, 1).
vec4 splineWeights(float t) {
    float s = 1.0 - t;
    return vec4(s * s * s, 4.0 - 3.0 * t * t * (2.0 - t), 4.0 - 3.0 * s * s * (2.0 - s), t * t * t) /
           6.0;
}

// Their second derivatives.
vec4 splineBends(float t) {
    return vec4(1.0 - t, 3.0 * t - 2.0, 1.0 - 3.0 * t, t);
}

// Their first derivatives.
vec4 splineSlopes(float t) {
    float s = 1.0 - t;
    return vec4(-0.5 * s * s, t * (1.5 * t - 2.0), s * (2.0 - 1.5 * s), 0.5 * t * t);
}
