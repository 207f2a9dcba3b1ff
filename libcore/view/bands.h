// How a picture is cut into bands of rows that the device's buffers hold.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view/view.h"

#include <algorithm>
#include <cstdint>

namespace eikonal::view {

/// Rows traced by one launch: about a million pixels, so that the largest buffer stays at 64 MiB,
/// half of what every device holds, and progress is shown now and then.
inline int rowsPerBand(const Params& params) {
    const std::int64_t rows = (std::int64_t{1} << 20) / params.camera.width;
    return static_cast<int>(std::clamp<std::int64_t>(rows, 1, params.camera.rows));
}

/// Whether the kernel writes each ray's path, which AOVs and coloured opacities are made from.
inline bool wantsPaths(const Plan& plan, const Params& params) {
    return !params.aovs.empty() || (plan.dims && plan.colour);
}

} // namespace eikonal::view
