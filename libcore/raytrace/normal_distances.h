// How thick a body is along its normals: what image-space refraction by distances goes by.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace eikonal::raytrace {

/// For each point of a closed mesh that looks outward, the distance along the inward normal to
/// where the line leaves the solid for the first time [unit]: d_N of Wyman 2005, "An approximate
/// image-space approach for interactive refraction", §3.2. The normal is the mean of those that the
/// mesh has at the point's corners, by the faces' angles there, or, where it has none, that of the
/// faces. 0 where the line leaves through no face, as of an open mesh, or no face has the point.
std::vector<float> distancesAlongNormals(const mesh::TriangleMesh& mesh);

} // namespace eikonal::raytrace
