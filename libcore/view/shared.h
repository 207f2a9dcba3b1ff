// The structs that the view kernel and C++ both read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace eikonal::view {

using glm::dmat4;
using glm::ivec4;
using glm::uint;
using glm::vec4;
#include "shared/bindings.h"
#include "shared/domain_params.h"
#include "shared/ground_params.h"
#include "shared/plate_params.h"
#include "shared/view_params.h"

static_assert(sizeof(GroundParams) == 128 + 64 * 160);
static_assert(sizeof(PlateParams) == 64);
static_assert(sizeof(ViewParams) == 272);
static_assert(sizeof(DomainParams) == 16 * (128 + 16) + 32);
static_assert(sizeof(Departure) == 96);
static_assert(sizeof(PixelPath) == 64);

} // namespace eikonal::view
