// Which voxels' middles lie inside a mesh, decided by columns along z.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "volume/volume.h"

namespace eikonal::voxelize {

/// Gives every voxel of `values` the sign of the side its middle lies on: -`far` where the surface
/// winds around it more than 0 times, as Coverage counts, else `far`. `mesh` is closed, in index
/// space [voxel]. Gives whether the surface winds around some column's points other than 0 or 1
/// times: then shells overlap, or faces cross.
///
/// A plane of voxels along x and z cuts the mesh in closed chains of segments. Both faces of an
/// edge find the same end of their segments, to the bit, and a column belongs to the half-open
/// span of one segment of a chain: so no crossing is lost or doubled at an edge or a corner.
bool fillSides(const mesh::TriangleMesh& mesh, float far, volume::DenseGrid& values);

} // namespace eikonal::voxelize
