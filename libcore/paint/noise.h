// Smooth noise over space, a function of place and seed alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace eikonal::paint {

/// Gradient noise (Perlin 2002, "Improving noise") on a lattice of spacing 1: between -1 and 1, 0
/// at lattice points, of mean 0, with two continuous derivatives. The gradients come of a hash of
/// the lattice point and the seed, so that it does not repeat.
double gradientNoise(const glm::dvec3& x, std::uint32_t seed);

/// The sum of `octaves` of it, each of half the spacing and half the height of the one before,
/// divided by the sum of the heights.
double fractalNoise(const glm::dvec3& x, int octaves, std::uint32_t seed);

} // namespace eikonal::paint
