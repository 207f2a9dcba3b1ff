// The ground as an object of the domain, on which light falls as on any other.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voxelize/params.h"

namespace eikonal::voxelize {

/// Adds the ground to the objects, behind all of them: opaque, and before all of them where they
/// dip into it, as a table would be. Its mesh goes on beyond the domain, so that its distances are
/// those of a plane. Throws UsageError where the domain does not hold the plane and what is below
/// it by as much as distances need; as makePlan() does.
void addGround(Params& params);

} // namespace eikonal::voxelize
