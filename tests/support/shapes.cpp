// Closed shapes of known size, for tests and benchmarks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <map>
#include <utility>

namespace eikonal::mesh {

namespace {

TriangleMesh icosahedron() {
    const double phi = glm::golden_ratio<double>();
    TriangleMesh mesh;
    mesh.points = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                   {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                   {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return mesh;
}

void subdivide(TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto next = static_cast<std::uint32_t>(mesh.points.size());
        const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), next);
        if (isNew) mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
        return found->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& face : mesh.triangles) {
        const glm::uvec3 m(middle(face.x, face.y), middle(face.y, face.z), middle(face.z, face.x));
        finer.insert(finer.end(), {{face.x, m.x, m.z}, {face.y, m.y, m.x}, {face.z, m.z, m.y}, m});
    }
    mesh.triangles = std::move(finer);
}

} // namespace

TriangleMesh boxShape(const glm::dvec3& min, const glm::dvec3& max) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.emplace_back(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y,
                                 i & 4 ? max.z : min.z);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh icosphere(double radius, int subdivisions) {
    TriangleMesh mesh = icosahedron();
    for (int level = 0; level < subdivisions; ++level) {
        subdivide(mesh);
        for (glm::dvec3& point : mesh.points) point = glm::normalize(point);
    }
    for (glm::dvec3& point : mesh.points) point = radius * glm::normalize(point);
    return mesh;
}

TriangleMesh uvSphere(double radius, size_t triangleCount) {
    // With 2n meridians n bands of latitude have 4n(n - 1) triangles, the bands at the poles half
    // as many as the others.
    const double ideal = 0.5 * (1 + std::sqrt(1 + static_cast<double>(triangleCount)));
    const auto bands = static_cast<std::uint32_t>(std::max(2.0, std::round(ideal)));
    const std::uint32_t meridians = std::max(6u, 2 * bands);
    TriangleMesh mesh;
    mesh.points.emplace_back(0, radius, 0);
    for (std::uint32_t i = 1; i < bands; ++i) {
        const double theta = glm::pi<double>() * i / bands;
        for (std::uint32_t j = 0; j < meridians; ++j) {
            const double phi = glm::two_pi<double>() * j / meridians;
            mesh.points.push_back(radius * glm::dvec3(std::sin(theta) * std::sin(phi),
                                                      std::cos(theta),
                                                      std::sin(theta) * std::cos(phi)));
        }
    }
    mesh.points.emplace_back(0, -radius, 0);
    const auto at = [&](std::uint32_t ring, std::uint32_t j) {
        return 1 + (ring - 1) * meridians + j % meridians;
    };
    const auto south = static_cast<std::uint32_t>(mesh.points.size() - 1);
    for (std::uint32_t j = 0; j < meridians; ++j) {
        mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (std::uint32_t ring = 1; ring + 1 < bands; ++ring) {
            mesh.triangles.push_back({at(ring, j), at(ring + 1, j), at(ring + 1, j + 1)});
            mesh.triangles.push_back({at(ring, j), at(ring + 1, j + 1), at(ring, j + 1)});
        }
        mesh.triangles.push_back({south, at(bands - 1, j + 1), at(bands - 1, j)});
    }
    return mesh;
}

TriangleMesh turned(const std::vector<glm::dvec2>& profile, int steps, bool ring) {
    TriangleMesh mesh;
    const auto at = [&](size_t i, int step) {
        const double angle = glm::two_pi<double>() * (step % steps) / steps;
        const glm::dvec2& p = profile[i % profile.size()];
        return glm::dvec3(p.x * std::sin(angle), p.y, p.x * std::cos(angle));
    };
    const size_t rows = ring ? profile.size() : profile.size() - 1;
    for (size_t i = 0; i < rows; ++i)
        for (int step = 0; step < steps; ++step) {
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            for (const auto& [row, k] :
                 {std::pair{i, step}, {i, step + 1}, {i + 1, step + 1}, {i + 1, step}})
                mesh.points.push_back(at(row, k));
            if (profile[i].x > 0) mesh.triangles.emplace_back(first, first + 1, first + 2);
            if (profile[(i + 1) % profile.size()].x > 0)
                mesh.triangles.emplace_back(first, first + 2, first + 3);
        }
    mergeIdenticalPoints(mesh);
    return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both = a;
    const glm::uvec3 offset(static_cast<std::uint32_t>(a.points.size()));
    both.points.insert(both.points.end(), b.points.begin(), b.points.end());
    for (const glm::uvec3& face : b.triangles) both.triangles.push_back(face + offset);
    return both;
}

TriangleMesh turnedInsideOut(TriangleMesh mesh) {
    for (glm::uvec3& face : mesh.triangles) std::swap(face.y, face.z);
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const glm::dvec3& offset) {
    for (glm::dvec3& point : mesh.points) point += offset;
    return mesh;
}

} // namespace eikonal::mesh
