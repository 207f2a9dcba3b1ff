// The camera's matrices, as a picture's header carries them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

void describeCamera(const Camera& camera, image::ImageAttributes& attributes) {
    using glm::dvec3;
    using glm::dvec4;
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    glm::dmat4 cameraFromWorld(1.0);
    for (int c = 0; c < 3; ++c) {
        cameraFromWorld[c][0] = right[c];
        cameraFromWorld[c][1] = up[c];
        cameraFromWorld[c][2] = forward[c];
    }
    cameraFromWorld[3] = dvec4(-glm::dot(right, camera.eye), -glm::dot(up, camera.eye),
                               -glm::dot(forward, camera.eye), 1.0);
    const double aspect = static_cast<double>(camera.width) / camera.rows;
    glm::dmat4 ndcFromCamera(0.0);
    if (camera.parallel) {
        ndcFromCamera[0][0] = 1.0 / (camera.height * aspect);
        ndcFromCamera[1][1] = -1.0 / camera.height;
        ndcFromCamera[2][2] = 1.0;
        ndcFromCamera[3] = dvec4(0.5, 0.5, 0.0, 1.0);
    } else {
        // Depth goes from 0 at this distance to 1 far off; pictures carry Z itself.
        const double near = 0.01 * glm::length(camera.target - camera.eye);
        const double half = std::tan(glm::radians(0.5 * camera.fov));
        ndcFromCamera[0][0] = 0.5 / (half * aspect);
        ndcFromCamera[1][1] = -0.5 / half;
        ndcFromCamera[2] = dvec4(0.5, 0.5, 1.0, 1.0);
        ndcFromCamera[3] = dvec4(0.0, 0.0, -near, 0.0);
    }
    attributes.hasCamera = true;
    attributes.worldToCamera = cameraFromWorld;
    attributes.worldToNDC = ndcFromCamera * cameraFromWorld;
}

} // namespace eikonal::view
