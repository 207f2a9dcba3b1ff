// What a run measured, as the JSON of --stats.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/history.h"
#include "base/stats.h"

#include <string>

namespace eikonal::gpu {
struct DeviceInfo;
}

namespace eikonal::tool {

/// `device` is null where none was opened.
std::string statsText(const Stats& stats, const History& history, const gpu::DeviceInfo* device,
                      double wallMs);

} // namespace eikonal::tool
