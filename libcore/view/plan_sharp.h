// What a picture of objects with sharp boundaries calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view/view.h"

namespace eikonal::view {

/// Reads the objects into the plan, and decides which effects they call for. Throws DataError where
/// there are none, or their grids vary in a way that is not traced.
void planSharp(Plan& plan, const Scene& scene);

/// Which effects are on, and which object asked for them.
void listSharpEffects(Plan& plan);

} // namespace eikonal::view
