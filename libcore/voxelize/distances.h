// Signed distances from voxels to a mesh's solid, exact within a band.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "volume/volume.h"
#include "voxelize/lattice.h"

namespace eikonal::voxelize {

/// The distance [unit] of every voxel's middle to what bounds the solid of `mesh`, negative inside,
/// cut to `halfWidth` [voxel] either side; bricks beyond that are even. Exact but for rounding to
/// float, for any closed mesh whose faces do not cross and whose shells do not overlap. Where they
/// do, the solid is what they make together, as Coverage counts it, and the distance is off by at
/// most 1/32 of a voxel where faces cross.
///
/// OpenVDB's meshToLevelSet is not used: it measures in float, passes each voxel's nearest face on
/// to its neighbours, which need not be theirs, and then moves the values until their slope is 1.
volume::BrickGrid signedDistances(const mesh::TriangleMesh& mesh, const Lattice& lattice,
                                  double halfWidth);

} // namespace eikonal::voxelize
