// Pictures whose samples are floats of 16 bits, as most files' are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/halves.h"

#include <Imath/half.h>
#include <algorithm>

namespace eikonal::image {

bool areHalves(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](float value) { return static_cast<float>(Imath::half(value)) == value; });
}

void copyHalves(const Image& image, size_t plane, int row, int rows, std::uint16_t* out,
                size_t stride) {
    const auto width = static_cast<size_t>(image.width);
    const auto from = image.plane(plane).subspan(static_cast<size_t>(row) * width,
                                                 static_cast<size_t>(rows) * width);
    for (const float value : from) {
        *out = Imath::half(value).bits();
        out += stride;
    }
}

} // namespace eikonal::image
