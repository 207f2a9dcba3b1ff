// Bézier curves as chains of chords: what outlines of fonts and drawings are made of.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/curves.h"

#include <algorithm>
#include <cmath>

namespace eikonal::shapes {

void appendCurve(const std::vector<glm::dvec2>& control, double tolerance,
                 std::vector<glm::dvec2>& points) {
    // The second derivative is a curve whose control points are degree (degree - 1) times these.
    const double degree = static_cast<double>(control.size()) - 1;
    double bend = 0;
    for (size_t k = 0; k + 2 < control.size(); ++k)
        bend = std::max(bend, glm::length(control[k] - 2.0 * control[k + 1] + control[k + 2]));
    bend *= degree * (degree - 1);
    constexpr double most = 4096; // chords, where a tolerance is far below the curve's size
    const double wanted = bend > 0 ? std::ceil(std::sqrt(bend / (8 * tolerance))) : 1;
    const int chords = static_cast<int>(std::clamp(wanted, 1.0, most));
    for (int k = 1; k < chords; ++k) { // de Casteljau
        const double t = static_cast<double>(k) / chords;
        std::vector<glm::dvec2> level = control;
        for (; level.size() > 1; level.pop_back())
            for (size_t i = 0; i + 1 < level.size(); ++i)
                level[i] = glm::mix(level[i], level[i + 1], t);
        points.push_back(level[0]);
    }
    points.push_back(control.back());
}

} // namespace eikonal::shapes
