// Makes of a damaged mesh one that bounds a volume, and says what it did.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace eikonal::mesh {

struct RepairResult {
    TriangleMesh mesh;
    std::vector<std::string> actions; ///< one sentence each; empty if the mesh was sound
    /// What of the surface was lost, or changed by more than the actions say; empty: nothing.
    std::string loss;
    double filled = 0; ///< area of what fills holes, over that of the surface that was there
};

/// Merges points, also those that rounding holds apart (weldNearPoints), drops faces of repeated
/// corners or given twice, makes neighbours agree, cuts the surface where more than two faces meet,
/// stitches seams, fills every hole, and turns shells outward, those within another alternately in
/// and out. A mesh that already bounds a volume stays as it is. Faces that cross stay crossed.
/// Check the result, and `loss`: a flat sheet still encloses nothing when its back is closed. Takes
/// any soup of finite points and indices in range.
RepairResult repairMesh(const TriangleMesh& mesh);

} // namespace eikonal::mesh
