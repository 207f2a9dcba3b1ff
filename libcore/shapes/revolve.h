// A profile turned round the y axis.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"
#include "shapes/profile.h"

namespace eikonal::shapes {

struct RevolveParams {
    int segments = 256;   ///< around the axis
    double tolerance = 0; ///< of a drawing's curves [unit]; 0: see readProfile()

    /// Throws UsageError.
    void check() const;
};

/// The solid of revolution: radius along x and z, height along y. An end of an open profile that is
/// off the axis is closed by a disc. A loop that keeps off the axis gives a ring; one that runs
/// along it, a body around it. Which way the profile runs does not matter. Its points lie on the
/// circles. Throws DataError, with the place, where the profile crosses itself, comes to the axis
/// between its ends, or encloses nothing.
mesh::TriangleMesh revolve(const Profile& profile, const RevolveParams& params);

} // namespace eikonal::shapes
