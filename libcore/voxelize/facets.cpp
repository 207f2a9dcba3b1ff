// A mesh's triangles in the sub-samples of a lattice, ready to be drawn.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/facets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eikonal::voxelize {

namespace {

// OpenGL asks for at least 8 bits behind the point of a pixel coordinate. Corners that need no
// more than that are where we say on every device, so that every device gives the same voxels.
constexpr double kPixelParts = 256;

double snapped(double x) {
    return std::round(x * kPixelParts) / kPixelParts;
}

// A triangle cut by four lines has at most seven corners.
struct Polygon {
    std::array<glm::dvec3, 8> corners;
    int count = 0;

    void add(const glm::dvec3& corner) { corners[static_cast<size_t>(count++)] = corner; }
};

bool lexicallyLess(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Where a side crosses `limit` on an axis: the same point whichever way the side is run, so that
/// the neighbour beyond it gets the same corner and no crack opens.
glm::dvec3 cutSide(glm::dvec3 a, glm::dvec3 b, int axis, double limit) {
    if (lexicallyLess(b, a)) std::swap(a, b);
    glm::dvec3 cut = a + (b - a) * ((limit - a[axis]) / (b[axis] - a[axis]));
    cut[axis] = limit;
    return cut;
}

/// The part of the polygon on the low (or high) side of `limit`.
Polygon cutAt(const Polygon& in, int axis, double limit, bool keepLow) {
    Polygon out;
    for (int i = 0; i < in.count; ++i) {
        const glm::dvec3& a = in.corners[static_cast<size_t>(i)];
        const glm::dvec3& b = in.corners[static_cast<size_t>((i + 1) % in.count)];
        const bool keepsA = keepLow ? a[axis] <= limit : a[axis] >= limit;
        const bool keepsB = keepLow ? b[axis] <= limit : b[axis] >= limit;
        if (keepsA) out.add(a);
        if (keepsA != keepsB) out.add(cutSide(a, b, axis, limit));
    }
    return out;
}

} // namespace

FacetSource::FacetSource(const mesh::TriangleMesh& mesh, const Lattice& lattice)
    : mMesh(mesh), mView(lattice.view()),
      // One beyond the last sample: as far behind the domain as depths need to be told apart.
      mDeepest(lattice.size.z * lattice.supersample + 1), mSupersample(lattice.supersample) {
    mPoints.reserve(mesh.points.size());
    const double samplesPerUnit = lattice.supersample / lattice.voxelSize;
    for (const glm::dvec3& point : mesh.points) {
        const glm::dvec3 p = (point - lattice.low) * samplesPerUnit;
        mPoints.emplace_back(snapped(p.x), snapped(p.y), p.z);
    }
    mRows.reserve(mesh.triangles.size());
    for (const glm::uvec3& face : mesh.triangles) {
        const auto rows = std::minmax({mPoints[face.x].y, mPoints[face.y].y, mPoints[face.z].y});
        mRows.push_back({rows.first, rows.second});
    }
}

void FacetSource::seek(int firstRow, int rows) {
    mFrom = firstRow * mSupersample;
    mTo = mFrom + rows * mSupersample;
    mNext = 0;
}

void FacetSource::next(std::vector<Facet>& facets, size_t count) {
    facets.clear();
    for (; mNext < mMesh.triangles.size() && facets.size() < count; ++mNext) {
        if (mRows[mNext].high < mFrom || mRows[mNext].low > mTo) continue;
        const glm::uvec3& face = mMesh.triangles[mNext];
        const glm::dvec3 corners[3] = {mPoints[face.x], mPoints[face.y], mPoints[face.z]};
        const glm::dvec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
        const glm::dvec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
        if (high.x < 0 || low.x > mView) continue;
        if (low.x < 0 || low.y < 0 || high.x > mView || high.y > mView)
            addClipped(corners, facets);
        else
            addFacet(corners[0], corners[1], corners[2], facets);
    }
}

/// Cuts what reaches beyond the view, which OpenGL would clip by itself, at corners of its own.
void FacetSource::addClipped(const glm::dvec3* corners, std::vector<Facet>& facets) const {
    Polygon polygon;
    for (int i = 0; i < 3; ++i) polygon.add(corners[i]);
    for (int axis : {0, 1}) {
        polygon = cutAt(polygon, axis, 0, false);
        polygon = cutAt(polygon, axis, mView, true);
    }
    for (int i = 0; i < polygon.count; ++i) {
        glm::dvec3& corner = polygon.corners[static_cast<size_t>(i)];
        corner.x = snapped(corner.x);
        corner.y = snapped(corner.y);
    }
    for (int i = 2; i < polygon.count; ++i)
        addFacet(polygon.corners[0], polygon.corners[static_cast<size_t>(i - 1)],
                 polygon.corners[static_cast<size_t>(i)], facets);
}

void FacetSource::addFacet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           std::vector<Facet>& facets) const {
    const glm::dvec3 ab = b - a, ac = c - a;
    // Exact: products of multiples of 1/256 up to 2^14.
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0) return; // seen edge-on: no column passes through it
    const double riseX = (ab.z * ac.y - ac.z * ab.y) / area;
    const double riseY = (ac.z * ab.x - ab.z * ac.x) / area;
    const double least = std::clamp(std::min({a.z, b.z, c.z}), -1.0, mDeepest);
    const double most = std::clamp(std::max({a.z, b.z, c.z}), -1.0, mDeepest);
    Facet facet;
    facet.corners = vec4(a.x, a.y, b.x, b.y);
    facet.rest = vec4(c.x, c.y, riseX, riseY);
    // An outward face anticlockwise in x, y looks along +z, where the axis leaves.
    facet.depth = vec4(a.z, least, most, area > 0 ? -1 : 1);
    facets.push_back(facet);
}

} // namespace eikonal::voxelize
