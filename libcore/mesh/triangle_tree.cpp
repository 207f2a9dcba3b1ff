// Nearest points and rays among many triangles.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace eikonal::mesh {

namespace {

using glm::dvec3;

// A handful of triangles costs about what the boxes of two more levels would.
constexpr std::uint32_t kLeaf = 8;
// Halving 2³² triangles down to leaves takes 30 levels.
constexpr size_t kDeepest = 64;

double squared(const dvec3& v) {
    return glm::dot(v, v);
}

double squaredDistanceToSegment(const dvec3& x, const dvec3& a, const dvec3& b) {
    const dvec3 ab = b - a;
    const double length = squared(ab);
    const double t = length > 0 ? glm::clamp(glm::dot(x - a, ab) / length, 0.0, 1.0) : 0.0;
    return squared(x - (a + t * ab));
}

double squaredDistanceToBox(const dvec3& x, const Box& box) {
    return squared(glm::max(glm::max(box.min - x, x - box.max), dvec3(0)));
}

} // namespace

double squaredDistance(const dvec3& x, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double d1 = glm::dot(ab, ax), d2 = glm::dot(ac, ax);
    if (d1 <= 0 && d2 <= 0) return squared(ax);
    const double d3 = glm::dot(ab, bx), d4 = glm::dot(ac, bx);
    if (d3 >= 0 && d4 <= d3) return squared(bx);
    const double d5 = glm::dot(ab, cx), d6 = glm::dot(ac, cx);
    if (d6 >= 0 && d5 <= d6) return squared(cx);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return squaredDistanceToSegment(x, a, b);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return squaredDistanceToSegment(x, a, c);
    if (va <= 0 && d4 >= d3 && d5 >= d6) return squaredDistanceToSegment(x, b, c);
    const double area = va + vb + vc;
    // What has no area but by rounding has no inside either.
    if (!(area > 1e-14 * squared(ab) * squared(ac)))
        return std::min({squaredDistanceToSegment(x, a, b), squaredDistanceToSegment(x, b, c),
                         squaredDistanceToSegment(x, c, a)});
    const dvec3 normal = glm::cross(ab, ac);
    const double height = glm::dot(ax, normal);
    return height * height / squared(normal);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : mMesh(mesh), mFaces(mesh.triangles.size()), mCorners(mFaces.size()), mPlace(mFaces.size()) {
    std::vector<Centre> centres(mFaces.size());
    const auto count = static_cast<std::uint32_t>(mFaces.size());
    tbb::parallel_for(0u, count, [&](std::uint32_t f) {
        const glm::uvec3& face = mesh.triangles[f];
        centres[f] = {mesh.points[face.x] + mesh.points[face.y] + mesh.points[face.z], f};
    });
    mNodes.resize(nodesOf(count));
    if (count > 0) build(0, 0, count, centres);
}

/// Gives a face its place.
void TriangleTree::put(std::uint32_t f, std::uint32_t place) {
    const glm::uvec3& face = mMesh.triangles[f];
    Corners t{mMesh.points[face.x], mMesh.points[face.y], mMesh.points[face.z], {}, 0};
    t.middle = (t.a + t.b + t.c) / 3.0;
    const double squaredRadius =
        std::max({squared(t.a - t.middle), squared(t.b - t.middle), squared(t.c - t.middle)});
    t.radius = std::sqrt(squaredRadius) * (1 + 1e-12); // above all rounding
    mCorners[place] = t;
    mFaces[place] = f;
    mPlace[f] = place;
}

/// Of a subtree of so many faces.
size_t TriangleTree::nodesOf(std::uint32_t count) {
    if (count == 0) return 0;
    return count <= kLeaf ? 1 : 1 + nodesOf(count / 2) + nodesOf(count - count / 2);
}

/// The subtree of some faces, halved at the median of their centres along the longest edge, from
/// node `self` on.
void TriangleTree::build(size_t self, std::uint32_t first, std::uint32_t count,
                         std::vector<Centre>& centres) {
    if (count <= kLeaf) {
        Box box;
        for (std::uint32_t i = first; i < first + count; ++i) {
            put(centres[i].face, i);
            for (const dvec3* corner : {&mCorners[i].a, &mCorners[i].b, &mCorners[i].c})
                box.include(*corner);
        }
        mNodes[self] = {box, first, count};
        return;
    }
    Box middles;
    for (std::uint32_t i = first; i < first + count; ++i) middles.include(centres[i].sum);
    const dvec3 edges = middles.max - middles.min;
    double dvec3::*const axis = edges.x >= edges.y && edges.x >= edges.z ? &dvec3::x
                                : edges.y >= edges.z                     ? &dvec3::y
                                                                         : &dvec3::z;
    const std::uint32_t half = count / 2;
    // By face where centres are equal, so that the order does not depend on the library.
    std::nth_element(centres.begin() + first, centres.begin() + first + half,
                     centres.begin() + first + count, [&](const Centre& a, const Centre& b) {
                         const double x = a.sum.*axis, y = b.sum.*axis;
                         return x != y ? x < y : a.face < b.face;
                     });
    const size_t left = self + 1, right = left + nodesOf(half);
    const auto buildLeft = [&] { build(left, first, half, centres); };
    const auto buildRight = [&] { build(right, first + half, count - half, centres); };
    constexpr std::uint32_t kWorth = 4096; // faces that a thread is worth
    if (count > kWorth)
        tbb::parallel_invoke(buildLeft, buildRight);
    else {
        buildLeft();
        buildRight();
    }
    Box box = mNodes[left].box;
    box.include(mNodes[right].box);
    mNodes[self] = {box, static_cast<std::uint32_t>(right), 0};
}

/// Visits the triangles of leaves whose boxes and those above `enter`; `look` takes a place in
/// order.
template<typename Enter, typename Look>
void TriangleTree::walk(const Enter& enter, const Look& look) const {
    std::array<std::uint32_t, kDeepest> open;
    size_t left = 0;
    if (!mNodes.empty()) open[left++] = 0;
    while (left > 0) {
        const std::uint32_t at = open[--left];
        const Node& node = mNodes[at];
        if (!enter(node.box)) continue;
        if (node.count == 0) {
            open[left++] = node.first;
            open[left++] = at + 1;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) look(i);
    }
}

TriangleTree::Nearest TriangleTree::nearest(const dvec3& x, double squaredBound,
                                            std::uint32_t hint) const {
    Nearest best{squaredBound};
    double distance = std::sqrt(squaredBound);
    const auto look = [&](std::uint32_t i) {
        const Corners& t = mCorners[i];
        const double reach = distance + t.radius;
        if (squared(x - t.middle) > reach * reach) return;
        const double found = squaredDistance(x, t.a, t.b, t.c);
        if (found >= best.squared) return;
        best = {found, mFaces[i]};
        distance = std::sqrt(found);
    };
    if (hint != kNone) look(mPlace[hint]);
    // The nearer child first, each with its distance, so that it is not asked for twice.
    struct Open {
        std::uint32_t node;
        double squared;
    };
    std::array<Open, kDeepest> open;
    size_t left = 0;
    if (!mNodes.empty()) open[left++] = {0, squaredDistanceToBox(x, mNodes[0].box)};
    while (left > 0) {
        const Open next = open[--left];
        if (next.squared >= best.squared) continue;
        const Node& node = mNodes[next.node];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) look(i);
        if (node.count > 0) continue;
        Open near{next.node + 1, squaredDistanceToBox(x, mNodes[next.node + 1].box)};
        Open far{node.first, squaredDistanceToBox(x, mNodes[node.first].box)};
        if (far.squared < near.squared) std::swap(near, far);
        if (far.squared < best.squared) open[left++] = far;
        if (near.squared < best.squared) open[left++] = near;
    }
    return best;
}

void TriangleTree::within(const dvec3& x, double radius, std::vector<std::uint32_t>& faces) const {
    placesWithin(x, radius, faces);
    for (std::uint32_t& face : faces) face = mFaces[face];
}

void TriangleTree::placesWithin(const dvec3& x, double radius,
                                std::vector<std::uint32_t>& places) const {
    places.clear();
    walk([&](const Box& box) { return squaredDistanceToBox(x, box) <= radius * radius; },
         [&](std::uint32_t i) {
             // Most are wholly within, or their ball is beyond.
             const Corners& t = mCorners[i];
             const double off = squared(x - t.middle), least = radius - t.radius,
                          most = radius + t.radius;
             if (off > most * most) return;
             if ((least > 0 && off <= least * least) ||
                 squaredDistance(x, t.a, t.b, t.c) <= radius * radius)
                 places.push_back(i);
         });
}

void TriangleTree::placesTouching(const Box& box, std::vector<std::uint32_t>& places) const {
    places.clear();
    walk([&](const Box& node) { return node.touches(box); },
         [&](std::uint32_t i) {
             const Corners& t = mCorners[i];
             const Box own{glm::min(glm::min(t.a, t.b), t.c), glm::max(glm::max(t.a, t.b), t.c)};
             if (own.touches(box)) places.push_back(i);
         });
}

void TriangleTree::hits(const dvec3& x, const dvec3& direction, double most,
                        std::vector<Hit>& hits) const {
    hits.clear();
    const dvec3 inverse = 1.0 / direction;
    const auto enter = [&](const Box& box) {
        double from = 0, to = most;
        for (int axis = 0; axis < 3; ++axis) {
            if (direction[axis] == 0) {
                if (x[axis] < box.min[axis] || x[axis] > box.max[axis]) return false;
                continue;
            }
            const double low = (box.min[axis] - x[axis]) * inverse[axis];
            const double high = (box.max[axis] - x[axis]) * inverse[axis];
            from = std::max(from, std::min(low, high));
            to = std::min(to, std::max(low, high));
        }
        // A box of no thickness must not be lost to the rounding of its two planes.
        return from <= to * (1 + 1e-14) + 1e-300;
    };
    walk(enter, [&](std::uint32_t i) {
        // Möller and Trumbore 1997.
        const Corners& t = mCorners[i];
        const dvec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(direction, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0) return;
        const dvec3 ax = x - t.a, q = glm::cross(ax, ab);
        const double u = glm::dot(ax, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double along = glm::dot(ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && along > 0 && along < most)
            hits.push_back({along, mFaces[i]});
    });
}

int TriangleTree::winding(const dvec3& x) const {
    // In no way aligned with what people draw, so that edges are missed.
    const dvec3 direction(0.5318207371, 0.6409718117, 0.5534091427);
    std::vector<Hit> found;
    hits(x, direction, std::numeric_limits<double>::max(), found);
    int sum = 0;
    for (const Hit& hit : found) {
        const Corners& t = mCorners[mPlace[hit.face]];
        sum += glm::dot(glm::cross(t.b - t.a, t.c - t.a), direction) > 0 ? 1 : -1;
    }
    return sum;
}

} // namespace eikonal::mesh
