// Convex, concave and thin bodies of glass.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/bodies.h"

#include "mesh/fans.h"
#include "mesh/smooth_surface.h"
#include "support/shapes.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace eikonal::mesh {

namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kAround = 256; ///< steps of what is turned

/// A profile from the lower pole to the upper one, its radius by its height's angle.
template<typename At> TriangleMesh byProfile(int steps, const At& at) {
    std::vector<dvec2> profile;
    for (int i = 0; i <= steps; ++i) {
        dvec2 p = at(std::numbers::pi * (static_cast<double>(i) / steps - 0.5));
        if (i == 0 || i == steps) p.x = 0;
        profile.push_back(p);
    }
    return turned(profile, kAround, false);
}

/// Two caps of a sphere of radius 1.25 that meet in a circle of radius 1.
TriangleMesh lens() {
    const double edge = std::asin(1 / 1.25), deep = 1.25 * std::cos(edge);
    std::vector<dvec2> profile;
    const int steps = 64;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < steps + (side > 0); ++i) {
            const double share = static_cast<double>(i) / steps;
            const double angle = edge * (side < 0 ? share : 1 - share);
            const double x = angle == 0 ? 0 : 1.25 * std::sin(angle);
            profile.emplace_back(x, side * (1.25 * std::cos(angle) - deep));
        }
    return turned(profile, kAround, false);
}

/// Half a sphere's shell, its wall a fortieth of its radius, with a round rim.
TriangleMesh bowl() {
    const double thick = 1.0 / 40, middle = 1 - thick / 2;
    std::vector<dvec2> profile;
    const int steps = 96, rim = 12;
    for (int i = 0; i <= steps; ++i) { // outside, from below
        const double a = 0.5 * std::numbers::pi * i / steps;
        profile.emplace_back(i == 0 ? 0 : std::sin(a), -std::cos(a));
    }
    for (int i = 1; i < rim; ++i) {
        const double a = std::numbers::pi * i / rim;
        profile.emplace_back(middle + thick / 2 * std::cos(a), thick / 2 * std::sin(a));
    }
    for (int i = steps; i >= 0; --i) {
        const double a = 0.5 * std::numbers::pi * i / steps;
        profile.emplace_back(i == 0 ? 0 : (1 - thick) * std::sin(a), -(1 - thick) * std::cos(a));
    }
    return moved(turned(profile, kAround, false), {0, 0.5, 0});
}

TriangleMesh ring() {
    std::vector<dvec2> profile;
    const int steps = 96;
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * std::numbers::pi * i / steps;
        profile.emplace_back(0.7 + 0.3 * std::cos(a), 0.3 * std::sin(a));
    }
    return turned(profile, kAround, true);
}

TriangleMesh bumpy() {
    TriangleMesh mesh = icosphere(1, 6);
    for (dvec3& x : mesh.points)
        x *= 0.85 + 0.12 * std::sin(5 * x.x) * std::sin(6 * x.y + 1) * std::sin(5 * x.z + 2);
    return mesh;
}

} // namespace

std::vector<SampleBody> sampleBodies() {
    const TriangleMesh peanut = byProfile(192, [](double a) {
        const double radius = std::cos(a) * (1 - 0.45 * std::exp(-18 * std::sin(a) * std::sin(a)));
        return dvec2(0.75 * radius, std::sin(a));
    });
    std::vector<SampleBody> bodies = {
        {"sphere", BodyKind::convex, icosphere(1, 6), {0.8, 1.2, 3.8}},
        {"lens", BodyKind::convex, lens(), {0.6, 3.2, 2.4}},
        {"box", BodyKind::convex, boxShape(dvec3(-0.6), dvec3(0.6)), {1.7, 1.4, 3.4}},
        {"peanut", BodyKind::concave, peanut, {1.5, 0.9, 3.7}},
        {"ring", BodyKind::concave, ring(), {0.4, 2.9, 2.9}},
        {"bumpy sphere", BodyKind::concave, bumpy(), {0.8, 1.2, 3.8}},
        {"bowl", BodyKind::thin, bowl(), {0.3, 2.3, 3.4}},
        {"pane", BodyKind::thin, boxShape({-0.9, -0.7, -0.02}, {0.9, 0.7, 0.02}), {1.6, 0.9, 3.7}},
    };
    for (SampleBody& body : bodies)
        body.mesh.normals = cornerNormals(findFans(body.mesh, kUsualSmooth));
    return bodies;
}

} // namespace eikonal::mesh
