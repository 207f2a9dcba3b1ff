// Bodies and pictures that tests of exact tracing share.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/fans.h"
#include "raytrace/raytrace.h"
#include "support/shapes.h"

#include <string>
#include <utility>

namespace eikonal::raytrace {

inline mesh::TriangleMesh smooth(mesh::TriangleMesh mesh, double degrees = 30) {
    mesh.normals = mesh::cornerNormals(mesh::findFans(mesh, degrees));
    return mesh;
}

inline Body glass(mesh::TriangleMesh mesh, double ior = 1.5, const glm::dvec3& absorption = {}) {
    return {"glass", std::move(mesh), ior, absorption, false, glm::dvec3(0)};
}

inline Body plate(mesh::TriangleMesh mesh, const glm::dvec3& albedo) {
    return {"plate", std::move(mesh), 1.5, glm::dvec3(0), true, albedo};
}

/// From `eye` towards the origin.
inline Params lookingFrom(const glm::dvec3& eye, int size, std::vector<std::string> aovs = {}) {
    Params params;
    params.camera.eye = eye;
    params.camera.fov = 40;
    params.camera.width = params.camera.rows = size;
    params.aovs = std::move(aovs);
    return params;
}

inline image::Image rendered(const Params& params, const std::vector<Body>& bodies) {
    Stats stats;
    return render(params, bodies, std::nullopt, stats, {});
}

/// Channels NAME.X, .Y, .Z of a pixel.
inline glm::dvec3 vectorAt(const image::Image& image, const std::string& name, size_t pixel,
                           const std::string& letters = "XYZ") {
    glm::dvec3 v(0);
    for (int c = 0; c < 3; ++c) {
        const std::string channel = name + letters[static_cast<size_t>(c)];
        v[c] = image.plane(image.find(channel).value())[pixel];
    }
    return v;
}

inline glm::dvec3 colourAt(const image::Image& image, size_t pixel) {
    return vectorAt(image, "", pixel, "RGB");
}

/// The direction of a pixel's ray, of length 1.
inline glm::dvec3 rayOf(const camera::Camera& camera, size_t pixel) {
    const camera::CameraAxes axes = camera::axesOf(camera);
    const double half = std::tan(glm::radians(0.5 * camera.fov));
    const auto width = static_cast<size_t>(camera.width);
    const double x = half * camera.aspect() *
                     (2 * (static_cast<double>(pixel % width) + 0.5) / camera.width - 1);
    const double y = half * (1 - 2 * (static_cast<double>(pixel / width) + 0.5) / camera.rows);
    return glm::normalize(axes.forward + x * axes.right + y * axes.up);
}

inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

} // namespace eikonal::raytrace
