// Makes one of points that only rounding holds apart.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.h"

#include "mesh/shells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace eikonal::mesh {

namespace {

using glm::dvec3;

struct OpenPoints {
    size_t edges = 0;
    std::vector<char> open;    ///< for each point, whether such an edge ends there
    std::vector<double> reach; ///< how far each may move [unit]
};

OpenPoints openPointsOf(const TriangleMesh& mesh) {
    OpenPoints found;
    found.open.assign(mesh.points.size(), 0);
    found.reach.assign(mesh.points.size(), std::numeric_limits<double>::max());
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = endOfEdge(edges, begin);
        const FaceEdge& edge = edges[begin];
        const double quarter = glm::distance(mesh.points[edge.low], mesh.points[edge.high]) / 4;
        for (const std::uint32_t point : {edge.low, edge.high})
            found.reach[point] = std::min(found.reach[point], quarter);
        if (end - begin > 1) continue;
        ++found.edges;
        found.open[edge.low] = found.open[edge.high] = 1;
    }
    return found;
}

/// Points by cells as wide as the tolerance: whatever is near lies in one of 27 of them.
class Cells {
public:
    Cells(const dvec3& low, double width) : mLow(low), mWidth(width) {}

    void add(std::uint32_t point, const dvec3& x) { mCells[keyOf(cellOf(x))].push_back(point); }

    template<typename Visit> void near(const dvec3& x, const Visit& visit) const {
        const Cell middle = cellOf(x);
        for (int i = 0; i < 27; ++i) {
            const Cell cell = {middle.x + i % 3 - 1, middle.y + i / 3 % 3 - 1,
                               middle.z + i / 9 - 1};
            const auto found = mCells.find(keyOf(cell));
            if (found == mCells.end()) continue;
            for (const std::uint32_t point : found->second) visit(point);
        }
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cellOf(const dvec3& x) const {
        const dvec3 c = glm::floor((x - mLow) / mWidth);
        return {static_cast<std::int64_t>(c.x), static_cast<std::int64_t>(c.y),
                static_cast<std::int64_t>(c.z)};
    }
    /// Cells may share a key: then both are looked through.
    static std::uint64_t keyOf(const Cell& cell) {
        std::uint64_t key = 0;
        for (const std::int64_t part : {cell.x, cell.y, cell.z})
            key = (key ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
        return key;
    }

    dvec3 mLow;
    double mWidth;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> mCells;
};

TriangleMesh welded(const TriangleMesh& mesh, const OpenPoints& points, const dvec3& low,
                    double tolerance) {
    Cells kept(low, tolerance);
    std::vector<std::uint32_t> stands(mesh.points.size());
    for (std::uint32_t i = 0; i < stands.size(); ++i) {
        stands[i] = i;
        if (!points.open[i]) continue;
        double nearest = std::min(tolerance, points.reach[i]);
        kept.near(mesh.points[i], [&](std::uint32_t other) {
            const double apart = glm::distance(mesh.points[i], mesh.points[other]);
            if (apart > nearest || apart > points.reach[other]) return;
            if (apart == nearest && stands[i] != i && stands[i] < other) return;
            nearest = apart;
            stands[i] = other;
        });
        if (stands[i] == i) kept.add(i, mesh.points[i]);
    }
    TriangleMesh result = mesh;
    for (glm::uvec3& face : result.triangles)
        for (int k = 0; k < 3; ++k) face[k] = stands[face[k]];
    return result;
}

} // namespace

Weld weldNearPoints(TriangleMesh& mesh) {
    const Box box = boundingBox(mesh);
    const double diagonal = glm::distance(box.min, box.max);
    const OpenPoints points = openPointsOf(mesh);
    Weld done;
    TriangleMesh best;
    size_t fewest = points.edges;
    for (const double share : {1e-9, 1e-8, 1e-7, 1e-6, kWidestWeld}) {
        if (fewest == 0 || !(diagonal > 0) || !std::isfinite(diagonal)) break;
        TriangleMesh tried = welded(mesh, points, box.min, share * diagonal);
        const size_t open = openPointsOf(tried).edges;
        if (open >= fewest) continue;
        fewest = open;
        done.tolerance = share * diagonal;
        best = std::move(tried);
    }
    if (best.triangles.empty()) return {};
    mesh = std::move(best);
    done.points = dropUnusedPoints(mesh);
    return done;
}

} // namespace eikonal::mesh
