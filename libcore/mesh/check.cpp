// Whether a mesh bounds a volume, and if not, why: what stands between a file and voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/check.h"

#include "base/text.h"
#include "mesh/intersections.h"
#include "mesh/shells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <unordered_map>

namespace eikonal::mesh {

namespace {

/// What the edges alone tell.
struct EdgeFacts {
    size_t open = 0, nonManifold = 0, holes = 0;
    bool even = true;   // every edge has an even number of faces
    bool agreed = true; // as many faces run along each edge as against it, but for one left over
};

/// Groups open edges by the points they share.
class OpenEdgeGroups {
public:
    void add(std::uint32_t a, std::uint32_t b) { mParents[rootOf(a)] = rootOf(b); }

    size_t count() const {
        size_t roots = 0;
        for (const auto& [point, parent] : mParents) roots += point == parent;
        return roots;
    }

private:
    std::uint32_t rootOf(std::uint32_t i) {
        mParents.try_emplace(i, i);
        while (mParents[i] != i) i = mParents[i] = mParents[mParents[i]];
        return i;
    }
    std::unordered_map<std::uint32_t, std::uint32_t> mParents;
};

EdgeFacts judgeEdges(const std::vector<FaceEdge>& edges) {
    EdgeFacts facts;
    OpenEdgeGroups groups;
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = endOfEdge(edges, begin);
        const size_t faces = end - begin;
        int balance = 0;
        for (size_t i = begin; i < end; ++i) balance += edges[i].rising ? 1 : -1;
        if (faces == 1) {
            ++facts.open;
            groups.add(edges[begin].low, edges[begin].high);
        }
        facts.nonManifold += faces > 2;
        facts.even = facts.even && faces % 2 == 0;
        facts.agreed = facts.agreed && std::abs(balance) <= 1;
    }
    facts.holes = groups.count();
    return facts;
}

size_t countDuplicates(const TriangleMesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> corners;
    corners.reserve(mesh.triangles.size());
    for (const glm::uvec3& face : mesh.triangles) {
        if (hasRepeatedCorner(face)) continue;
        corners.push_back({face.x, face.y, face.z});
        std::sort(corners.back().begin(), corners.back().end());
    }
    std::sort(corners.begin(), corners.end());
    const auto unique = std::unique(corners.begin(), corners.end());
    return static_cast<size_t>(corners.end() - unique);
}

bool looksOutward(const TriangleMesh& mesh, const std::vector<Shell>& shells) {
    std::vector<char> inward(shells.size());
    for (size_t i = 0; i < shells.size(); ++i) inward[i] = !shells[i].flat && shells[i].volume < 0;
    const std::vector<int> depths = nestingDepths(mesh, shells, inward);
    for (size_t i = 0; i < shells.size(); ++i)
        if (inward[i] && depths[i] == 0) return false;
    return std::any_of(shells.begin(), shells.end(), [](const Shell& s) { return !s.flat; });
}

/// Leaves out what lies within the solid and so is none of its boundary.
void measureSolid(const TriangleMesh& mesh, const std::vector<Shell>& shells, MeshReport& report) {
    const std::vector<char> buried = buriedShells(mesh, shells);
    for (size_t i = 0; i < shells.size(); ++i) {
        if (!buried[i]) continue;
        report.volume -= shells[i].volume;
        report.buried += shells[i].volume > 0;
    }
}

/// "1 edge", "12 edges".
std::string counted(size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace

MeshReport checkTopology(const TriangleMesh& mesh) {
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    const EdgeFacts facts = judgeEdges(edges);
    const std::vector<Shell> shells = findShells(mesh, edges);
    MeshReport report;
    report.points = mesh.points.size();
    report.triangles = mesh.triangles.size();
    report.degenerateFaces = countDegenerateFaces(mesh);
    report.duplicateFaces = countDuplicates(mesh);
    report.boundaryEdges = facts.open;
    report.holes = facts.holes;
    report.nonManifoldEdges = facts.nonManifold;
    report.components = shells.size();
    report.closed = facts.even && !edges.empty();
    report.oriented = facts.agreed && !edges.empty();
    report.volume = signedVolume(mesh);
    report.outward =
        report.closed && report.oriented && report.volume > 0 && looksOutward(mesh, shells);
    if (report.outward) measureSolid(mesh, shells, report);
    return report;
}

MeshReport checkMesh(const TriangleMesh& mesh) {
    MeshReport report = checkTopology(mesh);
    report.selfIntersectingPairs = intersectingPairs(mesh, kMaxReportedPairs).size();
    return report;
}

std::vector<std::string> MeshReport::sentences() const {
    std::vector<std::string> said = {counted(triangles, "triangle") + ", " +
                                     counted(points, "point") + ", " +
                                     counted(components, "component")};
    if (closed) said.back() += ", volume " + toText(volume);
    if (boundaryEdges > 0)
        said.push_back("open: " + counted(boundaryEdges, "edge") + " with a single face, around " +
                       counted(holes, "hole"));
    if (nonManifoldEdges > 0)
        said.push_back("not a plain surface: " + counted(nonManifoldEdges, "edge") +
                       " with more than two faces" +
                       (closed || boundaryEdges > 0 ? "" : ", some with an odd number"));
    if (!oriented && triangles > degenerateFaces)
        said.push_back("neighbouring faces disagree about which side is out");
    if (closed && oriented && !outward)
        said.push_back(volume < 0 ? "inside out: the faces look inward"
                                  : "encloses no volume, or a part of it looks inward");
    if (buried > 0)
        said.push_back(counted(buried, "component") +
                       (buried == 1 ? " that looks outward lies" : " that look outward lie") +
                       " within the solid");
    if (degenerateFaces > 0) said.push_back(counted(degenerateFaces, "triangle") + " of no area");
    if (duplicateFaces > 0) said.push_back(counted(duplicateFaces, "triangle") + " given twice");
    if (selfIntersectingPairs > 0)
        said.push_back("crosses itself: " +
                       std::string(selfIntersectingPairs >= kMaxReportedPairs ? "at least " : "") +
                       counted(selfIntersectingPairs, "pair") + " of triangles");
    return said;
}

} // namespace eikonal::mesh
