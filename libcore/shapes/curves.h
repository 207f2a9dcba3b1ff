// Bézier curves as chains of chords: what outlines of fonts and drawings are made of.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace eikonal::shapes {

/// Appends points of the curve with these control points (2: a line, 3: a conic, 4: a cubic), its
/// first left out and its last included, so many that chords are within `tolerance` of it: a chord
/// over 1/n of the parameter is off by at most |B''| / (8 n²).
void appendCurve(const std::vector<glm::dvec2>& control, double tolerance,
                 std::vector<glm::dvec2>& points);

} // namespace eikonal::shapes
