// What a file of a modeller says of a scene: objects, what they are made of, cameras, lights.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::scenefile {

/// What an object is made of.
struct Material {
    enum class Kind {
        matt,  ///< opaque, diffuse
        metal, ///< opaque, a mirror
        glass, ///< light goes through
        glow   ///< emits, and lets nothing through
    } kind = Kind::matt;
    std::string name;
    glm::dvec3 colour{1}; ///< matt: albedo; metal: reflectance at normal incidence; glass: what it
                          ///< lets through, beside what it absorbs [1]
    double ior = 1.5;     ///< of glass and of a matt object's coat [1]
    double abbe = 0;      ///< Abbe number, 0: no dispersion [1]
    double roughness = 0; ///< GGX's α [1]
    glm::dvec3 absorption{0}; ///< of glass [1/unit]
    glm::dvec3 radiance{0};   ///< of what glows

    bool operator==(const Material&) const = default;
};

/// Triangles in world space. Seen from outside their corners run anticlockwise.
struct Object {
    std::string name;
    std::optional<Material> material{}; ///< none: the file says nothing of it
    std::vector<glm::dvec3> points{};   ///< [unit]
    std::vector<glm::uvec3> triangles{};
    std::vector<std::array<glm::vec3, 3>> normals{}; ///< of each triangle's corners, of length 1 or
                                                     ///< 0: none known
};

struct Objects {
    std::vector<Object> objects;
    std::vector<std::string> unknown; ///< what the file has and is not understood, once each
    bool thinGlass = false; ///< some glass is a sheet without thickness, as glTF has it by default
};

struct Camera {
    std::string name, node;                    ///< its own, and that of what holds it
    glm::dvec3 eye{0};                         ///< [unit]
    glm::dvec3 forward{0, 0, -1}, up{0, 1, 0}; ///< of length 1
    bool parallel = false;
    double fov = 0;                 ///< vertical, perspective [degree]
    double height = 0;              ///< of the view, parallel [unit]
    std::optional<double> aspect{}; ///< width over height
};

struct Light {
    enum class Kind { directional, point, spot } kind = Kind::point;
    std::string name;
    glm::dvec3 place{0};            ///< [unit]
    glm::dvec3 direction{0, 0, -1}; ///< of travel, or the axis; of length 1
    glm::dvec3 rgb{1};          ///< irradiance across the direction [W/m²], or intensity [W/sr]
    double angle = 0, soft = 0; ///< spot: it fades within angle ± soft from the axis [degree]
};

struct Lights {
    std::vector<Light> lights;
    std::vector<std::string> unknown; ///< as of Objects
};

} // namespace eikonal::scenefile
