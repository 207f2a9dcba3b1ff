// Makes one of points that only rounding holds apart.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

namespace eikonal::mesh {

/// The widest gap that counts as rounding, as a share of the box's diagonal: coordinates written
/// with six digits differ by less.
constexpr double kWidestWeld = 1e-5;

struct Weld {
    size_t points = 0;    ///< that went
    double tolerance = 0; ///< as wide as it took [unit]
};

/// Joins points on open edges that lie within a tolerance of each other: the smallest of 1e-9 to
/// kWidestWeld of the diagonal, in tenfold steps, that leaves the fewest open edges; where none
/// leaves fewer, nothing changes. No face collapses, since a point moves by less than a quarter of
/// the shortest edge at it. Points of equal coordinates are to be one before.
Weld weldNearPoints(TriangleMesh& mesh);

} // namespace eikonal::mesh
