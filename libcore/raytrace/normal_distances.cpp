// How thick a body is along its normals.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/normal_distances.h"

#include "raytrace/faces.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

/// Outward, of any length; 0 where faces at a point cancel out.
std::vector<dvec3> pointNormals(const mesh::TriangleMesh& mesh) {
    std::vector<dvec3> normals(mesh.points.size(), dvec3(0));
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const glm::uvec3& face = mesh.triangles[f];
        for (int k = 0; k < 3; ++k) {
            const dvec3 x = mesh.points[face[k]], a = mesh.points[face[(k + 1) % 3]] - x,
                        b = mesh.points[face[(k + 2) % 3]] - x;
            const dvec3 area = glm::cross(a, b);
            const double length = glm::length(area);
            if (!(length > 0)) continue;
            const auto own =
                mesh.normals.empty() ? dvec3(0) : dvec3(mesh.normals[f][static_cast<size_t>(k)]);
            normals[face[k]] +=
                std::atan2(length, glm::dot(a, b)) * (own != dvec3(0) ? own : area / length);
        }
    }
    return normals;
}

} // namespace

std::vector<float> distancesAlongNormals(const mesh::TriangleMesh& mesh) {
    const Faces faces({&mesh});
    const std::vector<dvec3> normals = pointNormals(mesh);
    std::vector<float> distances(mesh.points.size(), 0.0f);
    tbb::parallel_for(size_t{0}, mesh.points.size(), [&](size_t i) {
        const double length = glm::length(normals[i]);
        if (!(length > 0)) return;
        const dvec3 inward = -normals[i] / length;
        const auto leavesThrough = [&](const Face& face) {
            const glm::uvec3& corners = mesh.triangles[face.triangle];
            const dvec3 a = mesh.points[corners.x];
            const dvec3 area = glm::cross(mesh.points[corners.y] - a, mesh.points[corners.z] - a);
            return corners.x != i && corners.y != i && corners.z != i && glm::dot(area, inward) > 0;
        };
        if (const auto hit = faces.next(mesh.points[i], inward, leavesThrough))
            distances[i] = static_cast<float>(hit->t);
    });
    return distances;
}

} // namespace eikonal::raytrace
