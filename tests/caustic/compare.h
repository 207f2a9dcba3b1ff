// How far a picture of a lit floor is from the exact one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"
#include "judge/floor_view.h"

namespace caustic {

/// R, G and B, all the same, and `meets.V`: the number of judge::Meets.
eikonal::image::Image imageOf(const judge::Picture& picture, const judge::View& view,
                              double irradiance);

struct Errors {
    int pixels = 0;
    double error = 0;  ///< root mean square of (I − R) / √(R² + (0.1 mean R)²)
    double within = 0; ///< share of pixels where that ratio is at most a twentieth
    double energy = 0; ///< mean I over mean R, less 1
};

/// Of G over the pixels of `exact`, made by imageOf(), that meet so. Throws std::invalid_argument
/// where a channel is missing or sizes differ.
Errors errorsOf(const eikonal::image::Image& picture, const eikonal::image::Image& exact,
                judge::Meets meets);

} // namespace caustic
