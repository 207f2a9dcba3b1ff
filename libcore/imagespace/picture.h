// Pictures of what the device has made of each pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"
#include "imagespace/params.h"
#include "imagespace/shared.h"

#include <span>

namespace eikonal::imagespace {

/// Whether rays' paths are written, which AOVs and opacities by colour are made from.
bool wantsPaths(const Params& params);

/// Premultiplied R G B A, AR AG AB where the body is coloured, and the AOVs asked for.
/// `paths` are the members of each pixel's SurfacePath, the first of all pixels first.
image::Image assemble(const Params& params, std::span<const vec4> colours,
                      std::span<const vec4> paths);

} // namespace eikonal::imagespace
