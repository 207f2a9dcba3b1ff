// Triangles in world space: what a boundary is before it becomes voxels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <tuple>

namespace eikonal::mesh {

bool Box::contains(const glm::dvec3& x) const {
    return glm::all(glm::lessThanEqual(min, x)) && glm::all(glm::lessThanEqual(x, max));
}

Box boundingBox(const TriangleMesh& mesh) {
    Box box;
    for (const glm::uvec3& face : mesh.triangles)
        for (int k = 0; k < 3; ++k) box.include(mesh.points[face[k]]);
    return box;
}

namespace {

glm::dvec3 areaVector(const TriangleMesh& mesh, const glm::uvec3& face) {
    const glm::dvec3& a = mesh.points[face.x];
    return 0.5 * glm::cross(mesh.points[face.y] - a, mesh.points[face.z] - a);
}

} // namespace

double faceArea(const TriangleMesh& mesh, const glm::uvec3& face) {
    return glm::length(areaVector(mesh, face));
}

double surfaceArea(const TriangleMesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& face : mesh.triangles) sum += faceArea(mesh, face);
    return sum;
}

glm::dvec3 vectorArea(const TriangleMesh& mesh) {
    glm::dvec3 sum(0);
    for (const glm::uvec3& face : mesh.triangles) sum += areaVector(mesh, face);
    return sum;
}

double signedVolume(const TriangleMesh& mesh) {
    const Box box = boundingBox(mesh);
    // Tetrahedra towards the box's centre: far from the origin those towards it would cancel.
    const glm::dvec3 centre = 0.5 * (box.min + box.max);
    double sixfold = 0;
    for (const glm::uvec3& face : mesh.triangles)
        sixfold += glm::dot(mesh.points[face.x] - centre,
                            glm::cross(mesh.points[face.y] - centre, mesh.points[face.z] - centre));
    return sixfold / 6;
}

double windingShare(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& x) {
    // van Oosterom and Strackee 1983, "The solid angle of a plane triangle", eq. 8.
    const glm::dvec3 A = a - x, B = b - x, C = c - x;
    const double lengthA = glm::length(A), lengthB = glm::length(B), lengthC = glm::length(C);
    const double numerator = glm::dot(A, glm::cross(B, C));
    const double denominator = lengthA * lengthB * lengthC + glm::dot(A, B) * lengthC +
                               glm::dot(B, C) * lengthA + glm::dot(C, A) * lengthB;
    if (numerator == 0 && denominator <= 0) return 0; // x lies in the triangle, or on its rim
    return std::atan2(numerator, denominator) / glm::two_pi<double>();
}

double windingNumber(const TriangleMesh& mesh, const glm::dvec3& x) {
    double sum = 0;
    for (const glm::uvec3& face : mesh.triangles)
        sum += windingShare(mesh.points[face.x], mesh.points[face.y], mesh.points[face.z], x);
    return sum;
}

void setFlatNormals(TriangleMesh& mesh) {
    mesh.normals.clear();
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.points[t.x];
        const glm::dvec3 across = glm::cross(mesh.points[t.y] - a, mesh.points[t.z] - a);
        const double length = glm::length(across);
        const glm::vec3 normal(length > 0 ? across / length : across);
        mesh.normals.push_back({normal, normal, normal});
    }
}

size_t dropUnusedPoints(TriangleMesh& mesh) {
    constexpr std::uint32_t kUnused = UINT32_MAX;
    std::vector<glm::dvec3>& points = mesh.points;
    std::vector<std::uint32_t> renamed(points.size(), kUnused);
    for (const glm::uvec3& face : mesh.triangles)
        for (int k = 0; k < 3; ++k) renamed[face[k]] = 0;
    std::uint32_t kept = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        if (renamed[i] == kUnused) continue;
        points[kept] = points[i];
        renamed[i] = kept++;
    }
    for (glm::uvec3& face : mesh.triangles)
        for (int k = 0; k < 3; ++k) face[k] = renamed[face[k]];
    const size_t gone = points.size() - kept;
    points.resize(kept);
    return gone;
}

size_t mergeIdenticalPoints(TriangleMesh& mesh) {
    const std::vector<glm::dvec3>& points = mesh.points;
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(points[a].x, points[a].y, points[a].z, a) <
               std::tie(points[b].x, points[b].y, points[b].z, b);
    });
    // The first of equal points stands for them all: it sorts before the others.
    std::vector<std::uint32_t> first(points.size());
    for (size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    for (glm::uvec3& face : mesh.triangles)
        for (int k = 0; k < 3; ++k) face[k] = first[face[k]];
    return dropUnusedPoints(mesh);
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    if (!mesh.normals.empty() || !other.normals.empty()) {
        mesh.normals.resize(mesh.triangles.size());
        mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
        mesh.normals.resize(mesh.triangles.size() + other.triangles.size());
    }
    for (const glm::uvec3& face : other.triangles) mesh.triangles.push_back(face + first);
}

} // namespace eikonal::mesh
