// The lights of a scene, as people give them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace eikonal::scene {

/// A light in the world. It is seen by no picture and casts no shadow itself.
struct Light {
    enum class Kind {
        directional,
        point,
        spot,
        rect,
        sphere,
        environment
    } kind = Kind::directional;
    glm::dvec3 vector{0, -1, 0}; ///< direction of travel, or position or centre [unit]
    glm::dvec3 rgb{1}; ///< irradiance across its axis [W/m²], radiant intensity [W/sr], or of rect
                       ///< and sphere radiance [W/(m² sr)]
    double angle = 0;  ///< directional: its disc's diameter; spot: from axis to edge [degree]
    double soft = 0;   ///< spot: it fades within angle ± soft [degree]
    glm::dvec3 axis{0, -1, 0};           ///< spot: of length 1
    std::array<glm::dvec3, 2> edges{};   ///< rect: whole; it shines to the side of their product
    double radius = 0;                   ///< sphere [unit]
    std::string file{};                  ///< environment: FILE or FILE:LAYER
    std::shared_ptr<image::Image> map{}; ///< environment: R, G, B, radiance, read by who parsed it
    glm::dmat3 mapFromWorld{1};          ///< environment: its pose
    /// Its polariser lets through light whose E lies in the plane of this direction and the ray,
    /// half of what is unpolarised, of which rgb is what is left; 0: it has none. World space.
    glm::dvec3 polarizer{0};
    std::string name{}; ///< of its layers and files
    std::string spec{}; ///< as it was given

    /// Whether many points or directions stand for it.
    bool isExtended() const;
    /// Whether it stands somewhere, and sends the same power whatever the scene is.
    bool hasPlace() const { return kind != Kind::directional && kind != Kind::environment; }
};

/// `[NAME=]KIND:...`, see kLightSpecs. Throws UsageError.
Light parseLight(const std::string& spec);

/// All kinds in one sentence.
extern const char* const kLightSpecs;

/// What a light that has a place sends into all directions [W].
glm::dvec3 powerOf(const Light& light);

} // namespace eikonal::scene
