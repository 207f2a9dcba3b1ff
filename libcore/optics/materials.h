// Materials by name: how they bend and disperse light, and what they absorb of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::optics {

/// Its index is that of a volume: n(λ) = ior + dispersion (1/λ² − 1/0.5876²), λ in µm.
struct NamedMaterial {
    /// Of a uniaxial crystal, whose o-rays have the plain numbers: those of its e-rays.
    struct Extraordinary {
        double ior, dispersion;
    };
    std::string name;
    double ior;               ///< at 587.56 nm, Fraunhofer's d, against air [1]
    double dispersion;        ///< Cauchy B, by which n_F − n_C is the published one [µm²]
    glm::dvec3 absorption{0}; ///< what a short way takes from white light [1/m]
    std::optional<Extraordinary> extraordinary{};
};

/// A conductor's complex index n + i k, by linear Rec. 709's channels.
struct NamedMetal {
    std::string name;
    glm::dvec3 index, extinction;
};

/// All of them, in order of their names. docs/materials.md has their sources and errors.
const std::vector<NamedMaterial>& namedMaterials();
std::vector<std::string> materialNames();

/// Upper case is as lower, '_' as '-', and N-BK7 is bk7. Null where there is none of that name.
const NamedMaterial* findMaterial(const std::string& name);

const std::vector<NamedMetal>& namedMetals();
std::vector<std::string> metalNames();
/// Upper case is as lower, and aluminum is aluminium. Null where there is none of that name.
const NamedMetal* findMetal(const std::string& name);

/// A metal of that reflectance at normal incidence [1], 0 to 1, channel by channel: of the indices
/// that have it (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel", eq. 3 to 6) the one whose
/// reflectance at other angles is nearest to Schlick's, in the mean weighted by the cosine.
NamedMetal metalOfReflectance(const glm::dvec3& reflectance);

/// Cauchy B [µm²] of an index n_d whose Abbe number (n_d − 1) / (n_F − n_C) is `abbe`; 0: none.
double dispersionOf(double ior, double abbe);
/// The other way round. Infinite where the index does not depend on the wavelength.
double abbeOf(double ior, double dispersion);

} // namespace eikonal::optics
