// What a light simulation of objects with sharp boundaries calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/plan.h"

namespace eikonal::lightsim {

/// Reads the objects into the plan, and decides what to simulate of them. Throws DataError where
/// there are none, or their grids vary in a way that is not traced.
void planSharp(Plan& plan, const volume::Volume& volume, const Params& params);

/// Which effects are on, and which object asked for them.
void listSharpEffects(Plan& plan, const Params& params);

} // namespace eikonal::lightsim
