// Polygons to triangles: a fan where that will do, clipped ears elsewhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangulate.h"

#include <algorithm>

namespace eikonal::mesh {

namespace {

/// The polygon's corners, projected along the axis nearest to its normal and seen anticlockwise.
std::vector<glm::dvec2> flattened(const std::vector<glm::dvec3>& points,
                                  const std::vector<std::uint32_t>& polygon) {
    glm::dvec3 normal(0); // Newell's: right for concave and bent polygons too
    const glm::dvec3 origin = points[polygon[0]];
    for (size_t i = 0; i < polygon.size(); ++i)
        normal += glm::cross(points[polygon[i]] - origin,
                             points[polygon[(i + 1) % polygon.size()]] - origin);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<glm::dvec2> flat;
    for (std::uint32_t index : polygon) {
        const glm::dvec3 p = points[index] - origin;
        const glm::dvec2 q(p[(axis + 1) % 3], p[(axis + 2) % 3]);
        flat.push_back(normal[axis] < 0 ? glm::dvec2(q.y, q.x) : q);
    }
    return flat;
}

/// Twice the area of a triangle, positive if it runs anticlockwise.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool isConvex(const std::vector<glm::dvec2>& p) {
    const size_t n = p.size();
    for (size_t i = 0; i < n; ++i)
        if (area(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0) return false;
    return true;
}

/// Whether the corner at ring[at] can be cut off: it bulges out and no other corner is in the way.
bool isEar(const std::vector<glm::dvec2>& p, const std::vector<size_t>& ring, size_t at) {
    const size_t n = ring.size();
    const glm::dvec2 a = p[ring[(at + n - 1) % n]], b = p[ring[at]], c = p[ring[(at + 1) % n]];
    if (area(a, b, c) <= 0) return false;
    return std::none_of(ring.begin(), ring.end(), [&](size_t i) {
        const glm::dvec2 q = p[i];
        return q != a && q != b && q != c && area(a, b, q) >= 0 && area(b, c, q) >= 0 &&
               area(c, a, q) >= 0;
    });
}

} // namespace

void appendTriangles(const std::vector<glm::dvec3>& points,
                     const std::vector<std::uint32_t>& polygon,
                     std::vector<glm::uvec3>& triangles) {
    std::vector<size_t> ring(polygon.size());
    for (size_t i = 0; i < ring.size(); ++i) ring[i] = i;
    // Clipping takes up to cubic time; a polygon of more corners than this gets a fan.
    constexpr size_t kMostCorners = 1000;
    if (polygon.size() > 3 && polygon.size() <= kMostCorners) {
        const std::vector<glm::dvec2> flat = flattened(points, polygon);
        if (!isConvex(flat)) {
            size_t at = 0;
            for (size_t misses = 0; ring.size() > 3 && misses < ring.size();) {
                const size_t n = ring.size();
                if (!isEar(flat, ring, at % n)) {
                    ++at;
                    ++misses;
                    continue;
                }
                triangles.emplace_back(polygon[ring[(at + n - 1) % n]], polygon[ring[at % n]],
                                       polygon[ring[(at + 1) % n]]);
                ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at % n));
                misses = 0;
            }
        }
    }
    for (size_t i = 1; i + 1 < ring.size(); ++i)
        triangles.emplace_back(polygon[ring[0]], polygon[ring[i]], polygon[ring[i + 1]]);
}

} // namespace eikonal::mesh
