// Where a chain of plane segments touches itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace eikonal::shapes {

/// Two segments of the chain, numbered by their first points, that meet in more than the point
/// that neighbours share; `loop`: the last point is joined to the first. Pairs are sought among
/// segments sorted along y, which takes little where the chain is long and its segments short.
std::optional<std::pair<size_t, size_t>> selfCrossing(const std::vector<glm::dvec2>& points,
                                                      bool loop);

/// The area that the closed chain encloses [unit²], anticlockwise positive.
double enclosedArea(const std::vector<glm::dvec2>& points);

} // namespace eikonal::shapes
