// The sRGB transfer curve, IEC 61966-2-1, both ways; shared with the picture module.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace eikonal::image {

/// The encoded value in [0, 1] of a linear one in [0, 1].
inline double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The linear value in [0, 1] of an encoded one in [0, 1].
inline double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace eikonal::image
