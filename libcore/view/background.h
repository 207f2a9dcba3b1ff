// What surrounds the scene: a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "image/image.h"
#include "scene/scene.h"
#include "view/params.h"
#include "view/shared.h"

#include <optional>

namespace eikonal::view {

/// The map as a texture; none if there is none.
gpu::Texture makeMap(gpu::Device& device, const std::optional<image::Image>& map);

/// What it takes on the device, at most.
gpu::Need mapNeed(const image::Image& map);

/// Tells the kernel what rays see that leave the domain.
void tellBackground(ViewParams& values, const scene::Scene& scene, const Params& params,
                    const std::optional<image::Image>& map);

} // namespace eikonal::view
