// Values at fine voxels: a whole number of them lies along an edge of a scene's voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::volume {

struct FineGrid {
    int detail = 0;                 ///< fine voxels along an edge of a voxel; 0: there is no grid
    std::vector<glm::ivec3> voxels; ///< active ones, counted from a box's low corner on
    std::vector<glm::vec3> values;  ///< of each

    bool empty() const { return detail == 0; }
};

} // namespace eikonal::volume
