// How rays are stepped through a varying index: view rays and photons alike.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/tracing.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace eikonal::optics {

const std::vector<std::string>& integratorNames() {
    static const std::vector<std::string> kNames{"euler", "verlet", "sharma", "rk4", "adaptive"};
    return kNames;
}

Integrator parseIntegrator(const std::string& name) {
    const auto& names = integratorNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw UsageError("--integrator: found '" + name + "', expected one of " +
                         join(names, ", "));
    return static_cast<Integrator>(found - names.begin());
}

Interpolation parseInterpolation(const std::string& name) {
    if (name == "linear") return Interpolation::linear;
    if (name == "cubic") return Interpolation::cubic;
    throw UsageError("--interpolation: found '" + name + "', expected linear or cubic");
}

Boundary parseBoundary(const std::string& name) {
    if (name == "auto") return Boundary::automatic;
    if (name == "blurred") return Boundary::blurred;
    if (name == "sharp") return Boundary::sharp;
    throw UsageError("--boundary: found '" + name + "', expected auto, blurred or sharp");
}

Interpolation Tracing::sampling() const {
    if (interpolation) return *interpolation;
    const bool oneLookUp = integrator == Integrator::euler || integrator == Integrator::verlet;
    return oneLookUp ? Interpolation::linear : Interpolation::cubic;
}

double Tracing::usualStep(bool gathers) const {
    if (integrator == Integrator::adaptive) return 4;
    return integrator == Integrator::verlet && !gathers ? 1.5 : 1;
}

std::string Tracing::text() const {
    std::string text = integratorNames()[static_cast<size_t>(integrator)];
    text += sampling() == Interpolation::linear ? ", linear" : ", cubic";
    if (integrator == Integrator::adaptive) text += ", to " + toText(tolerance) + " voxels";
    if (step > 0) text += ", steps up to " + toText(step) + " voxels";
    return text;
}

void Tracing::check(const std::string& toleranceOption) const {
    if (!(step == 0 || (step >= 1e-3 && step <= 1e3)))
        throw UsageError("--step: found " + toText(step) + ", expected 0.001 to 1000 voxels");
    if (!(tolerance >= 1e-9 && tolerance <= 1e3))
        throw UsageError(toleranceOption + ": found " + toText(tolerance) +
                         ", expected 1e-9 to 1000 voxels");
}

} // namespace eikonal::optics
