// Where in its pixel each of a pixel's rays goes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace eikonal::camera {

// Multiples of the golden ratio fill a row as evenly as any sequence does. Their order, rather than
// their values, gives the rows: a row for each, which keeps the mean exact.
std::vector<glm::dvec2> samplePattern(int samples) {
    const auto count = static_cast<size_t>(samples);
    const int middle = samples / 2;
    std::vector<double> heights(count);
    for (int column = 0; column < samples; ++column) {
        const double turns = (column - middle) * std::numbers::phi + 0.5;
        heights[static_cast<size_t>(column)] = turns - std::floor(turns);
    }
    std::vector<int> columns(count); // from the lowest row up
    std::iota(columns.begin(), columns.end(), 0);
    std::sort(columns.begin(), columns.end(), [&](int a, int b) {
        return heights[static_cast<size_t>(a)] < heights[static_cast<size_t>(b)];
    });
    std::vector<glm::dvec2> places(count);
    for (int row = 0; row < samples; ++row) {
        const int column = columns[static_cast<size_t>(row)];
        const int sample = (column - middle + samples) % samples;
        places[static_cast<size_t>(sample)] = (glm::dvec2(column, row) + 0.5) / glm::dvec2(samples);
    }
    return places;
}

} // namespace eikonal::camera
