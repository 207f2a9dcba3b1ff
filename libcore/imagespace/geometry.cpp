// Meshes as the device draws them, and where they are seen.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

namespace eikonal::imagespace {

using glm::dvec3;
using glm::vec3;

namespace {

/// Makes vertices of corners: a point's are few, so that a list of them is searched from its start.
class Vertices {
public:
    Vertices(size_t points, Geometry& geometry)
        : mFirst(points, kNone),
          mBefore(static_cast<std::uint32_t>(geometry.vertices.size() /
                                             static_cast<size_t>(6 + geometry.extra))),
          mGeometry(geometry) {}

    std::uint32_t of(std::uint32_t point, const vec3& normal, const auto& write) {
        std::uint32_t* link = &mFirst[point];
        while (*link != kNone) {
            if (mNormals[*link] == normal) return mBefore + *link;
            link = &mNext[*link];
        }
        const auto made = static_cast<std::uint32_t>(mNormals.size());
        *link = made;
        mNormals.push_back(normal);
        mNext.push_back(kNone); // may move what `link` points to
        write(mGeometry.vertices);
        return mBefore + made;
    }

private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::vector<std::uint32_t> mFirst, mNext;
    std::vector<vec3> mNormals;
    std::uint32_t mBefore; ///< other meshes' vertices
    Geometry& mGeometry;
};

mesh::Box boxOf(const std::vector<const mesh::TriangleMesh*>& meshes) {
    mesh::Box box;
    for (const mesh::TriangleMesh* one : meshes) box.include(mesh::boundingBox(*one));
    return box;
}

Geometry emptyIn(const mesh::Box& box, int extra) {
    Geometry geometry;
    geometry.middle = 0.5 * (box.min + box.max);
    geometry.radius = 0.5 * glm::length(box.max - box.min);
    geometry.extra = extra;
    return geometry;
}

/// Puts two zeros before each of the ten low bits.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000FFu;
    bits = (bits | bits << 8) & 0x0300F00Fu;
    bits = (bits | bits << 4) & 0x030C30C3u;
    return (bits | bits << 2) & 0x09249249u;
}

/// `extraOf(out, point)` writes what a vertex has beside place and normal.
void add(Geometry& geometry, const mesh::TriangleMesh& mesh, const auto& extraOf) {
    geometry.vertices.reserve(geometry.vertices.size() +
                              mesh.points.size() * static_cast<size_t>(6 + geometry.extra));
    geometry.indices.reserve(geometry.indices.size() + mesh.triangles.size() * 3);
    Vertices vertices(mesh.points.size(), geometry);
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const glm::uvec3& face = mesh.triangles[f];
        const dvec3 a = mesh.points[face.x], b = mesh.points[face.y], c = mesh.points[face.z];
        const dvec3 across = glm::cross(b - a, c - a);
        const double area = glm::length(across);
        if (!(area > 0)) continue; // is not seen from anywhere
        const vec3 flat(across / area);
        for (int k = 0; k < 3; ++k) {
            vec3 normal = mesh.normals.empty() ? flat : mesh.normals[f][static_cast<size_t>(k)];
            if (normal == vec3(0)) normal = flat;
            geometry.indices.push_back(vertices.of(face[k], normal, [&](std::vector<float>& out) {
                const vec3 place(mesh.points[face[k]] - geometry.middle);
                out.insert(out.end(), {place.x, place.y, place.z, normal.x, normal.y, normal.z});
                extraOf(out, face[k]);
            }));
        }
    }
}

} // namespace

Geometry geometryOf(const Body& body) {
    Geometry geometry = emptyIn(mesh::boundingBox(body.mesh), body.distances.empty() ? 0 : 1);
    add(geometry, body.mesh, [&](std::vector<float>& out, std::uint32_t point) {
        if (!body.distances.empty()) out.push_back(body.distances[point]);
    });
    return geometry;
}

Geometry geometryOf(const std::vector<Plate>& plates) {
    std::vector<const mesh::TriangleMesh*> meshes;
    for (const Plate& plate : plates) meshes.push_back(&plate.mesh);
    Geometry geometry = emptyIn(boxOf(meshes), 3);
    for (const Plate& plate : plates)
        add(geometry, plate.mesh, [&](std::vector<float>& out, std::uint32_t) {
            const vec3 albedo(plate.albedo);
            out.insert(out.end(), {albedo.x, albedo.y, albedo.z});
        });
    return geometry;
}

std::vector<std::uint32_t> nearbyOrder(const Geometry& geometry) {
    const auto floats = static_cast<size_t>(6 + geometry.extra);
    const auto radius = static_cast<float>(geometry.radius);
    const auto place = [&](std::uint32_t vertex) {
        const float* x = &geometry.vertices[vertex * floats];
        return vec3(x[0], x[1], x[2]);
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keys(geometry.indices.size() / 3);
    for (std::uint32_t t = 0; t < keys.size(); ++t) {
        const std::uint32_t* corner = &geometry.indices[3 * size_t{t}];
        const vec3 middle = (place(corner[0]) + place(corner[1]) + place(corner[2])) / 3.0f;
        const glm::uvec3 cell(glm::clamp(512.0f * (middle / radius + 1.0f), 0.0f, 1023.0f));
        keys[t] = {spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, t};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(keys.size());
    for (size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
    return order;
}

void reorder(Geometry& geometry, std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> indices;
    indices.reserve(geometry.indices.size());
    for (const std::uint32_t t : order) {
        const std::uint32_t* corner = &geometry.indices[3 * size_t{t}];
        indices.insert(indices.end(), corner, corner + 3);
    }
    geometry.indices = std::move(indices);
}

Sides sortBySide(Geometry& geometry, const camera::Camera& camera) {
    const glm::mat4 toCamera = cameraFromBody(camera, geometry);
    const float window = camera.parallel
                             ? static_cast<float>(0.5 * camera.height)
                             : static_cast<float>(std::tan(glm::radians(0.5 * camera.fov)));
    const float scale = 0.5f * static_cast<float>(camera.rows) / window; // [pixel]
    const float nearest = camera.parallel ? -std::numeric_limits<float>::max()
                                          : static_cast<float>(1e-3 * geometry.radius);
    const auto floats = static_cast<size_t>(6 + geometry.extra);
    // On the picture, y up, and the depth.
    std::vector<vec3> seen(geometry.vertices.size() / floats);
    for (size_t i = 0; i < seen.size(); ++i) {
        const float* place = &geometry.vertices[i * floats];
        const vec3 x(toCamera * glm::vec4(place[0], place[1], place[2], 1));
        seen[i] = vec3(glm::vec2(x) * (scale / (camera.parallel ? 1 : x.z)), x.z);
    }
    std::vector<std::uint32_t> front, either, back;
    for (size_t k = 0; k < geometry.indices.size(); k += 3) {
        const std::uint32_t* corner = &geometry.indices[k];
        const vec3 &a = seen[corner[0]], &b = seen[corner[1]], &c = seen[corner[2]];
        const glm::vec2 ab = b - a, ac = c - a;
        const float area = ab.x * ac.y - ab.y * ac.x;
        // Devices snap corners to a share of a pixel, 1/16 at most.
        const float unsure =
            0.25f * (std::abs(ab.x) + std::abs(ab.y) + std::abs(ac.x) + std::abs(ac.y)) + 0.02f;
        const bool tells = std::min({a.z, b.z, c.z}) > nearest && std::abs(area) > unsure;
        auto& list = !tells ? either : area > 0 ? front : back;
        list.insert(list.end(), corner, corner + 3);
    }
    const auto count = [](const auto& list) { return static_cast<std::int64_t>(list.size() / 3); };
    const Sides sides{{0, count(front) + count(either)},
                      {count(front), count(either) + count(back)}};
    geometry.indices = std::move(front);
    geometry.indices.insert(geometry.indices.end(), either.begin(), either.end());
    geometry.indices.insert(geometry.indices.end(), back.begin(), back.end());
    return sides;
}

gpu::Triangles trianglesOf(gpu::Device& device, const Geometry& geometry) {
    std::vector<int> sizes{3, 3};
    if (geometry.extra > 0) sizes.push_back(geometry.extra);
    return {device, geometry.vertices, sizes, geometry.indices};
}

Depths depthsOf(const camera::Camera& camera, std::span<const Geometry* const> all) {
    const camera::CameraAxes axes = camera::axesOf(camera);
    double nearest = 1e300, furthest = 0, size = 0;
    for (const Geometry* one : all) {
        const double depth = glm::dot(one->middle - camera.eye, axes.forward);
        nearest = std::min(nearest, depth - one->radius);
        furthest = std::max(furthest, depth + one->radius);
        size = std::max(size, one->radius);
    }
    // Nearer to the eye than this share of a body its triangles are not seen.
    const double near = std::max(nearest * 0.999, 1e-5 * size);
    return {near, std::max(furthest * 1.001, 2 * near)};
}

glm::mat4 cameraFromBody(const camera::Camera& camera, const Geometry& geometry) {
    const glm::dmat4 fromWorld = camera::cameraFromWorld(camera);
    return glm::mat4(fromWorld * glm::translate(glm::dmat4(1), geometry.middle));
}

glm::mat4 clipFromCamera(const camera::Camera& camera, const Depths& depths,
                         const glm::dvec2& place) {
    const double half =
        camera.parallel ? 0.5 * camera.height : std::tan(glm::radians(0.5 * camera.fov));
    const glm::dvec2 shift = (1.0 - 2.0 * place) / glm::dvec2(camera.width, camera.rows);
    glm::dmat4 clip(0);
    clip[0][0] = 1 / (half * camera.aspect());
    clip[1][1] = -1 / half;
    if (camera.parallel) {
        const double extent = depths.far - depths.near;
        clip[2][2] = -1 / extent;
        clip[3] = glm::dvec4(shift, depths.far / extent, 1);
    } else {
        clip[2] = glm::dvec4(shift, 0, 1); // w is the depth
        clip[3][2] = depths.near;
    }
    return glm::mat4(clip);
}

} // namespace eikonal::imagespace
