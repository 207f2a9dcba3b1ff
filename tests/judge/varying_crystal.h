// Rays through crystals that vary, by Hamilton's equations in long doubles.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/crystal.h"

#include <functional>

namespace judge {

/// What a crystal is at a point.
using Crystals = std::function<Tensor(const dvec3&)>;

/// Where a ray is.
struct CrystalRay {
    dvec3 x, k;       ///< k in units of ω/c
    double drift = 0; ///< of H from its first value, the largest
};

/// Follows an o- or e-ray from x on until `distance` is 0, by the classical Runge–Kutta step of so
/// much length, with H = ½(k²/n_o² − 1) or ½(k_∥²/n_o² + k_⊥²/n_e² − 1), whose slopes are
/// differences.
CrystalRay throughCrystal(const Crystals& at, char mode, const dvec3& x, const dvec3& k,
                          const std::function<double(const dvec3&)>& distance, double step = 0.02);

} // namespace judge
