// The structs that the voxelising shaders and C++ both read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

namespace eikonal::voxelize {

using glm::ivec4;
using glm::vec4;
#include "shared/bindings.h"
#include "shared/limits.h"
#include "shared/voxelize_params.h"

static_assert(sizeof(StripParams) == 32);
static_assert(sizeof(Facet) == 48);

} // namespace eikonal::voxelize
