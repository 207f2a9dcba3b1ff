// Where the eye is, and which way each pixel looks.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/camera.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

namespace eikonal::camera {

using glm::dvec3;
using glm::dvec4;

void Camera::check() const {
    const int kMostPixels = 1 << 17; // EXR readers stop well before this
    requireOption(width >= 1 && rows >= 1 && width <= kMostPixels && rows <= kMostPixels, "--size",
                  std::to_string(width) + "x" + std::to_string(rows),
                  "1 to 131072 pixels each way");
    const double kFar = 1e18; // [unit]; squares stay finite
    for (const dvec3& point : {eye, target, up})
        requireOption(std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <= kFar,
                      "--eye, --target, --up", "a coordinate beyond 1e18", "numbers of less size");
    const dvec3 along = target - eye;
    requireOption(glm::length(along) > 0, "--target", "the eye itself", "another point");
    requireOption(glm::length(up) > 0, "--up", "no direction", "a vector that is not 0");
    const double slant = glm::length(glm::cross(glm::normalize(along), glm::normalize(up)));
    requireOption(slant > 1e-9, "--up", "the viewing direction", "a vector across it");
    if (parallel)
        requireOption(height > 0 && std::isfinite(height), "--ortho", toText(height),
                      "a height above 0");
    else
        requireOption(fov > 0 && fov < 180, "--fov", toText(fov), "above 0 and below 180 degrees");
}

CameraAxes axesOf(const Camera& camera) {
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {forward, right, glm::cross(right, forward)};
}

Eye::Eye(const Camera& camera)
    : mCamera(camera), mAxes(axesOf(camera)),
      mHalf(camera.parallel ? 0.5 * camera.height : std::tan(glm::radians(0.5 * camera.fov))) {}

Ray Eye::rayThrough(const glm::dvec2& place) const {
    const double x = mHalf * mCamera.aspect() * (2 * place.x / mCamera.width - 1);
    const double y = mHalf * (1 - 2 * place.y / mCamera.rows);
    const dvec3 offset = x * mAxes.right + y * mAxes.up;
    if (mCamera.parallel) return {mCamera.eye + offset, mAxes.forward};
    return {mCamera.eye, glm::normalize(mAxes.forward + offset)};
}

glm::dvec2 deflectionOf(const CameraAxes& axes, const dvec3& began, const dvec3& exit) {
    const dvec3 right = glm::normalize(axes.right - glm::dot(axes.right, began) * began);
    const dvec3 up = glm::normalize(axes.up - glm::dot(axes.up, began) * began);
    const double ahead = glm::dot(exit, began);
    return {std::atan2(glm::dot(exit, right), ahead), std::atan2(glm::dot(exit, up), ahead)};
}

glm::dmat4 cameraFromWorld(const Camera& camera) {
    const CameraAxes axes = axesOf(camera);
    glm::dmat4 matrix(1.0);
    for (int c = 0; c < 3; ++c) {
        matrix[c][0] = axes.right[c];
        matrix[c][1] = axes.up[c];
        matrix[c][2] = axes.forward[c];
    }
    matrix[3] = dvec4(-glm::dot(axes.right, camera.eye), -glm::dot(axes.up, camera.eye),
                      -glm::dot(axes.forward, camera.eye), 1.0);
    return matrix;
}

glm::dmat4 ndcFromCamera(const Camera& camera) {
    glm::dmat4 matrix(0.0);
    if (camera.parallel) {
        matrix[0][0] = 1.0 / (camera.height * camera.aspect());
        matrix[1][1] = -1.0 / camera.height;
        matrix[2][2] = 1.0;
        matrix[3] = dvec4(0.5, 0.5, 0.0, 1.0);
    } else {
        // Depth goes from 0 at this distance to 1 far off; pictures carry Z itself.
        const double near = 0.01 * glm::length(camera.target - camera.eye);
        const double half = std::tan(glm::radians(0.5 * camera.fov));
        matrix[0][0] = 0.5 / (half * camera.aspect());
        matrix[1][1] = -0.5 / half;
        matrix[2] = dvec4(0.5, 0.5, 1.0, 1.0);
        matrix[3] = dvec4(0.0, 0.0, -near, 0.0);
    }
    return matrix;
}

void describeCamera(const Camera& camera, image::ImageAttributes& attributes) {
    attributes.hasCamera = true;
    attributes.worldToCamera = cameraFromWorld(camera);
    attributes.worldToNDC = ndcFromCamera(camera) * cameraFromWorld(camera);
}

} // namespace eikonal::camera
