// Plain solids: box, sphere, prism.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/solids.h"

#include "base/error.h"
#include "base/text.h"
#include "mesh/triangulate.h"

#include <cmath>
#include <numbers>

namespace eikonal::shapes {

using mesh::TriangleMesh;
using std::numbers::pi;

void BoxParams::check() const {
    for (int axis = 0; axis < 3; ++axis)
        requireOption(high[axis] > low[axis], "--to", toText(high[axis]) + " along " + "XYZ"[axis],
                      "more than " + toText(low[axis]) + ", which --from has there");
}

TriangleMesh makeBox(const BoxParams& params) {
    TriangleMesh box;
    for (unsigned corner = 0; corner < 8; ++corner)
        box.points.emplace_back((corner & 1 ? params.high : params.low).x,
                                (corner & 2 ? params.high : params.low).y,
                                (corner & 4 ? params.high : params.low).z);
    for (const auto& quad : {std::array{0u, 2u, 3u, 1u},
                             {4u, 5u, 7u, 6u},
                             {0u, 1u, 5u, 4u},
                             {2u, 6u, 7u, 3u},
                             {0u, 4u, 6u, 2u},
                             {1u, 3u, 7u, 5u}})
        mesh::appendTriangles(box.points, {quad.begin(), quad.end()}, box.triangles);
    return box;
}

void SphereParams::check() const {
    requireOption(radius > 0 && std::isfinite(radius), "--radius", toText(radius), "above 0");
    requireOption(segments >= 4 && segments <= 8192 && segments % 2 == 0, "--segments",
                  std::to_string(segments), "an even number from 4 to 8192");
}

TriangleMesh makeSphere(const SphereParams& params) {
    const auto around = static_cast<std::uint32_t>(params.segments), down = around / 2;
    TriangleMesh sphere;
    sphere.points.emplace_back(0, params.radius, 0);
    for (std::uint32_t j = 1; j < down; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double t = pi * j / down, p = 2 * pi * i / around;
            sphere.points.push_back(params.radius * glm::dvec3(std::sin(t) * std::sin(p),
                                                               std::cos(t),
                                                               std::sin(t) * std::cos(p)));
        }
    sphere.points.emplace_back(0, -params.radius, 0);
    const std::uint32_t last = 1 + (down - 1) * around, lowest = last - around;
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        sphere.triangles.emplace_back(0, 1 + i, 1 + next);
        for (std::uint32_t j = 0; j + 2 < down; ++j) {
            const std::uint32_t a = 1 + j * around;
            mesh::appendTriangles(sphere.points,
                                  {a + i, a + around + i, a + around + next, a + next},
                                  sphere.triangles);
        }
        sphere.triangles.emplace_back(last, lowest + next, lowest + i);
    }
    return sphere;
}

void PrismParams::check() const {
    requireOption(sides >= 3 && sides <= 4096, "--sides", std::to_string(sides), "3 to 4096");
    requireOption(side > 0 && std::isfinite(side), "--side", toText(side), "above 0");
    requireOption(length > 0 && std::isfinite(length), "--length", toText(length), "above 0");
    if (!apex) return;
    requireOption(*apex > 0 && *apex < 180, "--angle", toText(*apex), "above 0, below 180 degrees");
    if (sides != 3)
        throw UsageError("--angle: belongs to a prism of 3 sides, not " + std::to_string(sides));
}

TriangleMesh makePrism(const PrismParams& params) {
    std::vector<glm::dvec2> corners;
    if (params.apex) {
        const double height = params.side / 2 / std::tan(*params.apex * pi / 360);
        corners = {
            {0, height * 2 / 3}, {-params.side / 2, -height / 3}, {params.side / 2, -height / 3}};
    } else {
        const double radius = params.side / 2 / std::sin(pi / params.sides);
        for (int k = 0; k < params.sides; ++k) {
            const double a = pi / 2 + 2 * pi * k / params.sides;
            corners.push_back(radius * glm::dvec2(std::cos(a), std::sin(a)));
        }
    }
    const auto count = static_cast<std::uint32_t>(corners.size());
    TriangleMesh prism;
    std::vector<std::uint32_t> back, front;
    for (const double end : {-0.5, 0.5})
        for (const glm::dvec2& corner : corners)
            prism.points.emplace_back(corner, end * params.length);
    for (std::uint32_t k = 0; k < count; ++k) {
        back.push_back((count - k) % count);
        front.push_back(count + k);
    }
    mesh::appendTriangles(prism.points, back, prism.triangles);
    mesh::appendTriangles(prism.points, front, prism.triangles);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t next = (k + 1) % count;
        mesh::appendTriangles(prism.points, {k, next, count + next, count + k}, prism.triangles);
    }
    mesh::setFlatNormals(prism);
    return prism;
}

} // namespace eikonal::shapes
