// Many small ellipsoids: flecks in a stone, bubbles, dust.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>

namespace eikonal::shapes {

struct FlecksParams {
    int count = 100;
    double radius = 0.02; ///< of the largest, as a ball [unit]
    double least = 0.4;   ///< the smallest as a share of that
    double flat = 0.5;    ///< the shortest half axis as a share of the longest, at least
    int segments = 16;    ///< around each
    std::uint32_t seed = 0;

    /// Throws UsageError.
    void check() const;
};

/// Ellipsoids placed and turned at random, apart from each other and wholly within the solid of a
/// closed mesh. Throws UsageError where so many find no place.
mesh::TriangleMesh makeFlecks(const FlecksParams& params, const mesh::TriangleMesh& within);

} // namespace eikonal::shapes
