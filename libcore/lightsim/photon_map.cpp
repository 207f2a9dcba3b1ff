// How a light sees the domain: the windows of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/photon_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

namespace eikonal::lightsim {

using glm::dvec2;
using glm::dvec3;

namespace {

/// An orthonormal view along `forward`, upright by `reference`: right × up points back at the
/// light, so triangles that face it are drawn counterclockwise.
void aim(Window& window, const dvec3& forward, const dvec3& reference) {
    window.forward = forward;
    window.right = glm::normalize(glm::cross(forward, reference));
    window.up = glm::cross(window.right, forward);
}

/// The axis least along a view: it gives the best conditioned frame.
dvec3 referenceFor(const dvec3& forward) {
    const dvec3 a = glm::abs(forward);
    return a.y <= a.x && a.y <= a.z ? dvec3(0, 1, 0) : a.x <= a.z ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
}

std::array<dvec3, 8> cornersOf(const VoxelBox& box) {
    std::array<dvec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[static_cast<size_t>(i)] = {i & 1 ? box.high.x : box.low.x,
                                           i & 2 ? box.high.y : box.low.y,
                                           i & 4 ? box.high.z : box.low.z};
    return corners;
}

struct Bounds {
    dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
    void include(const dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool empty() const { return !(low.x < high.x && low.y < high.y); }
};

/// p relative to the window's frame: right, up, forward.
dvec3 inView(const Window& window, const dvec3& p) {
    const dvec3 q = p - window.origin;
    return {glm::dot(q, window.right), glm::dot(q, window.up), glm::dot(q, window.forward)};
}

/// Clips a polygon by the half space dot(normal, p) >= offset (Sutherland and Hodgman 1974).
std::vector<dvec3> clip(const std::vector<dvec3>& polygon, const dvec3& normal, double offset) {
    std::vector<dvec3> out;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(normal, a) - offset, db = glm::dot(normal, b) - offset;
        if (da >= 0) out.push_back(a);
        if ((da >= 0) != (db >= 0)) out.push_back(a + (b - a) * (da / (da - db)));
    }
    return out;
}

/// Half spaces, in the window's frame, that hold all directions into which the source shines.
std::vector<dvec3> shineOf(const Window& window) {
    const Source& source = window.source;
    const auto turned = [&](const dvec3& p) {
        return dvec3(glm::dot(p, window.right), glm::dot(p, window.up),
                     glm::dot(p, window.forward));
    };
    const bool isCone = source.spread == Source::Spread::cone && source.outer < 0.5 * M_PI;
    if (source.spread == Source::Spread::cosine) return {turned(source.axis)};
    if (!isCone) return {};
    // A pyramid round the cone.
    Window frame;
    aim(frame, source.axis, referenceFor(source.axis));
    const dvec3 along = std::sin(source.outer) * source.axis;
    const double across = std::cos(source.outer);
    return {turned(along + across * frame.right), turned(along - across * frame.right),
            turned(along + across * frame.up), turned(along - across * frame.up)};
}

/// The tangents under which the box is seen within 45° of the view's axis, and its depth range.
Bounds boundsInFace(const Window& window, const VoxelBox& box, double least) {
    const std::vector<dvec3> sides = shineOf(window);
    const auto corners = cornersOf(box);
    const int faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                             {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    Bounds bounds;
    for (const auto& face : faces) {
        std::vector<dvec3> polygon;
        for (int corner : face)
            polygon.push_back(inView(window, corners[static_cast<size_t>(corner)]));
        for (const dvec3& side : {dvec3(1, 0, 1), dvec3(-1, 0, 1), dvec3(0, 1, 1), dvec3(0, -1, 1)})
            polygon = clip(polygon, side, 0);
        polygon = clip(polygon, {0, 0, 1}, least);
        for (const dvec3& side : sides) polygon = clip(polygon, side, 0);
        for (const dvec3& p : polygon) bounds.include({p.x / p.z, p.y / p.z, p.z});
    }
    return bounds;
}

/// Lays pixels of edge `pixel` over the bounds, one more than needed, so that a shift by part of a
/// pixel still covers them.
void layPixels(Window& window, const Bounds& bounds, const dvec2& pixel, const dvec2& shift) {
    const dvec2 extent(bounds.high - bounds.low);
    // Rounding must not add a row to extents that are a whole number of pixels.
    window.pixels = glm::max(glm::ivec2(glm::ceil(extent / pixel - 1e-9)) + 1, glm::ivec2(1));
    window.extent = dvec2(window.pixels) * pixel;
    window.low = dvec2(bounds.low) - shift * pixel;
}

/// Edge of a pixel of a map of that area, if one of edge 1 voxel there were `voxel`.
double pixelOf(const MapDetail& detail, double area, double voxel) {
    const double edge = detail.edge * voxel;
    const double wanted = detail.pixels > 0
                              ? static_cast<double>(detail.pixels)
                              : std::min(area / (edge * edge), static_cast<double>(detail.most));
    return std::sqrt(area / wanted);
}

std::vector<Window> parallelWindow(const Source& source, const VoxelBox& target,
                                   const MapDetail& detail, const dvec2& shift) {
    Window window;
    window.source = source;
    const dvec3 forward = glm::normalize(source.vector);
    aim(window, forward, referenceFor(forward));
    Bounds bounds;
    for (const dvec3& corner : cornersOf(target)) bounds.include(inView(window, corner));
    const dvec3 extent = bounds.high - bounds.low;
    const double pixel = pixelOf(detail, extent.x * extent.y, 1);
    // Along an axis of the voxels a whole number of photons crosses each of them: 10 and 11 by
    // turns would show as bands.
    const auto edgeAlong = [pixel](const dvec3& side) {
        const dvec3 a = glm::abs(side);
        const bool alongAxis = std::max({a.x, a.y, a.z}) > 1 - 1e-6;
        return alongAxis && pixel < 1 ? 1 / std::round(1 / pixel) : pixel;
    };
    layPixels(window, bounds, {edgeAlong(window.right), edgeAlong(window.up)}, shift);
    // A margin keeps the box's own faces off the clipping planes.
    window.near = bounds.low.z - 1;
    window.far = bounds.high.z + 1;
    return {window};
}

std::vector<Window> cubeWindows(const Source& source, const VoxelBox& target,
                                const VoxelBox& domain, const MapDetail& detail, bool hasProxy) {
    const dvec3 centre = 0.5 * (target.low + target.high);
    const double size = glm::length(target.high - target.low);
    Window front;
    front.point = true;
    front.source = source;
    front.origin = source.vector;
    const dvec3 towards = centre - source.vector;
    const double distance = glm::length(towards);
    const double least = 1e-5 * (distance + size);
    // Nearer to a face than the near plane the map would not see that face.
    front.startsAtLight = !hasProxy && domain.contains(source.vector, least);
    // From outside, the cube's front face looks at the target, which then mostly fits that face; a
    // cone's looks along it.
    const dvec3 ahead = distance > 1e-9 * size ? towards / distance : dvec3(0, 0, 1);
    const dvec3 forward = source.spread == Source::Spread::cone ? source.axis : ahead;
    aim(front, forward, referenceFor(forward));

    std::vector<Window> windows;
    std::vector<Bounds> bounds;
    double area = 0;
    const dvec3 axes[6] = {front.forward, -front.forward, front.right,
                           -front.right,  front.up,       -front.up};
    for (const dvec3& axis : axes) {
        Window window = front;
        // Upright by an axis of the cube, or its faces would not meet at its edges.
        const bool alongUp = axis == front.up || axis == -front.up;
        aim(window, axis, alongUp ? front.forward : front.up);
        const Bounds seen = boundsInFace(window, target, least);
        if (seen.empty()) continue;
        window.near = std::max(seen.low.z * 0.999, least);
        window.far = seen.high.z * 1.001;
        windows.push_back(window);
        bounds.push_back(seen);
        area += (seen.high.x - seen.low.x) * (seen.high.y - seen.low.y);
    }
    // From within, the target is about a quarter of its diagonal away.
    const double pixel = pixelOf(detail, area, 1 / std::max(distance, 0.25 * size));
    for (size_t i = 0; i < windows.size(); ++i) {
        // Whole pixels and no shift: across a seam of the cube every direction is covered once.
        windows[i].low = dvec2(bounds[i].low);
        windows[i].extent = dvec2(bounds[i].high - bounds[i].low);
        windows[i].pixels = glm::max(glm::ivec2(glm::ceil(windows[i].extent / pixel)), 1);
    }
    return windows;
}

} // namespace

bool VoxelBox::contains(const dvec3& p, double margin) const {
    return glm::all(glm::greaterThan(p, low - margin)) && glm::all(glm::lessThan(p, high + margin));
}

double Window::pixelArea() const {
    return extent.x / pixels.x * (extent.y / pixels.y);
}

Window Window::batch(int i, int j, int b) const {
    Window part = *this;
    part.pixels = (pixels - glm::ivec2(i, j) + b - 1) / b;
    const dvec2 pixel = extent / dvec2(pixels);
    part.extent = pixel * dvec2(part.pixels * b);
    part.low = low + pixel * (dvec2(i, j) + 0.5 - 0.5 * b);
    return part;
}

std::optional<glm::dvec4> Window::rectangleOf(const VoxelBox& box) const {
    Bounds bounds;
    for (const dvec3& corner : cornersOf(box)) {
        const dvec3 p = inView(*this, corner);
        if (point && p.z <= 1e-3 * glm::length(p)) return std::nullopt;
        bounds.include(point ? dvec3(p.x / p.z, p.y / p.z, p.z) : p);
    }
    return glm::dvec4(bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y);
}

glm::dmat4 Window::clipFromVoxel() const {
    glm::dmat4 viewFromVoxel(1.0);
    for (int c = 0; c < 3; ++c) {
        viewFromVoxel[c][0] = right[c];
        viewFromVoxel[c][1] = up[c];
        viewFromVoxel[c][2] = forward[c];
    }
    viewFromVoxel[3] = glm::dvec4(-glm::dot(right, origin), -glm::dot(up, origin),
                                  -glm::dot(forward, origin), 1.0);
    glm::dmat4 clipFromView(0.0);
    const dvec2 scale = 2.0 / extent, offset = -1.0 - 2.0 * low / extent;
    clipFromView[0][0] = scale.x;
    clipFromView[1][1] = scale.y;
    if (point) {
        clipFromView[2] = glm::dvec4(offset.x, offset.y, (far + near) / (far - near), 1.0);
        clipFromView[3][2] = -2.0 * far * near / (far - near);
    } else {
        clipFromView[2][2] = 2.0 / (far - near);
        clipFromView[3] = glm::dvec4(offset.x, offset.y, -(far + near) / (far - near), 1.0);
    }
    return clipFromView * viewFromVoxel;
}

std::vector<Window> windowsOf(const Source& source, const VoxelBox& target, const VoxelBox& domain,
                              const MapDetail& detail, const dvec2& shift, bool hasProxy) {
    return source.isPoint() ? cubeWindows(source, target, domain, detail, hasProxy)
                            : parallelWindow(source, target, detail, shift);
}

} // namespace eikonal::lightsim
