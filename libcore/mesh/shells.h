// The shells of a mesh: faces joined by edges, how much each encloses, and which look inward.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vector>

namespace eikonal::mesh {

/// One side of a face, as the edge between points low < high.
struct FaceEdge {
    std::uint32_t low, high;
    std::uint32_t face;
    bool rising; ///< the face runs from low to high
};

/// The edges of all faces without a repeated corner, those between the same points side by side.
std::vector<FaceEdge> sortedEdges(const TriangleMesh& mesh);

/// The end of the run of `edges` that starts at `begin` and lies between the same two points.
size_t endOfEdge(const std::vector<FaceEdge>& edges, size_t begin);

/// Calls `act(begin, end)` for each run of edges between the same two points, in no order and on
/// several threads.
template<typename Act> void eachEdge(const std::vector<FaceEdge>& edges, const Act& act) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, edges.size(), 1024), [&](const auto& range) {
        size_t begin = range.begin();
        // What began before is another's.
        if (begin > 0) begin = std::max(begin, endOfEdge(edges, begin - 1));
        while (begin < range.end()) {
            const size_t end = endOfEdge(edges, begin);
            act(begin, end);
            begin = end;
        }
    });
}

/// Faces that reach each other through shared edges.
struct Shell {
    std::vector<std::uint32_t> faces;
    Box box;           ///< world space [unit]
    double area = 0;   ///< [unit²]
    double volume = 0; ///< signed [unit³]
    bool flat = false; ///< encloses nothing but what rounding leaves
};

/// The shells in the order of their first face; faces with a repeated corner belong to none.
std::vector<Shell> findShells(const TriangleMesh& mesh, const std::vector<FaceEdge>& edges);

/// How many other shells lie around each shell. Meant for closed ones that do not cross.
/// Shells whose `wanted` is 0 are skipped (0 is given).
std::vector<int> nestingDepths(const TriangleMesh& mesh, const std::vector<Shell>& shells,
                               const std::vector<char>& wanted);

/// For each shell of a closed mesh whether all of it lies within the solid, where the surface winds
/// around a point at least once: then it bounds nothing. Flat shells count as not.
std::vector<char> buriedShells(const TriangleMesh& mesh, const std::vector<Shell>& shells);

} // namespace eikonal::mesh
