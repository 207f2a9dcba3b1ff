// Makes of a damaged mesh one that bounds a volume, and says what it did.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair.h"

#include "base/text.h"
#include "mesh/check.h"
#include "mesh/shells.h"
#include "mesh/weld.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>

namespace eikonal::mesh {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

std::string counted(size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void say(std::vector<std::string>& actions, size_t count, const std::string& verb,
         const std::string& noun, const std::string& rest) {
    if (count > 0) actions.push_back(verb + " " + counted(count, noun) + rest);
}

/// Drops the faces that are no triangles or were there before.
void dropIdleFaces(TriangleMesh& mesh, std::vector<std::string>& actions) {
    std::set<std::array<std::uint32_t, 3>> seen;
    TriangleMesh kept;
    size_t degenerate = 0, duplicate = 0;
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const glm::uvec3& face = mesh.triangles[f];
        std::array<std::uint32_t, 3> key = {face.x, face.y, face.z};
        std::sort(key.begin(), key.end());
        if (hasRepeatedCorner(face))
            ++degenerate;
        else if (!seen.insert(key).second)
            ++duplicate;
        else {
            kept.triangles.push_back(face);
            if (!mesh.normals.empty()) kept.normals.push_back(mesh.normals[f]);
        }
    }
    mesh.triangles = std::move(kept.triangles);
    mesh.normals = std::move(kept.normals);
    say(actions, degenerate, "dropped", "triangle", " with a repeated corner");
    say(actions, duplicate, "dropped", "triangle", " given twice");
}

void weld(TriangleMesh& mesh, std::vector<std::string>& actions) {
    const Weld done = weldNearPoints(mesh);
    if (done.points == 0) return;
    say(actions, done.points, "merged", "point",
        " within " + toText(static_cast<float>(done.tolerance)) + " of another");
    dropIdleFaces(mesh, actions);
}

/// Counts what CGAL does to the soup.
struct OrientationCount : PMP::Default_orientation_visitor {
    size_t *turned, *cut;
    OrientationCount(size_t* t, size_t* c) : turned(t), cut(c) {}
    void polygon_orientation_reversed(std::size_t) { ++*turned; }
    void duplicated_vertex(std::size_t, std::size_t) { ++*cut; }
};

/// `turned` counts the faces that were.
Surface orientedSurface(const TriangleMesh& mesh, std::vector<std::string>& actions,
                        size_t& turned) {
    std::vector<Point> points;
    for (const glm::dvec3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::vector<std::size_t>> faces;
    for (const glm::uvec3& face : mesh.triangles) faces.push_back({face.x, face.y, face.z});
    size_t cut = 0;
    PMP::orient_polygon_soup(points, faces,
                             CGAL::parameters::visitor(OrientationCount(&turned, &cut)));
    say(actions, turned, "turned", "triangle", " to agree with the neighbours");
    say(actions, cut, "cut the surface at", "point", " where several sheets met");
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points, faces, surface);
    return surface;
}

size_t fillHole(Surface& surface, Surface::Halfedge_index border) {
    // The optimal filling takes cubic time in the length of the rim: a second at 500 edges.
    constexpr size_t kLongRim = 500;
    size_t rim = 0;
    for (Surface::Halfedge_index h : CGAL::halfedges_around_face(border, surface)) {
        static_cast<void>(h);
        ++rim;
    }
    std::vector<Surface::Face_index> faces;
    PMP::triangulate_hole(surface, border, std::back_inserter(faces),
                          CGAL::parameters::do_not_use_cubic_algorithm(rim > kLongRim));
    if (!faces.empty()) return faces.size();
    // A fan around the rim's middle always closes, if less prettily.
    CGAL::Vector_3<Kernel> sum(0, 0, 0);
    for (Surface::Vertex_index v : CGAL::vertices_around_face(border, surface))
        sum += surface.point(v) - CGAL::ORIGIN;
    CGAL::Euler::fill_hole(border, surface);
    const Surface::Halfedge_index centre = CGAL::Euler::add_center_vertex(border, surface);
    surface.point(surface.target(centre)) = CGAL::ORIGIN + sum / static_cast<double>(rim);
    return rim;
}

void closeSurface(Surface& surface, std::vector<std::string>& actions) {
    say(actions, PMP::stitch_borders(surface), "stitched", "pair", " of open edges");
    std::vector<Surface::Halfedge_index> borders;
    PMP::extract_boundary_cycles(surface, std::back_inserter(borders));
    size_t added = 0;
    for (Surface::Halfedge_index border : borders) added += fillHole(surface, border);
    say(actions, borders.size(), "filled", "hole", " with " + counted(added, "triangle"));
}

TriangleMesh fromSurface(Surface& surface) {
    surface.collect_garbage();
    TriangleMesh mesh;
    for (Surface::Vertex_index v : surface.vertices()) {
        const Point& p = surface.point(v);
        mesh.points.emplace_back(p.x(), p.y(), p.z());
    }
    for (Surface::Face_index f : surface.faces()) {
        glm::uvec3 face;
        int k = 0;
        for (Surface::Vertex_index v : CGAL::vertices_around_face(surface.halfedge(f), surface))
            face[k++] = v;
        mesh.triangles.push_back(face);
    }
    return mesh;
}

/// Parts that enclose nothing.
struct Sheets {
    size_t count = 0;
    double area = 0;   ///< without what filled their holes [unit²]
    double filled = 0; ///< [unit²]
};

/// Whether a shell is a sheet with its own back for a filling: half of it is that, and it is
/// thinner than a thousandth of its size.
bool isSheet(const Shell& shell, double filled) {
    if (shell.flat) return true;
    return filled >= 0.49 * shell.area &&
           std::abs(shell.volume) <=
               1e-3 * shell.area * glm::distance(shell.box.min, shell.box.max);
}

/// Drops the shells that enclose nothing, unless that is all there is. Faces from `firstAdded` on
/// fill holes.
Sheets dropSheets(TriangleMesh& mesh, size_t firstAdded, std::vector<std::string>& actions) {
    const std::vector<Shell> shells = findShells(mesh, sortedEdges(mesh));
    Sheets sheets;
    std::vector<glm::uvec3> kept;
    for (const Shell& shell : shells) {
        double filled = 0;
        for (const std::uint32_t face : shell.faces)
            if (face >= firstAdded) filled += faceArea(mesh, mesh.triangles[face]);
        if (isSheet(shell, filled)) {
            ++sheets.count;
            sheets.area += shell.area - filled;
            sheets.filled += filled;
            continue;
        }
        for (const std::uint32_t face : shell.faces) kept.push_back(mesh.triangles[face]);
    }
    if (kept.empty() || sheets.count == 0) return sheets;
    mesh.triangles = std::move(kept);
    say(actions, sheets.count, "dropped", "flat part", " that enclosed nothing");
    return sheets;
}

/// Turns shells so that outermost ones look outward, those within them inward, and so on. Gives
/// how many were.
size_t turnOutward(TriangleMesh& mesh, std::vector<std::string>& actions) {
    const std::vector<Shell> shells = findShells(mesh, sortedEdges(mesh));
    const std::vector<int> depths =
        nestingDepths(mesh, shells, std::vector<char>(shells.size(), 1));
    size_t turned = 0;
    for (size_t i = 0; i < shells.size(); ++i) {
        const bool shouldLookOut = depths[i] % 2 == 0;
        if (shells[i].flat || (shells[i].volume > 0) == shouldLookOut) continue;
        for (std::uint32_t face : shells[i].faces)
            std::swap(mesh.triangles[face].y, mesh.triangles[face].z);
        ++turned;
    }
    say(actions, turned, "turned", "closed part", ", so that the volume lies behind the faces");
    return turned;
}

/// What a repair must keep.
struct Figures {
    explicit Figures(const TriangleMesh& mesh)
        : box(boundingBox(mesh)), area(surfaceArea(mesh)), volume(signedVolume(mesh)),
          gap(glm::length(vectorArea(mesh))) {}

    Box box;
    double area, volume;
    double gap; ///< what the faces' areas as vectors lack to cancel [unit²]
};

std::string shift(const std::string& what, double from, double to) {
    return "its " + what + " went from " + toText(static_cast<float>(from)) + " to " +
           toText(static_cast<float>(to));
}

/// Which of the figures changed beyond what the actions say. `added` is the area of what fills
/// holes of parts that were kept; `turned` whether any face was.
std::string lossOf(const Figures& before, const Figures& after, const Sheets& sheets, double added,
                   bool turned) {
    const double kShare = 0.1; // of the surface: flaps and crumbs are less, a lost body is more
    const double kClose = 1e-3;
    if (sheets.area > kShare * before.area)
        return counted(sheets.count, "part") + ", " +
               toText(std::round(100 * sheets.area / before.area)) +
               " % of its surface, would be flat";
    const double diagonal = glm::distance(before.box.min, before.box.max);
    if (sheets.count == 0 && (glm::distance(before.box.min, after.box.min) > kClose * diagonal ||
                              glm::distance(before.box.max, after.box.max) > kClose * diagonal))
        return shift("box's diagonal", diagonal, glm::distance(after.box.min, after.box.max));
    if (std::abs(after.area - added - before.area + sheets.area) > kClose * before.area)
        return shift("area", before.area, after.area - added);
    // What is closed but for seams has a volume, whatever its topology says.
    const bool hasVolume = before.gap <= 1e-6 * before.area && !turned;
    const double rounding = (before.gap + 1e-9 * before.area) * diagonal;
    if (hasVolume &&
        std::abs(after.volume - before.volume) > kClose * std::abs(before.volume) + rounding)
        return shift("volume", before.volume, after.volume);
    return "";
}

/// A mesh's normals by where its faces' corners are, for faces that others made anew.
class NormalsByPlace {
public:
    explicit NormalsByPlace(const TriangleMesh& mesh) {
        for (size_t f = 0; f < mesh.normals.size(); ++f) {
            const Corners corners = cornersOf(mesh, f);
            for (size_t k = 0; k < 3; ++k)
                mNormals[keyOf(corners)].push_back({corners[k], mesh.normals[f][k]});
        }
    }
    /// Gives the mesh what is known; filled holes have none.
    void giveTo(TriangleMesh& mesh) const {
        if (mNormals.empty()) return;
        mesh.normals.assign(mesh.triangles.size(), CornerNormals{});
        for (size_t f = 0; f < mesh.triangles.size(); ++f) {
            const Corners corners = cornersOf(mesh, f);
            const auto found = mNormals.find(keyOf(corners));
            if (found == mNormals.end()) continue;
            for (size_t k = 0; k < 3; ++k)
                for (const auto& [place, normal] : found->second)
                    if (place == corners[k]) mesh.normals[f][k] = normal;
        }
    }

private:
    using Corners = std::array<std::array<double, 3>, 3>;

    static Corners cornersOf(const TriangleMesh& mesh, size_t face) {
        Corners corners;
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.points[mesh.triangles[face][static_cast<int>(k)]];
            corners[k] = {p.x, p.y, p.z};
        }
        return corners;
    }
    static Corners keyOf(Corners corners) {
        std::sort(corners.begin(), corners.end());
        return corners;
    }

    struct Placed {
        std::array<double, 3> place;
        glm::vec3 normal;
    };
    std::map<Corners, std::vector<Placed>> mNormals;
};

} // namespace

RepairResult repairMesh(const TriangleMesh& mesh) {
    RepairResult result;
    result.mesh = mesh;
    const MeshReport report = checkTopology(mesh);
    if (report.boundsVolume() && report.duplicateFaces == 0 && report.degenerateFaces == 0)
        return result;
    say(result.actions, mergeIdenticalPoints(result.mesh), "merged or dropped", "point",
        " given twice or used by no triangle");
    dropIdleFaces(result.mesh, result.actions);
    if (result.mesh.triangles.empty()) return result;
    const Figures before(result.mesh);
    weld(result.mesh, result.actions);
    const NormalsByPlace normals(result.mesh);
    size_t turned = 0;
    Surface surface = orientedSurface(result.mesh, result.actions, turned);
    const size_t firstAdded = surface.number_of_faces();
    closeSurface(surface, result.actions);
    result.mesh = fromSurface(surface);
    double added = 0;
    for (size_t face = firstAdded; face < result.mesh.triangles.size(); ++face)
        added += faceArea(result.mesh, result.mesh.triangles[face]);
    const Sheets sheets = dropSheets(result.mesh, firstAdded, result.actions);
    added -= sheets.filled;
    // Points stay apart where the surface was cut: merged they would join the sheets again.
    dropUnusedPoints(result.mesh);
    if (!checkTopology(result.mesh).outward) turned += turnOutward(result.mesh, result.actions);
    normals.giveTo(result.mesh);
    result.filled = before.area > 0 ? added / before.area : 0;
    result.loss = lossOf(before, Figures(result.mesh), sheets, added, turned > 0);
    return result;
}

} // namespace eikonal::mesh
