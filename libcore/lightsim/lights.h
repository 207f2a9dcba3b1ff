// The lights of a scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace eikonal::lightsim {

struct Light {
    enum class Kind { directional, point } kind = Kind::directional;
    glm::dvec3 vector{0, -1, 0}; ///< direction of travel, or position in the world [unit]
    glm::dvec3 rgb{1};           ///< irradiance [W/m²], or radiant intensity [W/sr]
};

/// `directional:DX,DY,DZ[:R,G,B]` or `point:X,Y,Z[:R,G,B]`. Throws UsageError.
Light parseLight(const std::string& spec);

/// The light with its position or direction in voxel space.
Light inVoxels(const Light& light, const glm::dmat4& voxelFromWorld);

} // namespace eikonal::lightsim
