// A picture behind the scene, as the view kernel reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/plate.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

namespace {

/// Of the whole plate [unit]: that of --plate-height, or such that it covers the view.
double heightOf(const Plate& plate, const Camera& camera) {
    if (plate.height > 0) return plate.height;
    const double view = camera.parallel
                            ? camera.height
                            : 2 * plate.distance * std::tan(glm::radians(0.5 * camera.fov));
    const double aspect = static_cast<double>(plate.picture.width) / plate.picture.height;
    return view * std::max(1.0, camera.aspect() / aspect);
}

} // namespace

PlateParams plateParams(const Plate& plate, const Camera& camera, const scene::Scene& scene) {
    const camera::CameraAxes axes = camera::axesOf(camera);
    const glm::dmat4 voxelFromWorld = scene.voxelFromWorld();
    const double h = scene.voxelSize();
    const glm::dmat3 turn(glm::dmat3(voxelFromWorld) * h);
    const double height = heightOf(plate, camera) / h; // [voxel]
    const double width = height * plate.picture.width / plate.picture.height;
    const glm::dvec3 middle = camera.eye + plate.distance * axes.forward;
    return {vec4(glm::vec3(voxelFromWorld * glm::dvec4(middle, 1.0)), plate.endless),
            vec4(turn * axes.forward, 0), vec4(turn * axes.right * (2 / width), 0),
            vec4(turn * axes.up * (2 / height), 0)};
}

gpu::Texture makePlateTexture(gpu::Device& device, const Plate& plate) {
    return camera::makeMap(device, plate.picture, gpu::Filter::linear);
}

gpu::Need plateNeed(const Plate& plate) {
    gpu::Need need = camera::mapNeed(plate.picture);
    need.what = "the plate";
    return need;
}

} // namespace eikonal::view
