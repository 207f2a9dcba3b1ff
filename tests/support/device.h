// The device that tests share: opening one takes longer than most of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/device.h"

#include <memory>

namespace eikonal {

inline std::unique_ptr<gpu::Device>& sharedDevice() {
    static std::unique_ptr<gpu::Device> device;
    return device;
}

/// A software device, opened on the first call.
inline gpu::Device& device() {
    using namespace gpu;
    if (!sharedDevice())
        sharedDevice() = std::make_unique<Device>(DeviceChoice{DeviceChoice::Kind::software});
    return *sharedDevice();
}

/// Before another is opened, or all are listed: there is one at a time.
inline void closeDevice() {
    sharedDevice().reset();
}

} // namespace eikonal
