// Camera rays, as the view kernel makes them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/camera_ray.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

using glm::dvec3;

void setCamera(ViewParams& values, const Camera& camera, const scene::Scene& scene) {
    const double h = scene.voxelSize();
    const glm::dmat4 voxelFromWorld = scene.voxelFromWorld();
    const glm::dmat3 turn(glm::dmat3(voxelFromWorld) * h);
    const camera::CameraAxes axes = axesOf(camera);
    const double half =
        camera.parallel ? 0.5 * camera.height / h : std::tan(glm::radians(0.5 * camera.fov));
    const dvec3 eye(voxelFromWorld * glm::dvec4(camera.eye, 1.0));
    const glm::vec3 eyeHigh(eye);
    values.eyeHigh = vec4(eyeHigh, camera.parallel ? 0 : 1);
    values.eyeLow = vec4(glm::vec3(eye - dvec3(eyeHigh)), 0);
    values.forward = vec4(turn * axes.forward, 0);
    values.right = vec4(half * camera.aspect() * (turn * axes.right), 0);
    values.up = vec4(half * (turn * axes.up), 0);
    values.picture = ivec4(camera.width, camera.rows, 0, 0);
}

glm::vec3 cameraDirection(const ViewParams& values, const glm::ivec2& pixel,
                          const glm::vec2& place) {
    const glm::vec2 size(values.picture.x, values.picture.y);
    const glm::vec2 s = glm::vec2(2, -2) * (glm::vec2(pixel) + place) / size + glm::vec2(-1, 1);
    dvec3 towards(values.forward);
    if (values.eyeHigh.w == 1)
        towards += static_cast<double>(s.x) * dvec3(values.right) +
                   static_cast<double>(s.y) * dvec3(values.up);
    return glm::vec3(towards / std::sqrt(glm::dot(towards, towards)));
}

} // namespace eikonal::view
