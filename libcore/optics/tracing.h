// How rays are stepped through a varying index: view rays and photons alike.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optics/bands.h"

#include <optional>
#include <string>
#include <vector>

namespace eikonal::optics {

/// The steps of shaders/lib/ray.glsl.
enum class Integrator {
    euler,   ///< first order, on plain samples: the scheme of Ihrke et al. 2007 and Sun et al. 2008
    verlet,  ///< symplectic, one look-up a step; fourth order where steps are equal
    sharma,  ///< Runge–Kutta–Nyström, fourth order, three look-ups
    rk4,     ///< Runge–Kutta, fourth order, four look-ups
    adaptive ///< an embedded Nyström pair whose steps keep to a tolerance, three look-ups
};

enum class Interpolation {
    linear, ///< one filtered look-up
    cubic   ///< a B-spline through the samples, 16 unfiltered look-ups
};

/// What a boundary between two indices is.
enum class Boundary {
    automatic, ///< sharp where the file has signed distances, else blurred
    blurred,   ///< a steep gradient of the grid 'ior', which the ray equation bends rays in
    sharp      ///< the zero of a signed distance, where Snell's and Fresnel's laws hold
};

const std::vector<std::string>& integratorNames(); ///< in the order of Integrator
/// Throw UsageError naming the option.
Integrator parseIntegrator(const std::string& name);
Interpolation parseInterpolation(const std::string& name);
Boundary parseBoundary(const std::string& name);

struct Tracing {
    Integrator integrator = Integrator::verlet;
    /// None: linear for the integrators of one look-up, cubic for the others, whose steps are worth
    /// no more than their samples.
    std::optional<Interpolation> interpolation;
    double step = 0;         ///< longest step [voxel]; 0: usualStep()
    double tolerance = 0.01; ///< adaptive: error of a ray's exit [voxel]
    /// Central differences as they are, not made unbiased under linear interpolation: as the
    /// sources have it, for comparison. Euler steps take them in any case.
    bool plainSamples = false;
    Boundary boundary = Boundary::automatic;
    Wavelengths wavelengths; ///< where the index depends on them

    Interpolation sampling() const;
    bool unbiased() const { return !plainSamples && integrator != Integrator::euler; }
    /// 1 voxel; Verlet's 1.5, which cost what Euler's of 1 do, where the medium is not sampled with
    /// every step (`gathers`); adaptive ones 4, so that no sizeable detail lies between two
    /// look-ups.
    double usualStep(bool gathers = false) const;
    /// The shaders' switch INTEGRATOR: 0 straight, then in the order of Integrator.
    int integratorSwitch(bool bends) const { return bends ? 1 + static_cast<int>(integrator) : 0; }

    /// In words, for people: "adaptive, cubic, to 0.01 voxels".
    std::string text() const;
    /// Throws UsageError naming the option that is wrong; the tolerance's is `toleranceOption`.
    void check(const std::string& toleranceOption) const;
};

} // namespace eikonal::optics
