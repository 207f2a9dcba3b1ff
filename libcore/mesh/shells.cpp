// The shells of a mesh: faces joined by edges, how much each encloses, and which look inward.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shells.h"

#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>
#include <tuple>

namespace eikonal::mesh {

namespace {

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

void measure(const TriangleMesh& mesh, Shell& shell) {
    for (std::uint32_t face : shell.faces)
        for (int k = 0; k < 3; ++k) shell.box.include(mesh.points[mesh.triangles[face][k]]);
    const glm::dvec3 centre = 0.5 * (shell.box.min + shell.box.max);
    for (std::uint32_t face : shell.faces) {
        const glm::uvec3& corners = mesh.triangles[face];
        const glm::dvec3 a = mesh.points[corners.x] - centre, b = mesh.points[corners.y] - centre,
                         c = mesh.points[corners.z] - centre;
        shell.volume += glm::dot(a, glm::cross(b, c)) / 6;
        shell.area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    // Far above the rounding of coordinates in a double, far below any plate one would voxelise:
    // a mean thickness of a billionth of the shell's size.
    shell.flat =
        std::abs(shell.volume) <= 1e-9 * shell.area * glm::length(shell.box.max - shell.box.min);
}

bool isAround(const TriangleMesh& mesh, const Shell& shell, const glm::dvec3& x) {
    double winding = 0;
    for (std::uint32_t face : shell.faces) {
        const glm::uvec3& corners = mesh.triangles[face];
        winding +=
            windingShare(mesh.points[corners.x], mesh.points[corners.y], mesh.points[corners.z], x);
    }
    return std::abs(winding) > 0.5;
}

} // namespace

std::vector<FaceEdge> sortedEdges(const TriangleMesh& mesh) {
    // By the low point they are counted out; the few that begin at one point are sorted.
    std::vector<size_t> ends(mesh.points.size() + 1, 0);
    const auto each = [&](const auto& act) {
        for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
            const glm::uvec3& face = mesh.triangles[f];
            if (hasRepeatedCorner(face)) continue;
            for (int k = 0; k < 3; ++k) act(face[k], face[(k + 1) % 3], f);
        }
    };
    each([&](std::uint32_t a, std::uint32_t b, std::uint32_t) { ++ends[std::min(a, b) + 1]; });
    for (size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    std::vector<FaceEdge> edges(ends.back());
    std::vector<size_t> next(ends.begin(), ends.end() - 1);
    each([&](std::uint32_t a, std::uint32_t b, std::uint32_t f) {
        edges[next[std::min(a, b)]++] = {std::min(a, b), std::max(a, b), f, a < b};
    });
    tbb::parallel_for(size_t{0}, mesh.points.size(), [&](size_t low) {
        std::sort(edges.data() + ends[low], edges.data() + ends[low + 1],
                  [](const FaceEdge& a, const FaceEdge& b) {
                      return std::tie(a.high, a.face) < std::tie(b.high, b.face);
                  });
    });
    return edges;
}

size_t endOfEdge(const std::vector<FaceEdge>& edges, size_t begin) {
    size_t end = begin;
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high)
        ++end;
    return end;
}

std::vector<Shell> findShells(const TriangleMesh& mesh, const std::vector<FaceEdge>& edges) {
    std::vector<std::uint32_t> parents(mesh.triangles.size());
    std::iota(parents.begin(), parents.end(), 0u);
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = endOfEdge(edges, begin);
        for (size_t i = begin + 1; i < end; ++i) {
            const std::uint32_t a = rootOf(parents, edges[begin].face);
            const std::uint32_t b = rootOf(parents, edges[i].face);
            parents[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<Shell> shells;
    std::vector<size_t> shellOf(mesh.triangles.size());
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        if (hasRepeatedCorner(mesh.triangles[f])) continue;
        const std::uint32_t root = rootOf(parents, f);
        if (root == f) {
            shellOf[f] = shells.size();
            shells.emplace_back();
        }
        shells[shellOf[root]].faces.push_back(f);
    }
    for (Shell& shell : shells) measure(mesh, shell);
    return shells;
}

std::vector<int> nestingDepths(const TriangleMesh& mesh, const std::vector<Shell>& shells,
                               const std::vector<char>& wanted) {
    std::vector<int> depths(shells.size(), 0);
    for (size_t i = 0; i < shells.size(); ++i) {
        if (!wanted[i]) continue;
        // A face's middle, not a corner: shells may touch at corners, where it is no question.
        const glm::uvec3& face = mesh.triangles[shells[i].faces.front()];
        const glm::dvec3 x =
            (mesh.points[face.x] + mesh.points[face.y] + mesh.points[face.z]) / 3.0;
        for (size_t j = 0; j < shells.size(); ++j)
            if (j != i && !shells[j].flat && shells[j].box.contains(x) &&
                isAround(mesh, shells[j], x))
                ++depths[i];
    }
    return depths;
}

std::vector<char> buriedShells(const TriangleMesh& mesh, const std::vector<Shell>& shells) {
    std::vector<char> buried(shells.size(), 0);
    if (shells.size() < 2) return buried;
    // Shells that don't cross have all of their faces on one side; of those that do, many lie so.
    constexpr size_t kSamples = 32;
    const Box box = boundingBox(mesh);
    const double skin = 1e-9 * glm::distance(box.min, box.max); // above rounding, below any gap
    const TriangleTree tree(mesh);
    for (size_t i = 0; i < shells.size(); ++i) {
        const std::vector<std::uint32_t>& faces = shells[i].faces;
        const size_t stride = std::max<size_t>(1, faces.size() / kSamples);
        bool within = !shells[i].flat;
        for (size_t k = 0; within && k < faces.size(); k += stride) {
            const glm::uvec3& face = mesh.triangles[faces[k]];
            const glm::dvec3 &a = mesh.points[face.x], &b = mesh.points[face.y],
                             &c = mesh.points[face.z];
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double length = glm::length(normal);
            if (!(length > 0)) continue;
            within = tree.winding((a + b + c) / 3.0 + skin / length * normal) > 0;
        }
        buried[i] = within;
    }
    return buried;
}

} // namespace eikonal::mesh
