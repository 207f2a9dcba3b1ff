// Samples of the potential U = ½n², carried on beyond the domain's faces and made into splines.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <glm/vec4.hpp>
#include <vector>

namespace eikonal::scene {

/// Voxels of margin round the domain's own.
constexpr int kMargin = 4;

/// U − U₀ per voxel, x fastest, size + 2 kMargin along each axis. U₀ is that of the first voxel:
/// floats then resolve a small contrast as well as a large one, and the surroundings, to which that
/// corner mostly belongs, have no gradient at all.
struct Potential {
    glm::ivec3 size{0};      ///< the domain's [voxel]
    double squareAtZero = 1; ///< n² where the value is 0
    std::vector<float> values;

    glm::ivec3 outer() const { return size + 2 * kMargin; }
};

/// The margin goes on as the four outermost samples do: by their cubic where they are smooth (their
/// second differences of one sign and within a factor of two), by the lesser second difference
/// where those have one sign, else linearly. n does not fall below a quarter of its value at the
/// face. `rest`, if not empty, is what `index` lacks: differences are taken in double.
Potential makePotential(const volume::BrickGrid& index, const volume::BrickGrid& rest = {});

/// Adds τ²/24 |∇U|², limited where U bends so much that steps of τ can't follow.
void correctForVerlet(Potential& potential, double tau);

/// (½∇(n²), n) per voxel, x fastest, padded by one voxel, for linear look-ups: a box of `size` of
/// them from `low` on, counted from the padding's first. `own` is the potential of n, `stepped` the
/// one that steps are made in. Plain samples are central differences, as the sources take them.
/// Linear interpolation of those is off by 1/12 of the second differences along each axis on
/// average over a cell, and central differences by 1/6 of the third. Unbiased samples have both
/// taken off beforehand where the field is smooth (see biasOf()), which costs nothing on the way:
/// what is left changes its sign within a voxel.
std::vector<glm::vec4> gradientSamples(const Potential& own, const Potential& stepped,
                                       bool unbiased, const glm::ivec3& low,
                                       const glm::ivec3& size);

/// Replaces samples by the coefficients of the cubic B-spline through them; the outermost layer of
/// the margin is used up.
void makeSpline(Potential& potential);

} // namespace eikonal::scene
