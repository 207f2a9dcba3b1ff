// Exact geometric questions about single faces and pairs of them, answered by CGAL.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/intersections.h"

#include "mesh/triangle_tree.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cstdint>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tuple>
#include <utility>
#include <vector>

namespace eikonal::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point exact(const glm::dvec3& p) {
    return Point(p.x, p.y, p.z);
}

Point corner(const TriangleMesh& mesh, const glm::uvec3& face, int k) {
    return exact(mesh.points[face[k]]);
}

bool isDegenerate(const TriangleMesh& mesh, const glm::uvec3& face) {
    return hasRepeatedCorner(face) ||
           CGAL::collinear(corner(mesh, face, 0), corner(mesh, face, 1), corner(mesh, face, 2));
}

/// The corners in rising order, by which faces on the same three are recognised.
glm::uvec3 sorted(glm::uvec3 face) {
    if (face.x > face.y) std::swap(face.x, face.y);
    if (face.y > face.z) std::swap(face.y, face.z);
    if (face.x > face.y) std::swap(face.x, face.y);
    return face;
}

/// Rotates the face so that its corner k comes first.
glm::uvec3 startingAt(const glm::uvec3& face, int k) {
    return {face[k], face[(k + 1) % 3], face[(k + 2) % 3]};
}

/// Two faces on one edge overlap only if they lie in a plane, on the same side of that edge.
bool overlapAtEdge(const TriangleMesh& mesh, const glm::uvec3& f, const glm::uvec3& g) {
    const auto inG = [&](std::uint32_t p) { return p == g.x || p == g.y || p == g.z; };
    int apexF = 0;
    while (inG(f[apexF])) ++apexF;
    const glm::uvec3 turned = startingAt(f, apexF);
    const std::uint32_t apexG = g.x + g.y + g.z - turned.y - turned.z;
    const Point a = exact(mesh.points[turned.y]), b = exact(mesh.points[turned.z]);
    const Point p = exact(mesh.points[turned.x]), q = exact(mesh.points[apexG]);
    return CGAL::coplanar(a, b, p, q) && CGAL::coplanar_orientation(a, b, p, q) == CGAL::POSITIVE;
}

/// Two faces that share corner i of f, which is corner j of g: the sides opposite decide.
bool meetBeyondCorner(const TriangleMesh& mesh, const glm::uvec3& f, int i, const glm::uvec3& g,
                      int j) {
    const glm::uvec3 F = startingAt(f, i), G = startingAt(g, j);
    const Kernel::Triangle_3 triangleF(corner(mesh, F, 0), corner(mesh, F, 1), corner(mesh, F, 2));
    const Kernel::Triangle_3 triangleG(corner(mesh, G, 0), corner(mesh, G, 1), corner(mesh, G, 2));
    return CGAL::do_intersect(triangleF, Kernel::Segment_3(triangleG[1], triangleG[2])) ||
           CGAL::do_intersect(triangleG, Kernel::Segment_3(triangleF[1], triangleF[2]));
}

bool meetBeyondShared(const TriangleMesh& mesh, const glm::uvec3& f, const glm::uvec3& g) {
    int shared = 0, cornerF = 0, cornerG = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (f[i] == g[j]) {
                ++shared;
                cornerF = i;
                cornerG = j;
            }
    if (shared == 2) return overlapAtEdge(mesh, f, g);
    if (shared == 1) return meetBeyondCorner(mesh, f, cornerF, g, cornerG);
    return CGAL::do_intersect(
        Kernel::Triangle_3(corner(mesh, f, 0), corner(mesh, f, 1), corner(mesh, f, 2)),
        Kernel::Triangle_3(corner(mesh, g, 0), corner(mesh, g, 1), corner(mesh, g, 2)));
}

/// Which faces are worth comparing: with an area, and the first of each set of duplicates.
std::vector<char> properFaces(const TriangleMesh& mesh) {
    struct Keyed {
        glm::uvec3 corners;
        std::uint32_t face;
    };
    const auto key = [](const Keyed& k) {
        return std::tie(k.corners.x, k.corners.y, k.corners.z, k.face);
    };
    std::vector<char> proper(mesh.triangles.size());
    std::vector<Keyed> faces(proper.size());
    tbb::parallel_for(0u, static_cast<std::uint32_t>(faces.size()), [&](std::uint32_t f) {
        proper[f] = !isDegenerate(mesh, mesh.triangles[f]);
        faces[f] = {sorted(mesh.triangles[f]), f};
    });
    tbb::parallel_sort(faces.begin(), faces.end(),
                       [&](const Keyed& a, const Keyed& b) { return key(a) < key(b); });
    for (size_t i = 1; i < faces.size(); ++i)
        if (faces[i].corners == faces[i - 1].corners) proper[faces[i].face] = false;
    return proper;
}

Box boxOf(const TriangleMesh& mesh, const glm::uvec3& face) {
    Box box;
    for (int k = 0; k < 3; ++k) box.include(mesh.points[face[k]]);
    return box;
}

} // namespace

size_t countDegenerateFaces(const TriangleMesh& mesh) {
    return static_cast<size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const glm::uvec3& face) { return isDegenerate(mesh, face); }));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> intersectingPairs(const TriangleMesh& mesh,
                                                                       size_t most) {
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    const std::vector<char> proper = properFaces(mesh);
    const TriangleTree tree(mesh);
    const std::vector<std::uint32_t>& order = tree.order();
    // By places in that order, so that what lies together is looked at together.
    struct Placed {
        Box box;
        glm::uvec3 corners;
        bool proper;
    };
    std::vector<Placed> faces(order.size());
    tbb::parallel_for(size_t{0}, faces.size(), [&](size_t i) {
        const glm::uvec3& corners = mesh.triangles[order[i]];
        faces[i] = {boxOf(mesh, corners), corners, proper[order[i]] != 0};
    });
    // The pairs, of which the lower place is among some.
    const auto addPairs = [&](size_t begin, size_t end, std::vector<std::uint32_t>& near,
                              Pairs& pairs) {
        Box all;
        for (size_t i = begin; i < end; ++i) all.include(faces[i].box);
        tree.placesTouching(all, near);
        for (size_t i = begin; i < end; ++i) {
            const Placed& f = faces[i];
            if (!f.proper || pairs.size() >= most) continue;
            for (const std::uint32_t j : near)
                if (const Placed& g = faces[j]; j > i && g.proper && f.box.touches(g.box) &&
                                                meetBeyondShared(mesh, f.corners, g.corners))
                    pairs.push_back(std::minmax(order[i], order[j]));
        }
    };
    // By parts, so that a mesh which crosses itself everywhere is soon known to.
    constexpr size_t kPart = 1 << 14, kPiece = 256, kTogether = 8;
    Pairs found;
    for (size_t part = 0; part < faces.size() && found.size() < most; part += kPart) {
        const size_t end = std::min(part + kPart, faces.size());
        std::vector<Pairs> pieces((end - part + kPiece - 1) / kPiece);
        tbb::parallel_for(size_t{0}, pieces.size(), [&](size_t i) {
            const size_t first = part + kPiece * i, last = std::min(first + kPiece, end);
            std::vector<std::uint32_t> near;
            for (size_t k = first; k < last && pieces[i].size() < most; k += kTogether)
                addPairs(k, std::min(k + kTogether, last), near, pieces[i]);
        });
        for (const Pairs& pairs : pieces) found.insert(found.end(), pairs.begin(), pairs.end());
    }
    std::sort(found.begin(), found.end());
    found.resize(std::min(found.size(), most));
    return found;
}

} // namespace eikonal::mesh
