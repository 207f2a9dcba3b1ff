// Where a chain of plane segments touches itself.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/outline_checks.h"

#include <algorithm>
#include <numeric>

namespace eikonal::shapes {

namespace {

using Point = glm::dvec2;

double cross(const Point& a, const Point& b) {
    return a.x * b.y - a.y * b.x;
}

/// Which side of the line a b the point p is on: 1, 0, -1.
int sideOf(const Point& a, const Point& b, const Point& p) {
    const double area = cross(b - a, p - a);
    return (area > 0) - (area < 0);
}

/// Whether p, on the line a b, lies on the segment.
bool within(const Point& a, const Point& b, const Point& p) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const int ac = sideOf(a, b, c), ad = sideOf(a, b, d), ca = sideOf(c, d, a),
              cb = sideOf(c, d, b);
    if (ac != ad && ca != cb && ac * ad <= 0 && ca * cb <= 0) return true;
    return (ac == 0 && within(a, b, c)) || (ad == 0 && within(a, b, d)) ||
           (ca == 0 && within(c, d, a)) || (cb == 0 && within(c, d, b));
}

/// Neighbours a b, b c: whether c goes back over the first.
bool foldsBack(const Point& a, const Point& b, const Point& c) {
    return sideOf(a, b, c) == 0 && glm::dot(a - b, c - b) > 0;
}

} // namespace

std::optional<std::pair<size_t, size_t>> selfCrossing(const std::vector<Point>& points, bool loop) {
    const size_t count = points.size(), segments = loop ? count : count - 1;
    const auto end = [&](size_t i) -> const Point& { return points[(i + 1) % count]; };
    for (size_t i = 0; i + 1 < segments + loop; ++i)
        if (foldsBack(points[i], end(i), end((i + 1) % count))) return {{i, (i + 1) % count}};
    const auto lowOf = [&](size_t i) { return std::min(points[i].y, end(i).y); };
    const auto highOf = [&](size_t i) { return std::max(points[i].y, end(i).y); };
    std::vector<size_t> order(segments);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return lowOf(a) < lowOf(b); });
    std::vector<size_t> open; // segments that may reach as high
    for (const size_t i : order) {
        std::erase_if(open, [&](size_t other) { return highOf(other) < lowOf(i); });
        for (const size_t other : open) {
            const size_t a = std::min(i, other), b = std::max(i, other);
            const bool neighbours = b == a + 1 || (loop && a == 0 && b == segments - 1);
            if (!neighbours && meet(points[a], end(a), points[b], end(b))) return {{a, b}};
        }
        open.push_back(i);
    }
    return {};
}

double enclosedArea(const std::vector<Point>& points) {
    double twice = 0;
    for (size_t i = 0; i < points.size(); ++i)
        twice += cross(points[i], points[(i + 1) % points.size()]);
    return twice / 2;
}

} // namespace eikonal::shapes
