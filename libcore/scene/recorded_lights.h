// The lights that a file was lit by, recorded for what lies beyond its domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/files.h"
#include "scene/lights.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::scene {

constexpr const char* kLightsKey = "eikonal:lights";

struct RecordedLights {
    std::vector<Light> lights; ///< no environments
    glm::dvec3 upward{0};      ///< what environments send on a plane that faces up (+Y) [W/m²]
};

/// A light's line of the metadata: its SPEC as it was given, of an environment
/// NAME=upward:R,G,B by `upward`.
std::string recordOf(const Light& light, const glm::dvec3& upward);

/// The lights of all files. Throws DataError where a line is none of a light.
RecordedLights recordedLights(const Files& files);

} // namespace eikonal::scene
