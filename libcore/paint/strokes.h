// What is painted: parsed from options' texts.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::paint {

/// Multiplies a grid by 1 + amount · fractalNoise(x / size), or by 0 where that is negative.
struct Noise {
    std::string grid;
    double amount = 0;
    double size = 1; ///< of the coarsest features [unit]
    int octaves = 4;
    std::uint32_t seed = 0;
};

/// Adds `value` within a sphere, all of it within (1 - soft) radius, from there on less and less,
/// by a cubic without a kink at either end.
struct Sphere {
    std::string grid;
    glm::dvec3 centre{0}; ///< [unit]
    double radius = 1;    ///< [unit]
    glm::dvec3 value{0};
    double soft = 0.5;
};

/// Adds the absorption, scattering and emission of another volume, per unit of the world, looked up
/// between its voxels linearly.
struct Stamp {
    std::string path;
    glm::dmat4 worldFromBrush{1};
};

/// The grids that may be painted, without an object's name.
const std::vector<std::string>& paintable();

/// "GRID:AMOUNT:SIZE[:OCTAVES[:SEED]]". Throws UsageError.
Noise parseNoise(const std::string& text);

/// "GRID:X,Y,Z:RADIUS:VALUE[:SOFT]". Throws UsageError.
Sphere parseSphere(const std::string& text);

} // namespace eikonal::paint
