// What surrounds the scene: a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/resources.h"
#include "image/image.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace eikonal::camera {

struct Background {
    glm::dvec3 background{0};   ///< radiance where there is no map
    double environmentTurn = 0; ///< of the map about its up axis [degree]
    bool environmentZUp = false;

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

/// The map as a texture; none if there is none.
gpu::Texture makeMap(gpu::Device& device, const std::optional<image::Image>& map,
                     gpu::Filter filter = gpu::Filter::nearest);

/// What it takes on the device, at most.
gpu::Need mapNeed(const image::Image& map);

/// What shaders/camera/environment.glsl is told of it: a radiance, and 1 where there is no map, 2
/// where its pixels lie by their centres, 3 by their edges.
glm::vec4 backgroundValues(const Background& background, const std::optional<image::Image>& map);

/// A rotation to the map's frame from one that the world is turned to by `worldFromFrame`.
glm::dmat3 mapFromFrame(const Background& background, const glm::dmat3& worldFromFrame);

/// The radiance from a unit direction in the world, by the same rule as the shader's.
glm::dvec3 radianceFrom(const Background& background, const std::optional<image::Image>& map,
                        const glm::dvec3& direction);

} // namespace eikonal::camera
