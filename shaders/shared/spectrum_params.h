// The wavelengths that rays of a band take. Read by C++ and GLSL; vec4-sized members only.
// SPDX-License-Identifier: GPL-3.0-or-later

const int kLines = 64; // kLinesPerBand in libcore/optics/bands.h

struct SpectrumParams {
    vec4 lines[kLines]; // rgb: the line's share of white light; w: 1/λ² − 1/0.5876² [1/µm²]
};
