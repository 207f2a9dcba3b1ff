// Domains that overlap are traced as one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view/view.h"

namespace eikonal::view {

/// Makes one plan of each group of them whose domains overlap, see scene::merge(), until none do.
/// Throws DataError where what surrounds them is not one medium or they have several grounds,
/// and what scene::merge() throws.
void mergeOverlapping(std::vector<Plan>& plans, const Params& params);

} // namespace eikonal::view
