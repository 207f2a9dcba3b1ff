// How far off any boundary is, all over the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/object_sets.h"
#include "scene/objects.h"

#include <cstdint>
#include <vector>

namespace eikonal::scene {

/// What is known of boundaries in every cube of `edge` voxels of the domain, x fastest.
struct BoundaryTable {
    int edge = 1;
    glm::ivec3 size{0}; ///< [cube]
    /// How far the cube's centre is from any boundary at least [voxel]: exact where the level sets
    /// are, of one object alone negative inside.
    std::vector<float> clearance;
    /// Of several objects: those that hold its centre (low 16 bits), those near it (high 16). Of
    /// many the place of both sets in `sets`.
    std::vector<std::uint32_t> objects;
    std::vector<ObjectSets> sets;
};

/// The edge of the cubes [voxel]: a power of two that keeps the table small whatever the domain, so
/// that rays look at one filtered value however fine the voxels are.
int tableEdge(const glm::ivec3& size);

/// For the objects of a domain of that size.
BoundaryTable tabulate(const std::vector<Object>& objects, const glm::ivec3& size);

} // namespace eikonal::scene
