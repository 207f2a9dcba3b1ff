// The wavelengths at which light is traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::optics {

/// Engines trace a scene once for every band and add up what they find.
struct Band {
    double wavelength = 587.6; ///< [nm]; the index is that at this wavelength
    glm::dvec3 weight{1};      ///< share of the light's linear RGB that the band carries
};

/// Where the index does not depend on the wavelength one band carries all light.
inline std::vector<Band> wholeLight() {
    return {Band{}};
}

} // namespace eikonal::optics
