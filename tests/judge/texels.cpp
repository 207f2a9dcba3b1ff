// Light laid down on a plane's texels by patches, each texel getting its share of their area.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/texels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace judge {

namespace {

/// A convex polygon; a triangle that four lines cut has no more than seven corners.
struct Polygon {
    dvec2 corners[8];
    int count = 0;

    double area() const {
        double twice = 0;
        for (int i = 1; i + 1 < count; ++i) {
            const dvec2 a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
            twice += a.x * b.y - a.y * b.x;
        }
        return 0.5 * std::abs(twice);
    }
};

/// What of a polygon has a coordinate above `from` (sign 1) or below it (sign −1).
Polygon clipped(const Polygon& polygon, int axis, double from, double sign) {
    Polygon out;
    for (int i = 0; i < polygon.count; ++i) {
        const dvec2& a = polygon.corners[i];
        const dvec2& b = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
        const double fromA = sign * (a[axis] - from), fromB = sign * (b[axis] - from);
        if (fromA >= 0) out.corners[out.count++] = a;
        if ((fromA > 0 && fromB < 0) || (fromA < 0 && fromB > 0))
            out.corners[out.count++] = a + fromA / (fromA - fromB) * (b - a);
    }
    return out;
}

/// The least and the greatest coordinate of a polygon.
dvec2 range(const Polygon& polygon, int axis) {
    double least = polygon.corners[0][axis], most = least;
    for (int i = 1; i < polygon.count; ++i) {
        least = std::min(least, polygon.corners[i][axis]);
        most = std::max(most, polygon.corners[i][axis]);
    }
    return {least, most};
}

/// The first and the last texel of `size` that a range reaches; last < first: none.
glm::ivec2 reach(const dvec2& range, int size) {
    return {static_cast<int>(glm::clamp(range.x, 0.0, static_cast<double>(size))),
            static_cast<int>(std::floor(glm::clamp(range.y, -1.0, size - 0.5)))};
}

double& texel(Texels& texels, int i, int j) {
    return texels.values[static_cast<size_t>(j) * static_cast<size_t>(texels.size.x) +
                         static_cast<size_t>(i)];
}

void layPoint(Texels& power, const dvec2& at, double amount) {
    const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y));
    if (at.x >= 0 && at.y >= 0 && i < power.size.x && j < power.size.y)
        texel(power, i, j) += amount;
}

/// Of what has no area: along its longest side.
void layLine(Texels& power, const Polygon& triangle, double amount) {
    dvec2 from = triangle.corners[0], along(0);
    for (int i = 0; i < 3; ++i) {
        const dvec2 side = triangle.corners[(i + 1) % 3] - triangle.corners[i];
        if (glm::dot(side, side) > glm::dot(along, along)) from = triangle.corners[i], along = side;
    }
    const int pieces = 1 + static_cast<int>(8 * std::min(std::sqrt(glm::dot(along, along)), 100.0));
    for (int i = 0; i < pieces; ++i)
        layPoint(power, from + (i + 0.5) / pieces * along, amount / pieces);
}

} // namespace

Texels::Texels(dvec2 lowCorner, dvec2 high, double texelsPerUnit)
    : low(lowCorner), edge(1 / texelsPerUnit),
      size(glm::ivec2(glm::round((high - lowCorner) * texelsPerUnit))),
      values(static_cast<size_t>(size.x) * static_cast<size_t>(size.y)) {}

bool Texels::holds(const dvec2& place) const {
    const dvec2 p = (place - low) / edge;
    return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y;
}

double Texels::at(const dvec2& place) const {
    if (!holds(place)) return 0;
    const dvec2 p = (place - low) / edge;
    return values[static_cast<size_t>(p.y) * static_cast<size_t>(size.x) +
                  static_cast<size_t>(p.x)];
}

double Texels::mean() const {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

void layTriangle(Texels& power, dvec2 a, dvec2 b, dvec2 c, double amount) {
    Polygon triangle;
    triangle.count = 3;
    triangle.corners[0] = (a - power.low) / power.edge;
    triangle.corners[1] = (b - power.low) / power.edge;
    triangle.corners[2] = (c - power.low) / power.edge;
    const double area = triangle.area();
    // [texel²]: below it the parts' areas would be rounding.
    if (area < 1e-9) return layLine(power, triangle, amount);
    const glm::ivec2 rows = reach(range(triangle, 1), power.size.y);
    for (int j = rows.x; j <= rows.y; ++j) {
        const Polygon row = clipped(clipped(triangle, 1, j, 1), 1, j + 1, -1);
        if (row.count < 3) continue;
        const dvec2 wide = range(row, 0);
        const glm::ivec2 columns = reach(wide, power.size.x);
        for (int i = columns.x; i <= columns.y; ++i) {
            const bool whole = wide.x >= i && wide.y <= i + 1;
            const Polygon part = whole ? row : clipped(clipped(row, 0, i, 1), 0, i + 1, -1);
            texel(power, i, j) += part.area() / area * amount;
        }
    }
}

} // namespace judge
