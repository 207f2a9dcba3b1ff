// An open surface of no thickness becomes a plate.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/plate.h"

#include "mesh/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace eikonal::mesh {

namespace {

/// Of length 1, or 0 of a face without an area.
glm::dvec3 faceNormal(const TriangleMesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 product =
        glm::cross(mesh.points[t.y] - mesh.points[t.x], mesh.points[t.z] - mesh.points[t.x]);
    const double length = glm::length(product);
    return length > 0 ? product / length : glm::dvec3(0);
}

double angleAt(const TriangleMesh& mesh, const glm::uvec3& t, int corner) {
    const glm::dvec3 a = mesh.points[t[(corner + 1) % 3]] - mesh.points[t[corner]];
    const glm::dvec3 b = mesh.points[t[(corner + 2) % 3]] - mesh.points[t[corner]];
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Where each point's back is, seen from it, of a thickness of 1.
std::vector<glm::dvec3> backward(const TriangleMesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.points.size(), glm::dvec3(0));
    std::vector<double> weights(mesh.points.size(), 0);
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const double angle = angleAt(mesh, t, k);
            sums[t[k]] += angle * faceNormal(mesh, t);
            weights[t[k]] += angle;
        }
    for (size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i]);
        if (!(length > 0)) continue;
        // So that the backs of faces that meet at an angle keep their distance; no long spikes.
        const double lean = std::clamp(length / weights[i], 0.5, 1.0);
        sums[i] *= -1 / (length * lean);
    }
    return sums;
}

} // namespace

std::string makePlate(TriangleMesh& mesh, double thickness) {
    const MeshReport report = checkTopology(mesh);
    if (!report.oriented) return "its faces disagree about which side is out";
    if (report.nonManifoldEdges > 0) return "more than two faces meet at an edge";
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges; // directed, less its twin
    for (const glm::uvec3& t : mesh.triangles) {
        if (hasRepeatedCorner(t)) continue;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    const std::vector<glm::dvec3> back = backward(mesh);
    const auto count = static_cast<std::uint32_t>(mesh.points.size());
    const size_t front = mesh.triangles.size();
    for (std::uint32_t i = 0; i < count; ++i)
        mesh.points.push_back(mesh.points[i] + thickness * back[i]);
    for (size_t i = 0; i < front; ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        mesh.triangles.emplace_back(t.x + count, t.z + count, t.y + count);
    }
    for (const auto& [edge, sense] : edges) {
        if (sense == 0) continue;
        const auto [a, b] = sense > 0 ? edge : std::pair(edge.second, edge.first);
        mesh.triangles.emplace_back(b, a, a + count);
        mesh.triangles.emplace_back(b, a + count, b + count);
    }
    if (!mesh.normals.empty()) mesh.normals.resize(mesh.triangles.size(), CornerNormals{});
    mesh.flatFrom = std::min(mesh.flatFrom, front);
    return "";
}

} // namespace eikonal::mesh
