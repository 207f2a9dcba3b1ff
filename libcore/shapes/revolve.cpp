// A profile turned round the y axis.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/revolve.h"

#include "base/error.h"
#include "base/text.h"
#include "shapes/outline_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eikonal::shapes {

namespace {

[[noreturn]] void refuse(const Profile& profile, const std::string& found,
                         const std::string& expected) {
    throw DataError(profile.title + ": found " + found + ", expected " + expected);
}

bool onAxis(const glm::dvec2& p) {
    return p.x == 0;
}

/// A loop that runs along the axis as an open profile from its one end there to the other.
void openAtAxis(Profile& profile) {
    auto& points = profile.points;
    const size_t count = points.size();
    size_t runs = 0, start = 0; // runs of points on the axis, and where the last one ends
    for (size_t i = 0; i < count; ++i)
        if (onAxis(points[i]) && !onAxis(points[(i + 1) % count])) {
            ++runs;
            start = i;
        }
    if (runs == 0) return;
    if (runs == 1 && !onAxis(points[(start + count - 1) % count]))
        refuse(profile, profile.places[start] + " on the axis alone",
               "a loop that keeps off the axis, or runs along it");
    const auto shift = static_cast<std::ptrdiff_t>(start);
    std::rotate(points.begin(), points.begin() + shift, points.end());
    std::rotate(profile.places.begin(), profile.places.begin() + shift, profile.places.end());
    profile.loop = false;
}

/// Drops what runs along the axis at an open profile's ends, and joins ends that are off it to it.
void closeAtAxis(Profile& profile) {
    auto& points = profile.points;
    auto& places = profile.places;
    while (points.size() > 2 && onAxis(points[0]) && onAxis(points[1])) {
        points.erase(points.begin());
        places.erase(places.begin());
    }
    while (points.size() > 2 && onAxis(points.back()) && onAxis(points[points.size() - 2])) {
        points.pop_back();
        places.pop_back();
    }
    if (!onAxis(points.front())) {
        points.insert(points.begin(), {0, points.front().y});
        places.insert(places.begin(), places.front());
    }
    if (!onAxis(points.back())) {
        points.emplace_back(0, points.back().y);
        places.push_back(places.back());
    }
    for (size_t i = 1; i + 1 < points.size(); ++i)
        if (onAxis(points[i]))
            refuse(profile, places[i] + " on the axis", "only a profile's ends there");
}

} // namespace

void RevolveParams::check() const {
    requireOption(segments >= 3 && segments <= 16384, "--segments", std::to_string(segments),
                  "3 to 16384");
    requireOption(tolerance >= 0 && std::isfinite(tolerance), "--tolerance", toText(tolerance),
                  "0 or more");
}

mesh::TriangleMesh revolve(const Profile& given, const RevolveParams& params) {
    Profile profile = given;
    if (profile.loop) openAtAxis(profile);
    if (!profile.loop) closeAtAxis(profile);
    auto& points = profile.points;
    if (const auto crossing = selfCrossing(points, profile.loop))
        refuse(profile,
               "that the profile meets itself behind " + profile.places[crossing->first] + " and " +
                   profile.places[crossing->second],
               "one that does not");
    const double area = enclosedArea(points);
    if (area == 0) refuse(profile, "a profile that encloses nothing", "an area beside the axis");
    if (area < 0) std::reverse(points.begin(), points.end());

    mesh::TriangleMesh body;
    struct Ring {
        std::uint32_t first, size;
    };
    std::vector<Ring> rings;
    const auto around = static_cast<std::uint32_t>(params.segments);
    for (const glm::dvec2& p : points) {
        rings.push_back({static_cast<std::uint32_t>(body.points.size()), onAxis(p) ? 1 : around});
        for (std::uint32_t i = 0; i < rings.back().size; ++i) {
            const double a = 2 * std::numbers::pi * i / around;
            body.points.emplace_back(p.x * std::cos(a), p.y, -p.x * std::sin(a));
        }
    }
    const auto corner = [](const Ring& ring, std::uint32_t i) {
        return ring.first + i % ring.size;
    };
    for (size_t r = 0; r + 1 < rings.size() + profile.loop; ++r) {
        const Ring &ring = rings[r], &next = rings[(r + 1) % rings.size()];
        for (std::uint32_t i = 0; i < around; ++i) {
            if (ring.size > 1)
                body.triangles.emplace_back(corner(ring, i), corner(ring, i + 1), corner(next, i));
            if (next.size > 1)
                body.triangles.emplace_back(corner(next, i), corner(ring, i + 1),
                                            corner(next, i + 1));
        }
    }
    return body;
}

} // namespace eikonal::shapes
