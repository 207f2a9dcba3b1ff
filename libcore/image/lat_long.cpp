// Directions of lat-long maps.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/lat_long.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::image {

namespace {

constexpr double kPi = 3.14159265358979323846;

} // namespace

glm::dmat3 mapFromWorld(double turn, bool zUp) {
    const double angle = glm::radians(turn);
    const glm::dmat3 turned(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0,
                            std::cos(angle));
    // A Z-up map's pole +Z is the map's +Y; its +X stays.
    return zUp ? turned * glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0) : turned;
}

glm::dvec3 directionOf(const glm::dvec2& place) {
    const double longitude = (0.5 - place.x) * 2 * kPi, latitude = (0.5 - place.y) * kPi;
    const double flat = std::cos(latitude);
    return {std::sin(longitude) * flat, std::sin(latitude), std::cos(longitude) * flat};
}

glm::dvec3 radianceAt(const Image& map, const glm::dvec2& place) {
    const bool byEdges = map.envmap == Envmap::latLong;
    const glm::dvec2 size(map.width, map.height);
    const glm::dvec2 at = byEdges ? place * (size - 1.0) : place * size - 0.5;
    const glm::dvec2 low = glm::floor(at), share = at - low;
    const auto pixel = [&](double x, double y) {
        // Outer pixels that lie on the seam are one and the same.
        const int around = byEdges ? std::max(map.width - 1, 1) : map.width;
        const int column = (static_cast<int>(x) % around + around) % around;
        const int row = std::clamp(static_cast<int>(y), 0, map.height - 1);
        const size_t i =
            static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column);
        return glm::dvec3(map.plane(0)[i], map.plane(1)[i], map.plane(2)[i]);
    };
    return glm::mix(glm::mix(pixel(low.x, low.y), pixel(low.x + 1, low.y), share.x),
                    glm::mix(pixel(low.x, low.y + 1), pixel(low.x + 1, low.y + 1), share.x),
                    share.y);
}

} // namespace eikonal::image
