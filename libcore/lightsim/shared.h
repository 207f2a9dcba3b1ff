// The structs that the light stage's shaders and C++ both read.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace eikonal::lightsim {

using glm::ivec4;
using glm::mat4;
using glm::uint;
using glm::uvec4;
using glm::vec4;
#include "shared/beam_params.h"
#include "shared/bindings.h"
#include "shared/front_params.h"
#include "shared/lightsim_params.h"
#include "shared/limits.h"

static_assert(sizeof(EmissionParams) == 320);
static_assert(sizeof(PhotonParams) == 112);
static_assert(sizeof(ResolveParams) == 112);
static_assert(sizeof(Photon) == 96);
static_assert(sizeof(LayoutParams) == 48);
static_assert(sizeof(SurfacePoint) == 32);
static_assert(sizeof(PointLight) == 32);
static_assert(sizeof(BeamPoint) == 80);
static_assert(sizeof(BeamNode) == 64);
static_assert(sizeof(BeamParams) == 560);
static_assert(sizeof(FrontParams) == 144);
static_assert(sizeof(FrontCorner) == 64);
static_assert(sizeof(FrontPatch) == 48);
static_assert(sizeof(FrontDepth) == 32);
static_assert(sizeof(FrontHit) == 160);
static_assert(sizeof(FrontEnergy) == 80);

} // namespace eikonal::lightsim
