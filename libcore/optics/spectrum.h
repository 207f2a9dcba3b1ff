// Wavelengths of light: how the index follows them, and what colour they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

namespace eikonal::optics {

/// Where indices stand in files: helium's yellow line [nm].
constexpr double kReferenceWavelength = 587.6;
/// What pictures in colour are made of [nm].
constexpr double kShortest = 380, kLongest = 730;

/// Cauchy's law, n(λ) = n + B c(λ): c(λ) = 1/λ² − 1/0.5876² [1/µm²] of a wavelength in nm.
double cauchyTerm(double nanometres);

/// The share of white light per nm at a wavelength, in linear Rec. 709: white is CIE's illuminant
/// D65, seen by the standard observer of 1931 (2°). Integrates to (1, 1, 1) over the range above; is
/// 0 outside. A single wavelength's colour has negative components, since it is more vivid than any
/// of Rec. 709.
glm::dvec3 whiteDensity(double nanometres);

/// Its integral from the shortest wavelength on: (0, 0, 0) to (1, 1, 1).
glm::dvec3 whiteUpTo(double nanometres);

} // namespace eikonal::optics
