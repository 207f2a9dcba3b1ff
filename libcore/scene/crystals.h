// Objects that are uniaxial crystals: what of a scene's can be traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace eikonal::scene {

/// Turns axes as the scene's files are, and makes glass of crystals whose o- and e-rays are the
/// same. Throws DataError for a crystal that is not traced: one that is opaque, comes to the
/// domain's face, or whose dispersion varies; for an axis whose length is neither 1 nor 0; and for
/// crystals in a scene with metal or rough boundaries.
void settleCrystals(Scene& scene);

/// Throws DataError of a crystal in a file whose boundaries are to be blurred.
void refuseBlurredCrystals(const volume::Volume& volume);

/// Throws DataError of grids `axis`, `ior_extraordinary` or `absorption_extraordinary` that are no
/// object's, or of a file whose boundaries are to be blurred.
void refuseStrayCrystalGrids(const Files& files, bool sharp);

/// Whether some crystal's n_e depends on the wavelength.
bool anyCrystalDisperses(const Scene& scene);

/// The crystal that holds a point of the world, or null.
const Region* crystalAt(const Scene& scene, const glm::dvec3& place);

} // namespace eikonal::scene
