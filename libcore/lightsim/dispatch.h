// Kernels that go through a list: a work item an entry.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"

#include <algorithm>
#include <cstdint>

namespace eikonal::lightsim {

/// Runs `items` work items in groups of 64, in rows: a device takes 65,535 groups along one
/// dimension, maybe not more. The kernel counts x + y * (gl_NumWorkGroups.x << 6). Waits for what
/// it writes.
inline void dispatchList(const gpu::Program& program, std::int64_t items) {
    constexpr std::int64_t kRow = std::int64_t{64} << 14;
    if (items > 0)
        program.dispatch({static_cast<int>(std::min(items, kRow)),
                          static_cast<int>((items + kRow - 1) / kRow), 1});
    gpu::barrier();
}

} // namespace eikonal::lightsim
