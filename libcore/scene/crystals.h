// Objects that are uniaxial crystals: what of a scene's can be traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace eikonal::scene {

/// Turns axes as the scene's files are, and makes glass of crystals whose o- and e-rays are the
/// same. Throws DataError for a crystal that is not traced: one that varies within, is opaque, or
/// comes to the domain's face; and for crystals in a scene with metal or rough boundaries.
void settleCrystals(Scene& scene);

/// Throws DataError of a crystal in a file whose boundaries are to be blurred.
void refuseBlurredCrystals(const volume::Volume& volume);

/// Throws DataError of grids `axis`, `ior_extraordinary` or `absorption_extraordinary`: crystals
/// that vary in space are not traced.
void refuseCrystalGrids(const Files& files);

/// Whether some crystal's n_e depends on the wavelength.
bool anyCrystalDisperses(const Scene& scene);

/// The crystal that holds a point of the world, or null.
const Region* crystalAt(const Scene& scene, const glm::dvec3& place);

} // namespace eikonal::scene
