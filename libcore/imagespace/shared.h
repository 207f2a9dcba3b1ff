// The structs that the shaders of image space and C++ both read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace eikonal::imagespace {

using glm::ivec4;
using glm::mat4;
using glm::vec4;
#include "shared/bindings.h"
#include "shared/imagespace_params.h"

static_assert(sizeof(ImageSpaceParams) == 2 * 64 + 23 * 16);
static_assert(sizeof(SurfacePath) == 64);

} // namespace eikonal::imagespace
