// The first outline of an SVG drawing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace eikonal::shapes {

/// Béziers end to end, each of 2, 3 or 4 control points, in the drawing's user units, y downward.
struct SvgOutline {
    std::vector<std::vector<glm::dvec2>> curves;
    bool closed = false; ///< by Z, or a polygon
};

/// Of the first <path>, <polyline> or <polygon> that is drawn (what <defs>, <clipPath>, <marker>,
/// <mask>, <pattern> and <symbol> hold is not). A path may have M L H V C S Q T A Z, absolute or
/// relative, and one outline; arcs become cubics. Throws DataError, with the place in the path
/// data, for anything else, also a transform, which is not applied. `title` names the file in
/// messages.
SvgOutline readSvg(std::string_view text, const std::string& title);

} // namespace eikonal::shapes
