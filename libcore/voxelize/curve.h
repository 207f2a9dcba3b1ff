// Objects' facets become the curved surfaces that they stand for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "voxelize/params.h"

#include <string>
#include <vector>

namespace eikonal::voxelize {

/// Curves the objects' meshes as `params.smooth` says, as finely as their lattice asks for
/// (mesh/smooth_surface.h), and where they touch all alike. Counts triangles before and after.
/// Gives a warning for each object with faces that stay flat since curved they would cross others.
std::vector<std::string> curveObjects(Params& params, Stats& stats);

} // namespace eikonal::voxelize
