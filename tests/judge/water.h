// Light on a floor under waves, with a box above them: exact, by the map from surface to floor.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/texels.h"

#include <vector>

namespace judge {

struct Wave {
    double amplitude; ///< [unit]
    dvec2 k;          ///< by x and z [1/unit]
    double phase;
};

/// Water without end between the floor and y = Σ amplitude · sin(k·(x, z) + phase).
struct Water {
    std::vector<Wave> waves{
        {0.02, {7, 2}, 0}, {0.015, {-4, 9}, 1}, {0.008, {13, 11}, 2}}; ///< as pipelines/caustic has
    double index = 1.33;
    double floor = -0.4;              ///< height [unit]
    dvec3 direction{-0.25, -1, 0.15}; ///< of the light's travel; its irradiance across it is 1
    dvec3 boxLow{0}, boxHigh{0};      ///< an opaque box above the water; none where they are equal

    double height(const dvec2& at) const;
    dvec2 slope(const dvec2& at) const;
    /// At (x, z), upwards, of length 1.
    dvec3 normal(const dvec2& at) const;
};

/// What the light that a ray brings is weighed with.
enum class Weighing {
    exact,     ///< irradiance: power over area
    flatCosine ///< irradiance across the ray times the cosine that the ray would have under flat
               ///< water (Barczak and Olano, "Interactive shadowed caustics using hierarchical
               ///< light volumes", §3.2)
};

/// Irradiance on the floor's texels. Light comes to the floor on one way alone: what the water
/// reflects is lost upward, and what it refracts meets the floor before it could leave. That this
/// is so is tried from the waves' greatest slope; throws std::invalid_argument where it need not
/// be.
void irradianceUnder(const Water& water, Texels& texels, Weighing weighing = Weighing::exact,
                     double bend = Patching{}.bend);

/// Whether the ray x + t d meets the box before t = `end`.
bool meetsBox(const Water& water, const dvec3& x, const dvec3& d, double end);

/// The floor's irradiance under flat water, far from the box: Snell and Fresnel.
double irradianceUnderFlat(const Water& water);

} // namespace judge
