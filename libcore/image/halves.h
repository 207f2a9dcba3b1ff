// Pictures whose samples are floats of 16 bits, as most files' are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"

#include <cstdint>

namespace eikonal::image {

/// Whether every sample is a half, so that nothing is lost where it is stored as one.
bool areHalves(const Image& image);

/// Writes a plane's rows from `row` on to every `stride`-th half of `out`. Other samples are
/// rounded.
void copyHalves(const Image& image, size_t plane, int row, int rows, std::uint16_t* out,
                size_t stride);

} // namespace eikonal::image
