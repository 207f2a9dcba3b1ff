// The refractive index over the domain, where it varies.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace eikonal::scene {

/// Of blurred boundaries: reads `ior` over `box`. An absent grid is index 1.
Index blurredIndex(const volume::Volume& volume, const volume::IndexBox& box);

/// Of sharp boundaries: one grid for all regions whose index varies, or an index that does not.
/// Throws DataError where two regions that vary come closer than look-ups reach.
Index varyingIndex(const Scene& scene);

/// Of blurred boundaries: adds what depends on the wavelength, where rays bend by it.
void disperse(Index& index, const Values& dispersion, const volume::IndexBox& box);

} // namespace eikonal::scene
