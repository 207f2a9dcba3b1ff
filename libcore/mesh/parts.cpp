// Which triangles of a file are an object of their own.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/parts.h"

#include "mesh/groups.h"

#include "mesh/shells.h"

#include <algorithm>
#include <cstdint>

namespace eikonal::mesh {

namespace {

/// Joins the labels that have an odd number of faces at the same edge; gives the labels that are
/// left with such an edge alone.
std::vector<char> joinAtOpenEdges(const TriangleMesh& mesh,
                                  const std::vector<std::uint32_t>& labels, Groups& groups,
                                  size_t count) {
    const std::vector<FaceEdge> edges = sortedEdges(mesh);
    std::vector<char> open(count, 0);
    std::vector<std::uint32_t> odd; // labels at an edge, those that come twice gone
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        end = endOfEdge(edges, begin);
        odd.clear();
        for (size_t i = begin; i < end; ++i) {
            const std::uint32_t label = labels[edges[i].face];
            const auto found = std::find(odd.begin(), odd.end(), label);
            if (found == odd.end())
                odd.push_back(label);
            else
                odd.erase(found);
        }
        for (const std::uint32_t label : odd) groups.join(odd.front(), label);
        if (odd.size() % 2 == 1) open[odd.front()] = 1;
    }
    return open;
}

/// Joins each closed object that looks inward with the smallest that winds around it.
void joinCavities(const TriangleMesh& mesh, const std::vector<std::uint32_t>& labels,
                  const std::vector<char>& open, Groups& groups) {
    struct Body {
        std::uint32_t object;
        double volume;
        Box box;
    };
    const std::vector<std::uint32_t> objects = groups.roots();
    std::vector<char> isOpen(objects.size(), 0);
    for (size_t i = 0; i < open.size(); ++i)
        if (open[i]) isOpen[objects[i]] = 1;
    const std::vector<TriangleMesh> meshes = split(mesh, labels, objects);
    std::vector<Body> bodies;
    for (std::uint32_t i = 0; i < objects.size(); ++i)
        if (!isOpen[i] && !meshes[i].triangles.empty())
            bodies.push_back({i, signedVolume(meshes[i]), boundingBox(meshes[i])});
    std::sort(bodies.begin(), bodies.end(),
              [](const Body& a, const Body& b) { return a.volume < b.volume; });
    for (const Body& cavity : bodies) {
        if (cavity.volume >= 0) break;
        const glm::uvec3& face = meshes[cavity.object].triangles.front();
        const std::vector<glm::dvec3>& points = meshes[cavity.object].points;
        const glm::dvec3 x = (points[face.x] + points[face.y] + points[face.z]) / 3.0;
        const auto around = std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) {
            return body.volume > -cavity.volume && body.box.contains(x) &&
                   windingNumber(meshes[body.object], x) > 0.5;
        });
        if (around != bodies.end()) groups.join(cavity.object, around->object);
    }
}

} // namespace

std::vector<std::uint32_t> objectsOf(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& labels, size_t count) {
    Groups groups(count);
    const std::vector<char> open = joinAtOpenEdges(mesh, labels, groups, count);
    joinCavities(mesh, labels, open, groups);
    return groups.roots();
}

std::vector<TriangleMesh> split(const TriangleMesh& mesh, const std::vector<std::uint32_t>& labels,
                                const std::vector<std::uint32_t>& objects) {
    std::vector<std::vector<std::uint32_t>> faces(objects.size());
    for (std::uint32_t i = 0; i < labels.size(); ++i) faces[objects[labels[i]]].push_back(i);
    std::vector<TriangleMesh> parts(objects.size());
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> owner(mesh.points.size(), kNone), renamed(mesh.points.size());
    for (std::uint32_t object = 0; object < parts.size(); ++object)
        for (const std::uint32_t face : faces[object]) {
            glm::uvec3 corners = mesh.triangles[face];
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t point = corners[k];
                if (owner[point] != object) {
                    owner[point] = object;
                    renamed[point] = static_cast<std::uint32_t>(parts[object].points.size());
                    parts[object].points.push_back(mesh.points[point]);
                }
                corners[k] = renamed[point];
            }
            parts[object].triangles.push_back(corners);
            if (!mesh.normals.empty()) parts[object].normals.push_back(mesh.normals[face]);
        }
    return parts;
}

} // namespace eikonal::mesh
