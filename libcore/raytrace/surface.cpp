// A mesh's surface where a ray meets it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

// Sines of angles to a surface. Rays graze a smooth one at what is above rounding; within a body
// they leave a flat one so steeply that single precision still finds the next face at the edge.
constexpr double kGrazing = 1e-9, kLeast = 1e-3;

} // namespace

SurfacePoint surfaceAt(const mesh::TriangleMesh& mesh, std::uint32_t triangle, const dvec3& x) {
    const glm::uvec3& face = mesh.triangles[triangle];
    const dvec3 a = mesh.points[face.x], b = mesh.points[face.y], c = mesh.points[face.z];
    const dvec3 area = glm::cross(b - a, c - a);
    const double squared = glm::dot(area, area);
    // A hit beside the triangle is so by single precision's rounding.
    dvec3 weights(0, glm::dot(glm::cross(c - x, a - x), area),
                  glm::dot(glm::cross(a - x, b - x), area));
    weights.x = squared - weights.y - weights.z;
    weights = glm::max(weights, dvec3(0));
    weights /= weights.x + weights.y + weights.z;
    const dvec3 normal = area / std::sqrt(squared);
    SurfacePoint point{weights.x * a + weights.y * b + weights.z * c, normal, normal};
    if (mesh.normals.empty()) return point;
    const mesh::CornerNormals& corners = mesh.normals[triangle];
    const bool known = std::all_of(corners.begin(), corners.end(),
                                   [](const glm::vec3& n) { return n != glm::vec3(0); });
    const dvec3 mean = weights.x * dvec3(corners[0]) + weights.y * dvec3(corners[1]) +
                       weights.z * dvec3(corners[2]);
    if (known && glm::dot(mean, normal) > 0) point.smooth = glm::normalize(mean);
    return point;
}

dvec3 facingNormal(const dvec3& smooth, const dvec3& face, const dvec3& direction) {
    const dvec3 facing = glm::dot(smooth, face) < 0 ? -smooth : smooth;
    const double across = glm::dot(facing, direction);
    if (across < -kGrazing) return facing;
    return glm::normalize(facing - (across + kGrazing) * direction);
}

dvec3 keptWithin(const dvec3& direction, const dvec3& inward) {
    const double across = glm::dot(direction, inward);
    if (across > kLeast) return direction;
    return glm::normalize(direction + (kLeast - across) * inward);
}

} // namespace eikonal::raytrace
