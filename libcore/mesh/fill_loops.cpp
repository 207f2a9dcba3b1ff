// Plane outlines filled with triangles: letters, with their holes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fill_loops.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <cmath>

namespace eikonal::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;

constexpr int kUnseen = -1;

/// How often the loops wind around x, anticlockwise positive.
int windingOf(const std::vector<std::vector<glm::dvec2>>& loops, const glm::dvec2& x) {
    int winding = 0;
    for (const std::vector<glm::dvec2>& loop : loops)
        for (size_t i = 0; i < loop.size(); ++i) {
            const glm::dvec2 a = loop[i] - x, b = loop[(i + 1) % loop.size()] - x;
            if ((a.y <= 0) == (b.y <= 0)) continue;
            const bool left = a.x * b.y - a.y * b.x > 0;
            if (a.y <= 0 && left) ++winding;
            if (a.y > 0 && !left) --winding;
        }
    return winding;
}

/// The faces that reach `start` without crossing an outline.
std::vector<Face> patchAt(const Triangulation& all, Face start, int label) {
    std::vector<Face> patch = {start};
    start->info() = label;
    for (size_t next = 0; next < patch.size(); ++next)
        for (int side = 0; side < 3; ++side) {
            const Face beyond = patch[next]->neighbor(side);
            if (beyond->info() != kUnseen || all.is_infinite(beyond) ||
                patch[next]->is_constrained(side))
                continue;
            beyond->info() = label;
            patch.push_back(beyond);
        }
    return patch;
}

/// Inside or not is asked at the patch's largest face, whose middle rounding can't put beyond it.
bool isInside(const Triangulation& all, const std::vector<Face>& patch,
              const std::vector<std::vector<glm::dvec2>>& loops) {
    Face largest = patch.front();
    for (const Face face : patch)
        if (all.triangle(face).area() > all.triangle(largest).area()) largest = face;
    glm::dvec2 middle(0);
    for (int k = 0; k < 3; ++k)
        middle +=
            glm::dvec2(largest->vertex(k)->point().x(), largest->vertex(k)->point().y()) / 3.0;
    return windingOf(loops, middle) != 0;
}

} // namespace

FilledLoops fillLoops(const std::vector<std::vector<glm::dvec2>>& loops) {
    Triangulation all;
    for (const std::vector<glm::dvec2>& loop : loops) {
        std::vector<Kernel::Point_2> points;
        for (const glm::dvec2& p : loop) points.emplace_back(p.x, p.y);
        if (points.size() > 2) all.insert_constraint(points.begin(), points.end(), true);
    }
    for (const Face face : all.all_face_handles()) face->info() = kUnseen;
    std::vector<char> inside; // of each patch
    for (const Face face : all.finite_face_handles()) {
        if (face->info() != kUnseen) continue;
        const std::vector<Face> patch = patchAt(all, face, static_cast<int>(inside.size()));
        inside.push_back(isInside(all, patch, loops));
    }
    FilledLoops filled;
    for (const auto vertex : all.finite_vertex_handles()) vertex->info() = kUnseen;
    const auto indexOf = [&](const Triangulation::Vertex_handle vertex) {
        if (vertex->info() == kUnseen) {
            vertex->info() = static_cast<int>(filled.points.size());
            filled.points.emplace_back(vertex->point().x(), vertex->point().y());
        }
        return static_cast<std::uint32_t>(vertex->info());
    };
    const auto isSolid = [&](const Face face) {
        return !all.is_infinite(face) && inside[static_cast<size_t>(face->info())];
    };
    for (const Face face : all.finite_face_handles()) {
        if (!isSolid(face)) continue;
        glm::uvec3 corners;
        for (int k = 0; k < 3; ++k) corners[k] = indexOf(face->vertex(k));
        filled.triangles.push_back(corners);
        for (int k = 0; k < 3; ++k)
            if (!isSolid(face->neighbor(k)))
                filled.sides.emplace_back(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    }
    return filled;
}

} // namespace eikonal::mesh
