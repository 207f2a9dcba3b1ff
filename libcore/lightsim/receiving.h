// Which voxels receive light: those where something scatters it, and what is round them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/params.h"
#include "scene/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::lightsim {

/// Bricks of voxels that receive light, laid out as volume::BrickGrid lays out those of the domain.
struct ReceivingBricks {
    glm::ivec3 first{0};             ///< of the first brick's first voxel, −7 to 0
    glm::ivec3 bricks{0};            ///< along each axis
    std::vector<std::uint32_t> list; ///< those that receive, x fastest, ascending

    std::int64_t voxels() const;
};

/// All bricks where the outputs are asked for by name; else those that a picture of the scene looks
/// up, smoothing included.
ReceivingBricks receivingBricks(const scene::Scene& scene, const Params& params);

} // namespace eikonal::lightsim
