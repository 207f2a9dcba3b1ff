// What is turned round an axis: points of (radius, height), from a table or a drawing.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace eikonal::shapes {

struct Profile {
    std::string title;               ///< the file, as messages name it
    std::vector<glm::dvec2> points;  ///< radius, height [unit]; none twice in a row
    std::vector<std::string> places; ///< of each, for messages
    bool loop = false;               ///< the last point is joined to the first
};

/// Reads a table or an SVG drawing, told by its content; "-" is standard input.
///  - A table has a radius and a height a line, apart by a comma, semicolon or blanks; lines may be
///    empty, # begins a comment. It is a loop where its last point is its first.
///  - Of a drawing it is the first outline (svg.h) in user units: x is the radius, the height is
///    counted upward from the outline's lowest point. Curves become chords within `tolerance`
///    [unit], 0: a two-thousandth of the outline's larger extent.
/// Throws MissingError, and DataError with the place: a negative radius, what is no number, fewer
/// than 2 points.
Profile readProfile(const std::string& path, double tolerance);

/// The same from a file's content, which messages name by `title`.
Profile profileFrom(std::string_view bytes, const std::string& title, double tolerance);

} // namespace eikonal::shapes
