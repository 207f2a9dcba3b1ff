// Directions and lat-long pictures: where in an environment map a direction lies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/latlong.h"

#include <cmath>
#include <numbers>

namespace eikonal::image {

namespace {

constexpr double kPi = std::numbers::pi;

} // namespace

glm::dvec2 latLongFromDirection(glm::dvec3 direction) {
    // atan2 rather than asin: full precision near the poles, and no need of a unit vector.
    const double horizontal = std::hypot(direction.x, direction.z);
    const double latitude = std::atan2(direction.y, horizontal);
    const double longitude = horizontal == 0 ? 0 : std::atan2(direction.x, direction.z);
    return {0.5 - longitude / (2 * kPi), 0.5 - latitude / kPi};
}

glm::dvec3 directionFromLatLong(glm::dvec2 uv) {
    const double longitude = (0.5 - uv.x) * 2 * kPi;
    const double latitude = (0.5 - uv.y) * kPi;
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            std::cos(longitude) * std::cos(latitude)};
}

glm::dvec2 pixelFromLatLong(glm::dvec2 uv, glm::ivec2 size, bool onEdges) {
    const glm::dvec2 extent(size);
    return onEdges ? uv * (extent - 1.0) : uv * extent - 0.5;
}

} // namespace eikonal::image
