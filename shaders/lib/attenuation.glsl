// Exponential attenuation along a straight piece.
// SPDX-License-Identifier: GPL-3.0-or-later

// The mean of exp(−t) for t from 0 to x: (1 − e^−x)/x. e is exp(−x), which callers have at hand.
float meanTransmittance(float x, float e) {
    // The quotient cancels for small x; below this the series is as exact as float.
    return x < 0.02 ? 1.0 - x * (0.5 - x * (0.16666667 - x * 0.041666667)) : (1.0 - e) / x;
}

// exp(−x) for x ≥ 0 that is exactly 0 where float would be denormal.
float transmittanceOf(float x) {
    return x > 87.0 ? 0.0 : exp(-x);
}
