// A gem in the round brilliant cut.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

namespace eikonal::shapes {

/// Proportions as jewellers give them. Defaults of the main facets are Tolkowsky's (Diamond
/// Design, 1919); he left the lesser ones open.
struct BrilliantParams {
    double radius = 1;       ///< of the girdle [unit]
    double table = 53;       ///< its width from corner to corner [% of the diameter]
    double crown = 34.5;     ///< angle of the upper main facets to the girdle's plane [degree]
    double pavilion = 40.75; ///< and of the lower ones [degree]
    double girdle = 2;       ///< its height [% of the diameter]
    double star = 50;        ///< how far star facets reach from the table's edge to the girdle [%]
    double lower = 77;       ///< how far lower girdle facets reach from the girdle to the axis [%]
    double culet = 1;        ///< its width [% of the diameter]
    bool upright = false;    ///< the axis along y, the girdle about y = 0; else lying on y = 0

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

/// 58 facets and 16 of the girdle, each flat, with normals that say so: the corners of every facet
/// with more than three are laid on its plane. It lies on a main facet of its pavilion, but for
/// `upright`.
mesh::TriangleMesh makeBrilliant(const BrilliantParams& params);

} // namespace eikonal::shapes
