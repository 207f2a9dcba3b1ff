// A picture behind the scene, as the view kernel reads it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "scene/scene.h"
#include "view/params.h"
#include "view/shared.h"

namespace eikonal::view {

/// Where the plate is in a scene's voxel space.
PlateParams plateParams(const Plate& plate, const Camera& camera, const scene::Scene& scene);

/// Its picture, interpolated between pixels.
gpu::Texture makePlateTexture(gpu::Device& device, const Plate& plate);

gpu::Need plateNeed(const Plate& plate);

} // namespace eikonal::view
