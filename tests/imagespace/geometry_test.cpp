// Which triangles are drawn for which side, and in which order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/geometry.h"
#include "imagespace/pictures.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

namespace eikonal::imagespace {
namespace {

using Corners = std::array<std::uint32_t, 3>;

std::vector<Corners> cornersOf(const Geometry& geometry, const gpu::Triangles::Part& part) {
    std::vector<Corners> list;
    for (std::int64_t t = part.first; t < part.first + part.count; ++t) {
        const std::uint32_t* corner = &geometry.indices[static_cast<size_t>(3 * t)];
        list.push_back({corner[0], corner[1], corner[2]});
    }
    return list;
}

std::vector<Corners> allOf(const Geometry& geometry) {
    auto list = cornersOf(geometry, {0, static_cast<std::int64_t>(geometry.indices.size() / 3)});
    std::sort(list.begin(), list.end());
    return list;
}

glm::dvec3 placeOf(const Geometry& geometry, std::uint32_t vertex) {
    const float* x = &geometry.vertices[vertex * static_cast<size_t>(6 + geometry.extra)];
    return geometry.middle + glm::dvec3(x[0], x[1], x[2]);
}

/// The cosine between a triangle's normal and the way to the eye.
double turnOf(const Geometry& geometry, const Corners& t, const camera::Camera& camera) {
    const glm::dvec3 a = placeOf(geometry, t[0]), b = placeOf(geometry, t[1]),
                     c = placeOf(geometry, t[2]);
    const glm::dvec3 toEye =
        camera.parallel ? camera.eye - camera.target : camera.eye - (a + b + c) / 3.0;
    return glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(toEye));
}

TEST(MeshSides, HoldWhatIsSeenFromThere) {
    for (const bool parallel : {false, true}) {
        camera::Camera camera = paramsFor(512, parallel).camera;
        camera.eye = {1, 1.5, 3};
        Geometry geometry = geometryOf({smooth(mesh::icosphere(1, 4)), {}});
        const auto before = allOf(geometry);
        const Sides sides = sortBySide(geometry, camera);
        EXPECT_EQ(allOf(geometry), before);
        const auto front = cornersOf(geometry, sides.front), back = cornersOf(geometry, sides.back);
        EXPECT_EQ(sides.back.first + sides.back.count, static_cast<std::int64_t>(before.size()));
        EXPECT_EQ(sides.front.first, 0);
        for (const Corners& t : front) EXPECT_GT(turnOf(geometry, t, camera), -0.2);
        for (const Corners& t : back) EXPECT_LT(turnOf(geometry, t, camera), 0.2);
        // Each is in one of them; few are in both.
        EXPECT_GE(front.size() + back.size(), before.size());
        EXPECT_LT(front.size() + back.size(), before.size() * 6 / 5);
        auto seen = front;
        seen.insert(seen.end(), back.begin(), back.end());
        std::sort(seen.begin(), seen.end());
        seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
        EXPECT_EQ(seen.size(), before.size());
    }
}

TEST(MeshSides, AreNotToldFromWithinReachOfTheEye) {
    // Corners behind the eye have no place in the picture.
    camera::Camera camera = paramsFor(64, false).camera;
    camera.eye = {0, 0, 1.5};
    Geometry geometry = geometryOf({mesh::boxShape({-1, -1, -1}, {1, 1, 1}), {}});
    camera.target = {5, 0, 1.5};
    const Sides sides = sortBySide(geometry, camera);
    EXPECT_GT(sides.front.count + sides.back.count, 12);
}

TEST(MeshOrder, KeepsNeighboursTogether) {
    Geometry geometry = geometryOf({smooth(mesh::icosphere(1, 4)), {}});
    std::vector<std::uint32_t> shuffled(geometry.indices.size() / 3);
    std::iota(shuffled.begin(), shuffled.end(), 0u);
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
    reorder(geometry, shuffled);
    const auto before = allOf(geometry);
    reorder(geometry, nearbyOrder(geometry));
    EXPECT_EQ(allOf(geometry), before);
    // Different vertices of 64 triangles in a row: a patch of the sphere has half as many, and its
    // rim.
    const auto list = cornersOf(geometry, {0, static_cast<std::int64_t>(before.size())});
    double most = 0, sum = 0;
    for (size_t first = 0; first + 64 <= list.size(); first += 64) {
        std::vector<std::uint32_t> used;
        for (size_t t = first; t < first + 64; ++t)
            used.insert(used.end(), list[t].begin(), list[t].end());
        std::sort(used.begin(), used.end());
        const double count =
            static_cast<double>(std::unique(used.begin(), used.end()) - used.begin());
        most = std::max(most, count);
        sum += count;
    }
    EXPECT_LT(sum / static_cast<double>(list.size() / 64), 64); // shuffled 180
    EXPECT_LT(most, 100);
}

} // namespace
} // namespace eikonal::imagespace
