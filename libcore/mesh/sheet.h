// An open surface that ends at a domain's faces becomes a closed one, by walls outside the domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <string>

namespace eikonal::mesh {

/// What closes an open surface.
struct SheetDomain {
    Box box;      ///< world space [unit]
    double slack; ///< how far within the box's faces the surface may end [unit]
    double clear; ///< so near to the box nothing comes that is added, but what continues the
                  ///< surface straight on from its rim [unit]
    bool below;   ///< the solid is below the surface (-Y), however its faces look; else behind them
};

/// What was done.
struct ClosedSheet {
    std::string fault;   ///< why the mesh was left as it is; empty: it is closed
    size_t rimEdges = 0; ///< edges with a single face
    bool turned = false; ///< all faces, so that they look up
};

/// Closes an open mesh whose rim lies nowhere within the domain, seen from `slack` within its
/// faces. From the rim the surface goes on along its own slope until it is clear of the domain,
/// then straight away from the domain's middle, and round it on the side where the solid is. So
/// the solid within the domain is what lies behind the surface there. What is added is
/// flat, whatever smoothing the mesh is in for.
ClosedSheet closeSheet(TriangleMesh& mesh, const SheetDomain& domain);

} // namespace eikonal::mesh
