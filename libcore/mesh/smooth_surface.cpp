// Curved surfaces from facets.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/smooth_surface.h"

#include "mesh/curved_face.h"
#include "mesh/intersections.h"
#include "mesh/shells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tbb/parallel_for.h>

namespace eikonal::mesh {

namespace {

using glm::dvec3;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The mesh as it is split, and of each face which one of the first it is of.
struct Split {
    TriangleMesh mesh;
    std::vector<std::uint32_t> origins;
};

/// For each side of each face the point at the middle of its curve, if the side is split.
using Middles = std::vector<std::array<std::uint32_t, 3>>;

size_t sideOf(const TriangleMesh& mesh, const FaceEdge& edge) {
    const glm::uvec3& face = mesh.triangles[edge.face];
    const std::uint32_t start = edge.rising ? edge.low : edge.high;
    return face.x == start ? 0 : face.y == start ? 1 : 2;
}

/// Where the edges of new faces begin whose curve bulges by more than `most`, in order.
std::vector<size_t> bulgingEdges(const TriangleMesh& mesh, const std::vector<FaceEdge>& edges,
                                 const std::vector<std::array<EdgeCurve, 3>>& curves,
                                 const std::vector<char>& isNew, double most) {
    std::vector<char> bulges(edges.size(), 0);
    eachEdge(edges, [&](size_t begin, size_t end) {
        bool any = false;
        for (size_t i = begin; i < end; ++i) any = any || isNew[edges[i].face] != 0;
        // All its faces bend it alike.
        bulges[begin] = any && curves[edges[begin].face][sideOf(mesh, edges[begin])].bulge() > most;
    });
    std::vector<size_t> found;
    for (size_t i = 0; i < bulges.size(); ++i)
        if (bulges[i]) found.push_back(i);
    return found;
}

/// Gives a middle to every side of new faces whose curve bulges by more than `most`; both faces
/// there find the same point.
Middles splitEdges(TriangleMesh& mesh, const std::vector<FaceEdge>& edges,
                   const std::vector<std::array<EdgeCurve, 3>>& curves,
                   const std::vector<char>& isNew, double most, bool& any) {
    const std::vector<size_t> bulging = bulgingEdges(mesh, edges, curves, isNew, most);
    Middles middles(mesh.triangles.size(), {kNone, kNone, kNone});
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.resize(first + bulging.size());
    tbb::parallel_for(size_t{0}, bulging.size(), [&](size_t k) {
        const size_t begin = bulging[k], end = endOfEdge(edges, begin);
        const FaceEdge& edge = edges[begin];
        const std::uint32_t middle = first + static_cast<std::uint32_t>(k);
        mesh.points[middle] = 0.5 * (mesh.points[edge.low] + mesh.points[edge.high]) +
                              curves[edge.face][sideOf(mesh, edge)].rise;
        for (size_t i = begin; i < end; ++i)
            middles[edges[i].face][sideOf(mesh, edges[i])] = middle;
    });
    any = !bulging.empty();
    return middles;
}

/// Splits one face at the middles of its sides.
class FaceSplit {
public:
    FaceSplit(Split& split, std::uint32_t face, const std::array<EdgeCurve, 3>& curves,
              const std::array<std::uint32_t, 3>& middles)
        : mSplit(split), mOrigin(split.origins[face]) {
        const glm::uvec3 corners = split.mesh.triangles[face];
        const CornerNormals normals = split.mesh.normals[face];
        for (int k = 0; k < 3; ++k) {
            const int j = (k + 1) % 3;
            const auto at = static_cast<size_t>(k);
            mPoints[k] = corners[k];
            mPoints[k + 3] = middles[at];
            mNormals[k] = normals[at];
            // From the lower point on, so that both faces get the same to the bit.
            const bool rises = corners[k] < corners[j];
            const dvec3 &a = split.mesh.points[corners[rises ? k : j]],
                        &b = split.mesh.points[corners[rises ? j : k]];
            const EdgeCurve curve{curves[at].rise, rises ? curves[at].skew : -curves[at].skew};
            const dvec3 p = normals[at], q = normals[static_cast<size_t>(j)];
            mNormals[k + 3] = glm::vec3(middleNormal(a, b, curve, {rises ? p : q, rises ? q : p}));
        }
    }

    /// Replaces the face by one of its parts and puts the others behind all faces.
    void run(std::uint32_t face) {
        const int count = (mPoints[3] != kNone) + (mPoints[4] != kNone) + (mPoints[5] != kNone);
        mFace = face;
        if (count == 3) {
            add(0, 3, 5);
            add(3, 1, 4);
            add(5, 4, 2);
            add(3, 4, 5);
            return;
        }
        // Turned so that the side from corner 0 is split, and that from 2, of two, is not.
        int k = 0;
        while (mPoints[3 + k] == kNone || (count == 2 && mPoints[3 + (k + 1) % 3] == kNone)) ++k;
        const int a = k, b = (k + 1) % 3, c = (k + 2) % 3, ab = 3 + a, bc = 3 + b;
        if (count == 1) {
            add(a, ab, c);
            add(ab, b, c);
            return;
        }
        add(ab, b, bc);
        if (distance(a, bc) < distance(ab, c)) {
            add(a, ab, bc);
            add(a, bc, c);
        } else {
            add(a, ab, c);
            add(ab, bc, c);
        }
    }

private:
    double distance(int i, int j) const {
        return glm::distance(mSplit.mesh.points[mPoints[i]], mSplit.mesh.points[mPoints[j]]);
    }
    void add(int i, int j, int k) {
        TriangleMesh& mesh = mSplit.mesh;
        if (mFace == kNone) {
            mFace = static_cast<std::uint32_t>(mesh.triangles.size());
            mesh.triangles.emplace_back();
            mesh.normals.emplace_back();
            mSplit.origins.push_back(mOrigin);
        }
        mesh.triangles[mFace] = {mPoints[i], mPoints[j], mPoints[k]};
        mesh.normals[mFace] = {mNormals[i], mNormals[j], mNormals[k]};
        mFace = kNone;
    }

    Split& mSplit;
    std::uint32_t mOrigin, mFace = kNone;
    std::uint32_t mPoints[6]; // corners, then middles of the sides from them
    glm::vec3 mNormals[6];
};

/// The faces that are new, and `rings` times those that share a point with one found before.
std::vector<std::uint32_t> facesAround(const TriangleMesh& mesh, const std::vector<char>& isNew,
                                       int rings) {
    std::vector<char> found = isNew;
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<char> near(mesh.points.size(), 0);
        for (size_t f = 0; f < found.size(); ++f)
            for (int k = 0; k < 3; ++k) near[mesh.triangles[f][k]] |= found[f];
        for (size_t f = 0; f < found.size(); ++f)
            for (int k = 0; k < 3; ++k) found[f] |= near[mesh.triangles[f][k]];
    }
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < found.size(); ++f)
        if (found[f]) faces.push_back(f);
    return faces;
}

/// Splits the new faces' sides that bulge by more than `most`; what then is new, if anything.
std::vector<char> halved(Split& split, const std::vector<char>& isNew, double most) {
    // A side's curve is told by its two faces, and where it follows kept edges by theirs.
    const std::vector<std::uint32_t> faces = facesAround(split.mesh, isNew, 2);
    TriangleMesh part{std::move(split.mesh.points), {}, {}};
    std::vector<char> partIsNew;
    for (const std::uint32_t f : faces) {
        part.triangles.push_back(split.mesh.triangles[f]);
        part.normals.push_back(split.mesh.normals[f]);
        partIsNew.push_back(isNew[f]);
    }
    const std::vector<FaceEdge> edges = sortedEdges(part);
    const auto curves = edgeCurves(part, edges);
    bool any = false;
    const Middles middles = splitEdges(part, edges, curves, partIsNew, most, any);
    split.mesh.points = std::move(part.points);
    if (!any) return {};
    std::vector<char> next(isNew.size(), 0);
    for (size_t i = 0; i < faces.size(); ++i) {
        if (middles[i] == std::array{kNone, kNone, kNone}) continue;
        FaceSplit(split, faces[i], curves[i], middles[i]).run(faces[i]);
        next[faces[i]] = 1;
    }
    next.resize(split.mesh.triangles.size(), 1);
    return next;
}

/// Splits until no side bulges by more than `most`.
Split refined(const TriangleMesh& mesh, const std::vector<CornerNormals>& normals, double most) {
    Split split{{mesh.points, mesh.triangles, normals}, {}};
    split.origins.resize(mesh.triangles.size());
    for (std::uint32_t f = 0; f < split.origins.size(); ++f) split.origins[f] = f;
    // Each halving leaves about a quarter of a bulge: that of a domain's whole length is gone by
    // then.
    constexpr int kMostHalvings = 10;
    std::vector<char> isNew(mesh.triangles.size(), 1);
    for (int i = 0; i < kMostHalvings && !isNew.empty(); ++i) isNew = halved(split, isNew, most);
    return split;
}

dvec3 areaOf(const TriangleMesh& mesh, size_t face) {
    const glm::uvec3& f = mesh.triangles[face];
    return glm::cross(mesh.points[f.y] - mesh.points[f.x], mesh.points[f.z] - mesh.points[f.x]);
}

/// The faces of the first mesh whose parts look back, or cross others' where they do not
/// themselves.
std::set<std::uint32_t> crossing(const TriangleMesh& mesh, const Split& split) {
    constexpr size_t kMostPairs = 100000;
    std::set<std::uint32_t> faces;
    // Beside a face that was laid flat parts stand upright; folded over they look back.
    const double kBack = -0.5;
    for (size_t f = 0; f < split.origins.size(); ++f) {
        const dvec3 part = areaOf(split.mesh, f), whole = areaOf(mesh, split.origins[f]);
        if (glm::dot(part, whole) < kBack * glm::length(part) * glm::length(whole))
            faces.insert(split.origins[f]);
    }
    const auto pairs = intersectingPairs(split.mesh, kMostPairs);
    if (pairs.empty()) return faces;
    const auto before = intersectingPairs(mesh, kMostPairs);
    const std::set<std::pair<std::uint32_t, std::uint32_t>> known(before.begin(), before.end());
    for (const auto& [f, g] : pairs) {
        const auto origins = std::minmax(split.origins[f], split.origins[g]);
        if (!known.count(origins)) faces.insert({origins.first, origins.second});
    }
    return faces;
}

} // namespace

TriangleMesh curved(const TriangleMesh& mesh, const Fans& fans, double sagitta,
                    SmoothCounts& counts) {
    std::vector<CornerNormals> normals = cornerNormals(fans);
    for (size_t f = mesh.flatFrom; f < normals.size(); ++f) normals[f] = CornerNormals{};
    // A face may bulge 4/3 as far as its sides.
    const double most = 0.75 * sagitta;
    // A face laid flat bends its neighbours' curves, which may cross in turn; then all are.
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        Split split = refined(mesh, normals, most);
        const bool isSplit = split.mesh.points.size() > mesh.points.size();
        const std::set<std::uint32_t> faces =
            isSplit ? crossing(mesh, split) : std::set<std::uint32_t>();
        if (faces.empty()) return std::move(split.mesh);
        for (const std::uint32_t face : faces) {
            counts.flat += normals[face] != CornerNormals{};
            normals[face] = CornerNormals{};
        }
    }
    counts.flat = mesh.triangles.size();
    return {mesh.points, mesh.triangles, {}};
}

} // namespace eikonal::mesh
