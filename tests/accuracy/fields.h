// Index fields with known rays, as formulas for the judge and as voxels for the library.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "judge/trace.h"
#include "view/view.h"

#include <optional>

namespace accuracy {

using glm::dvec3;

/// All fields stand in a box of this edge, whatever their voxels; a unit is a voxel of 128³.
constexpr double kBox = 128;

struct Field {
    std::string name;
    judge::Medium medium;
    std::function<double(dvec3)> index; ///< as voxels hold it; differs only where no ray goes
    dvec3 through;                      ///< a point of the middle ray [unit]
    dvec3 direction;                    ///< of all rays
    double half = 0;                    ///< half the picture's height [unit]
    bool smooth = true;                 ///< it counts in the means; else it has a kink or an edge
};

/// The six smooth ones, then those with an edge.
const std::vector<Field>& fields();
const Field& fieldNamed(const std::string& name);

/// Parallel rays of a square picture through the field.
eikonal::view::Camera cameraOf(const Field& field, int pixels);
/// The rays that docs/contract.md gives the pixels' centres, row by row.
std::vector<judge::Ray> raysOf(const eikonal::view::Camera& camera);

/// An index over a box of `size` voxels whose low corner is the origin, as a scene.
eikonal::scene::Files sceneOf(const std::function<double(dvec3)>& index, const glm::ivec3& size,
                             double voxelSize);

} // namespace accuracy
