// The wavelength of the light that is traced, where the index depends on it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// By Cauchy's law n(λ) = n + B c(λ). One invocation traces light of one wavelength.
#include "shared/bindings.h"
#include "shared/spectrum_params.h"

#ifndef DISPERSION
#error DISPERSION must be 0 or 1
#endif
const bool kDisperses = DISPERSION == 1;
#if DISPERSION == 1
layout(std140, binding = kSpectrumBlock) uniform Spectrum { SpectrumParams spectrum; };
float cauchyTerm = 0.0; // c [1/µm²]
#endif

// Takes one of the band's lines. Returns its share of white light.
vec3 takeLine(uint number) {
#if DISPERSION == 1
    vec4 line = spectrum.lines[number % uint(kLines)];
    cauchyTerm = line.w;
    return line.xyz;
#else
    return vec3(1.0);
#endif
}

// [µm]
float wavelength() {
#if DISPERSION == 1
    return inversesqrt(cauchyTerm + 1.0 / (0.5876 * 0.5876));
#else
    return 0.5876;
#endif
}

// What follows the wavelength: a value at 587.6 nm, and its Cauchy B [µm²].
float dispersed(float value, float slope) {
#if DISPERSION == 1
    return value + cauchyTerm * slope;
#else
    return value;
#endif
}

// Of a pixel: two powers of the plastic number, so that neighbours take lines far from each other, and few
// pixels together all of them.
uint lineOf(ivec2 pixel) {
    return (uint(pixel.x) * 3242174889u + uint(pixel.y) * 2447445414u) >> 26u;
}

// Of a photon: likewise by the golden ratio.
uint lineOf(uint id) {
    return (id * 2654435769u) >> 26u;
}
