// Exact geometric questions about single faces and pairs of them, answered by CGAL.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace eikonal::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using FaceBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

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

/// The faces worth comparing: with an area, and one of each set of duplicates.
std::vector<std::uint32_t> properFaces(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
        if (!isDegenerate(mesh, mesh.triangles[f])) faces.push_back(f);
    const auto key = [&](std::uint32_t f) {
        const glm::uvec3 s = sorted(mesh.triangles[f]);
        return std::make_tuple(s.x, s.y, s.z);
    };
    std::stable_sort(faces.begin(), faces.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    faces.erase(std::unique(faces.begin(), faces.end(),
                            [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); }),
                faces.end());
    std::sort(faces.begin(), faces.end());
    return faces;
}

struct EnoughFound {};

} // namespace

size_t countDegenerateFaces(const TriangleMesh& mesh) {
    return static_cast<size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const glm::uvec3& face) { return isDegenerate(mesh, face); }));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> intersectingPairs(const TriangleMesh& mesh,
                                                                       size_t most) {
    std::vector<FaceBox> boxes;
    for (std::uint32_t f : properFaces(mesh)) {
        const glm::uvec3& face = mesh.triangles[f];
        boxes.emplace_back(corner(mesh, face, 0).bbox() + corner(mesh, face, 1).bbox() +
                               corner(mesh, face, 2).bbox(),
                           f);
    }
    std::vector<const FaceBox*> pointers;
    for (const FaceBox& box : boxes) pointers.push_back(&box);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
    const auto compare = [&](const FaceBox* a, const FaceBox* b) {
        if (meetBeyondShared(mesh, mesh.triangles[a->info()], mesh.triangles[b->info()]))
            found.push_back(std::minmax(a->info(), b->info()));
        if (found.size() >= most) throw EnoughFound();
    };
    // Below this many boxes pairs are tried one by one; the value is that of
    // CGAL's own test for meshes.
    constexpr std::ptrdiff_t kCutoff = 2000;
    try {
        CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), compare, kCutoff);
    } catch (const EnoughFound&) {
        // The only way to leave the sweep early.
    }
    return found;
}

} // namespace eikonal::mesh
