// How a wavefront begins: a planar or spherical front of patches before the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/photon_map.h"
#include "lightsim/shared.h"

#include <vector>

namespace eikonal::lightsim {

/// Some of a light's front.
struct FrontBatch {
    std::vector<FrontCorner> corners; ///< four a patch
    std::vector<FrontPatch> patches;
    double power = 0; ///< radiant power per unit of the light's RGB in a cell of weight 1, over
                      ///< that of a voxel's face [voxel²] or [sr]
    double flux = 0;  ///< of all patches [cells]
    bool point = false;
    bool startsAtLight = false;
};

/// The front of a source, part by part: cells of its map that the domain lies behind.
/// Cells that the domain's outline crosses are cut down to an eighth of their edge, which their
/// middle then decides. Rays are given the index `outside`.
std::vector<FrontBatch> frontOf(const Source& source, const VoxelBox& domain,
                                const MapDetail& detail, double outside);

} // namespace eikonal::lightsim
