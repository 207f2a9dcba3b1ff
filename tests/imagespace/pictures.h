// Pictures in image space for tests: one device, small sizes, and what the AOVs say of a pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/device.h"
#include "imagespace/imagespace.h"
#include "mesh/fans.h"
#include "support/shapes.h"

#include <gtest/gtest.h>
#include <optional>
#include <string>

namespace eikonal::imagespace {

inline gpu::Device& device() {
    static gpu::Device one{gpu::DeviceChoice{}};
    return one;
}

/// With the normals of the smooth surface that it stands for.
inline mesh::TriangleMesh smooth(mesh::TriangleMesh mesh) {
    mesh.normals = mesh::cornerNormals(mesh::findFans(mesh, 30));
    return mesh;
}

/// Looks along -Z from (0, 0, 4), every AOV beside the colour.
inline Params paramsFor(int pixels, bool parallel) {
    Params params;
    params.camera.eye = {0, 0, 4};
    params.camera.width = params.camera.rows = pixels;
    params.camera.parallel = parallel;
    params.camera.height = 2.5;
    params.camera.fov = 36;
    params.aovs = allAovs();
    return params;
}

inline image::Image pictureOf(const Params& params, const Body& body,
                              const std::vector<Plate>& plates = {},
                              const std::optional<image::Image>& map = std::nullopt) {
    Stats stats;
    Renderer renderer(device(), params, map, stats);
    renderer.setScene(body, plates);
    return renderer.render({});
}

inline glm::dvec3 valueAt(const image::Image& image, const std::string& layer, int x, int y,
                          const char* components = "XYZ") {
    glm::dvec3 value(0);
    for (int c = 0; c < 3; ++c) {
        const auto channel = image.find(layer + (layer.empty() ? "" : ".") + components[c]);
        if (!channel) throw std::runtime_error("no channel of " + layer);
        value[c] = image.plane(*channel)[static_cast<size_t>(y * image.width + x)];
    }
    return value;
}

/// The direction of a pixel's ray, and where it starts.
struct EyeRay {
    glm::dvec3 start, direction;
};
inline EyeRay eyeRay(const camera::Camera& camera, int x, int y) {
    const camera::CameraAxes axes = camera::axesOf(camera);
    const double half =
        camera.parallel ? camera.height / 2 : std::tan(glm::radians(camera.fov) / 2);
    const glm::dvec2 s =
        glm::dvec2(2, -2) * (glm::dvec2(x, y) + 0.5) / glm::dvec2(camera.width, camera.rows) +
        glm::dvec2(-1, 1);
    const glm::dvec3 aside = half * (s.x * camera.aspect() * axes.right + s.y * axes.up);
    if (camera.parallel) return {camera.eye + aside, axes.forward};
    return {camera.eye, glm::normalize(axes.forward + aside)};
}

inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

} // namespace eikonal::imagespace
