// The structs that the transport core's shaders and C++ both read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

namespace eikonal::scene {

using glm::ivec4;
using glm::uint;
using glm::uvec4;
using glm::vec4;
#include "shared/bindings.h"
#include "shared/field_params.h"
#include "shared/limits.h"
#include "shared/scene_params.h"
#include "shared/spectrum_params.h"
#include "shared/surface_params.h"
#include "shared/transport_params.h"

static_assert(sizeof(FieldParams) == 64);
static_assert(sizeof(SceneParams) == 112 + 65 * 160 + 64 * 32);
static_assert(sizeof(SpectrumParams) == 1024);
static_assert(sizeof(SurfaceParams) == 32);
static_assert(sizeof(TransportParams) == 64);

} // namespace eikonal::scene
