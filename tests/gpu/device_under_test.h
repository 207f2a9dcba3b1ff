// The device that the tests of the gpu room share: opening it takes longer than most of them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/device.h"
#include "gpu/program.h"
#include "gpu/resources.h"

#include <memory>

inline std::unique_ptr<eikonal::gpu::Device>& sharedDevice() {
    static std::unique_ptr<eikonal::gpu::Device> device;
    return device;
}

/// A software device, opened on the first call.
inline eikonal::gpu::Device& deviceUnderTest() {
    using namespace eikonal::gpu;
    if (!sharedDevice())
        sharedDevice() = std::make_unique<Device>(DeviceChoice{DeviceChoice::Kind::software});
    return *sharedDevice();
}

/// Before another is opened, or all are listed: there is one at a time.
inline void closeDeviceUnderTest() {
    sharedDevice().reset();
}
