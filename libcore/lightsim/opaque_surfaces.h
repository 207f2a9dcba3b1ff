// Where opaque surfaces are, and how finely they receive light.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace eikonal::lightsim {

struct OpaqueSurfaces {
    /// Voxels that an opaque surface may cross: their places in the domain, x fastest, ascending.
    std::vector<std::uint32_t> voxels;
    int detail = 1; ///< fine voxels along an edge of one

    bool empty() const { return voxels.empty(); }
    /// About how many fine voxels they cross.
    std::int64_t about() const;
};

/// Boundaries of opaque material, and what the domain's faces cut of it. `detail` 0: as fine as
/// some millions of fine voxels are. Throws MemoryError for a domain of more than 2^31 voxels.
OpaqueSurfaces findSurfaces(const scene::Scene& scene, int detail);

/// The detail at which surfaces that cross so many voxels are some millions of fine voxels.
int detailFor(size_t voxels);

} // namespace eikonal::lightsim
