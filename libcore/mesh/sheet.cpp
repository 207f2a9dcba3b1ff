// An open surface that ends at a domain's faces becomes a closed one, by walls outside the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rim is moved outward, away from the domain, onto a shell around it, and from there along the
// shell to the pole that the surface looks away from. Every rim edge draws a strip of triangles,
// whatever rim it belongs to: no loops are looked for, and the mesh closes however many there are.
// A box below the domain would do for heights over a plane alone; this way the surface may leave
// the domain through any of its faces.
#include "mesh/sheet.h"

#include "base/text.h"
#include "mesh/shells.h"
#include "mesh/triangle_tree.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace eikonal::mesh {

namespace {

using glm::dvec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr int kRings = 6;           // from the rim to the pole, 30° from each other at the most
constexpr double kWidest = 20;      // a rim's edge, seen from the domain's middle [degree]
constexpr double kNarrowest = 1;    // where walls from wider ones come too near [degree]
constexpr double kLeastSlope = 0.1; // of a sheet with something below: its normal's height
constexpr double kSteepest = 3;     // a surface's rise on its way out, of that way
constexpr double kRounding = 1e-6;  // of a slack that a rim uses up

/// A side of a face that no other face has, in that face's direction.
struct RimEdge {
    std::uint32_t from, to, face;
};

/// None where faces meet otherwise than two by two and in agreement.
std::optional<std::vector<RimEdge>> rimOf(const TriangleMesh& mesh) {
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    std::vector<RimEdge> rim;
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = endOfEdge(edges, begin);
        const FaceEdge& edge = edges[begin];
        if (end - begin > 2) return {};
        if (end - begin == 2 && edge.rising == edges[begin + 1].rising) return {};
        if (end - begin == 1)
            rim.push_back({edge.rising ? edge.low : edge.high, edge.rising ? edge.high : edge.low,
                           edge.face});
    }
    return rim;
}

Box grown(const Box& box, double by) {
    const dvec3 most = 0.5 * (box.max - box.min); // shrunk, a box ends as its middle
    const dvec3 d = glm::max(dvec3(by), -most);
    Box out;
    out.min = box.min - d;
    out.max = box.max + d;
    return out;
}

/// The middle of what a line from a to b has within the box, if it has anything there.
std::optional<dvec3> middleWithin(const Box& box, const dvec3& a, const dvec3& b) {
    double enter = 0, leave = 1;
    for (int i = 0; i < 3; ++i) {
        const double along = b[i] - a[i];
        if (along == 0) {
            if (a[i] < box.min[i] || a[i] > box.max[i]) return {};
            continue;
        }
        const double s = (box.min[i] - a[i]) / along, t = (box.max[i] - a[i]) / along;
        enter = std::max(enter, std::min(s, t));
        leave = std::min(leave, std::max(s, t));
    }
    if (enter > leave) return {};
    return a + 0.5 * (enter + leave) * (b - a);
}

/// Where no rim may be.
Box inside(const SheetDomain& domain) {
    return grown(domain.box, -domain.slack * (1 + kRounding));
}

double depthWithin(const Box& box, const dvec3& x) {
    const dvec3 d = glm::min(x - box.min, box.max - x);
    return std::min({d.x, d.y, d.z});
}

std::string placeText(const dvec3& x) {
    std::string text;
    for (int i = 0; i < 3; ++i) text += (i == 0 ? "(" : ", ") + toText(static_cast<float>(x[i]));
    return text + ")";
}

/// Where the rim lies deepest within the domain; empty: nowhere.
std::string placeWithin(const TriangleMesh& mesh, const std::vector<RimEdge>& rim,
                        const SheetDomain& domain) {
    const Box within = inside(domain);
    double deepest = 0;
    std::optional<dvec3> place;
    for (const RimEdge& edge : rim)
        if (const auto x = middleWithin(within, mesh.points[edge.from], mesh.points[edge.to])) {
            const double depth = depthWithin(domain.box, *x);
            if (place && depth <= deepest) continue;
            deepest = depth;
            place = x;
        }
    if (!place) return "";
    return "its rim lies within the domain, at " + placeText(*place) + ", " +
           toText(static_cast<float>(deepest)) + " units from its nearest face";
}

/// Halves edges of the rim, with their faces, until none is seen wider than that from a place.
void splitRim(TriangleMesh& mesh, const dvec3& from, double degrees) {
    const double most = std::cos(glm::radians(degrees));
    for (bool again = true; again;) {
        again = false;
        std::vector<char> done(mesh.triangles.size(), 0); // a face's other edges come next time
        const std::vector<RimEdge> rim = *rimOf(mesh);
        for (const RimEdge& edge : rim) {
            const dvec3 a = mesh.points[edge.from], b = mesh.points[edge.to];
            if (glm::dot(glm::normalize(a - from), glm::normalize(b - from)) >= most) continue;
            again = true;
            if (done[edge.face]) continue;
            done[edge.face] = 1;
            const auto middle = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(0.5 * (a + b));
            glm::uvec3 first = mesh.triangles[edge.face], second = first;
            const int k = first.x == edge.from ? 0 : first.y == edge.from ? 1 : 2;
            const int next = (k + 1) % 3;
            first[next] = middle;
            second[k] = middle;
            mesh.triangles[edge.face] = first;
            mesh.triangles.push_back(second);
            if (mesh.normals.empty()) continue;
            CornerNormals normals = mesh.normals[edge.face], others = normals;
            const auto atA = static_cast<size_t>(k), atB = static_cast<size_t>(next);
            const glm::vec3 sum = normals[atA] + normals[atB];
            const float length = glm::length(sum);
            normals[atB] = others[atA] = length > 0 ? sum / length : glm::vec3(0);
            mesh.normals[edge.face] = normals;
            mesh.normals.push_back(others);
        }
    }
}

/// Puts walls behind the faces of a mesh.
class Walls {
public:
    /// `away` is a direction of length 1, away from the solid.
    Walls(TriangleMesh& mesh, const SheetDomain& domain, const dvec3& away)
        : mMesh(mesh), mFirst(mesh.triangles.size()), mWithin(inside(domain)),
          mClear(grown(domain.box, domain.clear)), mAway(away),
          mMiddle(0.5 * (domain.box.min + domain.box.max)) {
        // Corners of the domain are passed slantwise, and slopes go aside: both come nearer.
        mReach = 1.6 * domain.clear + domain.slack;
        mRadius = 2 * glm::distance(grown(domain.box, mReach).max, mMiddle);
    }

    void build(const std::vector<RimEdge>& rim) {
        for (const RimEdge& edge : rim) note(edge);
        for (auto& [point, at] : mRim) {
            at.end = continued(point, at);
            mRadius = std::max(mRadius, 1.05 * glm::distance(at.end, mMiddle));
        }
        for (const auto& [point, at] : mRim) addColumn(point, at.end);
        const std::uint32_t pole = addPoint(mMiddle - mRadius * mAway);
        // All that go on beside the domain, then all around it.
        for (const RimEdge& edge : rim) addStrip(edge, 0);
        mFirstAround = mMesh.triangles.size();
        for (const RimEdge& edge : rim) addStrip(edge, 1);
        mFirstFlat = mMesh.triangles.size();
        for (const RimEdge& edge : rim) {
            for (size_t k = 2; k < kRings; ++k) addStrip(edge, k);
            addPart({mColumns.at(edge.to).back(), mColumns.at(edge.from).back(), pole});
        }
    }

    /// Whether all that was built keeps clear of the domain.
    bool areClear() const {
        for (size_t f = mFirst; f < mMesh.triangles.size(); ++f)
            if (touches(mMesh.triangles[f], f < mFirstAround ? mWithin : mClear)) return false;
        return true;
    }

    /// What may begin at the rim has its own normals, which leave the rim's curve as it is; the
    /// rest, long needles among it, is not looked at by smoothing.
    void keepFlat() {
        mMesh.flatFrom = mFirstFlat;
        mMesh.normals.resize(mFirst, CornerNormals{});
        for (size_t f = mFirst; f < mFirstFlat; ++f) {
            const glm::uvec3& face = mMesh.triangles[f];
            const dvec3 area = glm::cross(mMesh.points[face.y] - mMesh.points[face.x],
                                          mMesh.points[face.z] - mMesh.points[face.x]);
            const double length = glm::length(area);
            mMesh.normals.emplace_back();
            if (length > 0) mMesh.normals.back().fill(glm::vec3(area / length));
        }
        mMesh.normals.resize(mMesh.triangles.size(), CornerNormals{});
    }

private:
    struct RimPoint {
        dvec3 normal{0}, along{0}; ///< of its faces, of its edges; of any length
        dvec3 end{0};              ///< where the surface's own slope ends
    };
    /// A point of the rim and what it becomes: beside the domain, and round it.
    using Column = std::vector<std::uint32_t>;

    void addPart(const glm::uvec3& face) {
        if (!hasRepeatedCorner(face)) mMesh.triangles.push_back(face);
    }

    /// Between the columns of an edge's ends.
    void addStrip(const RimEdge& edge, size_t k) {
        const Column &from = mColumns.at(edge.from), &to = mColumns.at(edge.to);
        // Cut in two alike, whichever way the edge runs.
        const bool rises = edge.from < edge.to;
        addPart({to[k], from[k], rises ? to[k + 1] : from[k + 1]});
        addPart({rises ? from[k] : to[k], from[k + 1], to[k + 1]});
    }

    std::uint32_t addPoint(const dvec3& x) {
        mMesh.points.push_back(x);
        return static_cast<std::uint32_t>(mMesh.points.size() - 1);
    }

    void note(const RimEdge& edge) {
        const glm::uvec3& face = mMesh.triangles[edge.face];
        const dvec3 area = glm::cross(mMesh.points[face.y] - mMesh.points[face.x],
                                      mMesh.points[face.z] - mMesh.points[face.x]);
        const dvec3 along = glm::normalize(mMesh.points[edge.to] - mMesh.points[edge.from]);
        for (const std::uint32_t point : {edge.from, edge.to}) {
            mRim[point].normal += area;
            mRim[point].along += along;
        }
    }

    /// Outward until it is clear of the domain, along the surface's slope there.
    dvec3 continued(std::uint32_t point, const RimPoint& at) const {
        const dvec3 x = mMesh.points[point];
        const dvec3 out = x - glm::clamp(x, mWithin.min, mWithin.max);
        const double far = std::max({std::abs(out.x), std::abs(out.y), std::abs(out.z)});
        if (far >= mReach) return x;
        const dvec3 way = (mReach / far - 1) * out;
        // Aside from the way out, but not along the rim, where neighbours would come too near.
        const dvec3 aside = glm::cross(way, at.along);
        const double slope = -glm::dot(way, at.normal) / glm::dot(aside, at.normal);
        const double shift = std::abs(slope) * glm::length(aside);
        return x + (shift < kSteepest * glm::length(way) ? way + slope * aside : way);
    }

    void addColumn(std::uint32_t point, const dvec3& end) {
        Column column{point, end == mMesh.points[point] ? point : addPoint(end)};
        const dvec3 start = glm::normalize(end - mMiddle);
        const double angle = std::acos(std::clamp(glm::dot(start, -mAway), -1.0, 1.0));
        dvec3 side = -mAway - glm::dot(start, -mAway) * start;
        side = glm::length(side) > 0 ? glm::normalize(side) : dvec3(0);
        // Not straight on first: smoothing needs a plain crease where the walls begin.
        for (int k = 1; k < kRings; ++k) {
            const double turn = angle * k / kRings;
            column.push_back(
                addPoint(mMiddle + mRadius * (std::cos(turn) * start + std::sin(turn) * side)));
        }
        mColumns.emplace(point, std::move(column));
    }

    bool touches(const glm::uvec3& face, const Box& box) const {
        const dvec3 &a = mMesh.points[face.x], &b = mMesh.points[face.y], &c = mMesh.points[face.z];
        Box own;
        for (const dvec3& corner : {a, b, c}) own.include(corner);
        if (!own.touches(box)) return false;
        const auto exact = [](const dvec3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
        const Kernel::Triangle_3 triangle(exact(a), exact(b), exact(c));
        if (triangle.is_degenerate()) return false; // a line, which its neighbours have, too
        return CGAL::do_intersect(triangle, Kernel::Iso_cuboid_3(exact(box.min), exact(box.max)));
    }

    TriangleMesh& mMesh;
    size_t mFirst, mFirstAround = 0, mFirstFlat = 0; ///< triangles
    Box mWithin, mClear;
    dvec3 mAway, mMiddle;
    double mReach, mRadius;
    std::map<std::uint32_t, RimPoint> mRim;
    std::map<std::uint32_t, Column> mColumns;
};

/// Whether the solid lies behind the faces of the sheet within the domain, and not before them.
bool isSolidBehind(const TriangleMesh& mesh, size_t faces, const SheetDomain& domain) {
    constexpr size_t kSamples = 64;
    const Box within = inside(domain);
    std::vector<std::uint32_t> seen;
    for (std::uint32_t f = 0; f < faces; ++f) {
        const glm::uvec3& face = mesh.triangles[f];
        const dvec3 x = (mesh.points[face.x] + mesh.points[face.y] + mesh.points[face.z]) / 3.0;
        if (within.contains(x) && faceArea(mesh, face) > 0) seen.push_back(f);
    }
    const TriangleTree tree(mesh);
    const double skin = 1e-6 * glm::distance(domain.box.min, domain.box.max);
    const size_t stride = std::max<size_t>(1, seen.size() / kSamples);
    size_t right = 0, asked = 0;
    for (size_t i = 0; i < seen.size(); i += stride, ++asked) {
        const glm::uvec3& face = mesh.triangles[seen[i]];
        const dvec3 &a = mesh.points[face.x], &b = mesh.points[face.y], &c = mesh.points[face.z];
        const dvec3 off = skin * glm::normalize(glm::cross(b - a, c - a)), x = (a + b + c) / 3.0;
        right += tree.winding(x - off) == 1 && tree.winding(x + off) == 0;
    }
    return 2 * right >= asked; // where faces cross, some lie within the solid
}

void turn(TriangleMesh& mesh) {
    for (glm::uvec3& face : mesh.triangles) std::swap(face.y, face.z);
    for (CornerNormals& normals : mesh.normals) std::swap(normals[1], normals[2]);
}

} // namespace

ClosedSheet closeSheet(TriangleMesh& mesh, const SheetDomain& domain) {
    ClosedSheet result;
    const auto rim = rimOf(mesh);
    if (!rim) {
        result.fault = "no plain surface whose faces agree";
        return result;
    }
    result.rimEdges = rim->size();
    result.fault = placeWithin(mesh, *rim, domain);
    if (!result.fault.empty()) return result;
    TriangleMesh sheet = mesh;
    dvec3 away = vectorArea(sheet);
    if (domain.below) {
        if (std::abs(away.y) <= kLeastSlope * glm::length(away)) {
            result.fault = "it stands upright, so that nothing lies below it";
            return result;
        }
        result.turned = away.y < 0;
        if (result.turned) turn(sheet);
        away = dvec3(0, 1, 0);
    }
    if (!(glm::length(away) > 0)) {
        result.fault = "its faces look to all sides alike";
        return result;
    }
    const dvec3 middle = 0.5 * (domain.box.min + domain.box.max);
    for (double widest = kWidest; widest >= kNarrowest; widest /= 2) {
        splitRim(sheet, middle, widest);
        TriangleMesh closed = sheet;
        Walls walls(closed, domain, glm::normalize(away));
        walls.build(*rimOf(closed));
        if (!walls.areClear()) continue;
        if (!isSolidBehind(closed, sheet.triangles.size(), domain)) break;
        walls.keepFlat();
        mesh = std::move(closed);
        return result;
    }
    result.fault = "its rim does not go round the domain";
    return result;
}

} // namespace eikonal::mesh
