// A traced picture in the making: colours and first paths, pixel by pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"
#include "raytrace/params.h"
#include "raytrace/paths.h"

#include <vector>

namespace eikonal::raytrace {

struct Pixels {
    std::vector<glm::vec4> colours; ///< R, G, B, A
    std::vector<FirstPath> paths;   ///< empty if nothing asks for them
};

/// Channels R G B A, AR AG AB where the scene is coloured, and the AOVs.
image::Image assemble(const Pixels& pixels, const Params& params, bool coloured);

} // namespace eikonal::raytrace
