// Where in its pixel each of a pixel's rays goes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace eikonal::camera {

/// So many places in a pixel, from (0, 0) to (1, 1), always the same: each of as many columns, and
/// each of as many rows, has one in its middle, so that their mean is the pixel's middle. The
/// first is there, or of an even number half a column and half a row beside.
std::vector<glm::dvec2> samplePattern(int samples);

} // namespace eikonal::camera
