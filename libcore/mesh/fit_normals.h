// Fans' normals by which every edge is bent alike at both its ends.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/fans.h"

namespace eikonal::mesh {

/// Turns the normals of fans, but those that are `fixed`, so that they are at equal angles to the
/// edges between them, short edges before long ones: as on any arc of a circle. A mean over faces
/// cannot know where a plane goes over into a fillet: there it bends the plane as much as the
/// fillet. A fillet's own strips tell.
void fitNormals(const TriangleMesh& mesh, const std::vector<char>& fixed, Fans& fans);

} // namespace eikonal::mesh
