// The ground of a scene, and the lights that fall on it beyond the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/recorded_lights.h"
#include "scene/scene.h"
#include "volume/ground.h"

#include <optional>

namespace eikonal::scene {

struct Ground {
    volume::Ground plane;
    RecordedLights lights;
    int region = -1;            ///< that it is within the domain; −1: none
    glm::dvec3 low{0}, high{0}; ///< the faces of the box that light was stored on it in [voxel]
};

/// The ground that the files' metadata tell of. Throws DataError where two tell of different ones,
/// and as recordedLights() does.
std::optional<Ground> readGround(const Files& files, const Scene& scene);

} // namespace eikonal::scene
