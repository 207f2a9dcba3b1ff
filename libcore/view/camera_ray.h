// Camera rays, as the view kernel makes them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"
#include "view/params.h"
#include "view/shared.h"

#include <glm/vec2.hpp>

namespace eikonal::view {

/// Fills in the picture's size, the eye and the camera's axes in a scene's voxel space.
void setCamera(ViewParams& values, const Camera& camera, const scene::Scene& scene);

/// The direction of a pixel's ray that goes through a place in it, from (0, 0) to (1, 1): of length
/// 1, in voxel space, rounded as cameraRayOf() of shaders/view/camera_ray.glsl rounds it.
glm::vec3 cameraDirection(const ViewParams& values, const glm::ivec2& pixel,
                          const glm::vec2& place);

} // namespace eikonal::view
