// What every modeller's material comes to in the same way.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/scene.h"

#include <algorithm>
#include <cmath>

namespace eikonal::scenefile {

/// Absorption [1/unit] of what lets `share` through after a way of `distance` (Beer and Lambert). A
/// millionth and less counts as a millionth.
inline glm::dvec3 absorptionBy(const glm::dvec3& share, double distance) {
    return -glm::log(glm::clamp(share, 1e-6, 1.0)) / distance;
}

/// GGX's α of a roughness as modellers have it, whose square it is (Burley 2012, "Physically-based
/// shading at Disney"). Below 0.001 it shows no more, and is 0: smooth.
inline double alphaOf(double roughness) {
    const double alpha = roughness * roughness;
    return alpha < 1e-3 ? 0 : alpha;
}

/// Makes what is matt glow with that radiance where that is brighter than its colour is: a thing is
/// either.
inline bool takeGlow(Material& material, const glm::dvec3& radiance) {
    const auto most = [](const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); };
    if (material.kind != Material::Kind::matt || !(most(radiance) > 0) ||
        !(most(radiance) >= most(material.colour)))
        return false;
    material.kind = Material::Kind::glow;
    material.radiance = radiance;
    return true;
}

} // namespace eikonal::scenefile
