// Which devices there are, what they refuse, and what they hold.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"
#include "gpu/resources.h"
#include "support/device.h"
#include "support/scratch.h"

#include <limits>

using namespace eikonal;
using namespace eikonal::gpu;

TEST(GpuDevice, ThereIsOneAndItIsSoftwareIfAskedFor) {
    closeDevice();
    const auto devices = listDevices();
    ASSERT_FALSE(devices.empty());
    for (const DeviceInfo& device : devices) EXPECT_FALSE(device.renderer.empty());
    const DeviceInfo& info = eikonal::device().info();
    EXPECT_TRUE(info.software);
    EXPECT_FALSE(info.vendor.empty());
    EXPECT_FALSE(info.version.empty());
    const Limits& limits = eikonal::device().limits();
    // What OpenGL 4.5 asks of every device.
    EXPECT_GE(limits.storageBufferBytes, 1 << 27);
    EXPECT_GE(limits.texture3d, 2048);
    EXPECT_GE(limits.texture2d, 16384);
    EXPECT_GT(limits.memoryBytes, 0);
}

TEST(GpuDevice, ChoicesAreParsed) {
    using Kind = DeviceChoice::Kind;
    EXPECT_EQ(parseDeviceChoice("auto").kind, Kind::automatic);
    EXPECT_EQ(parseDeviceChoice("software").kind, Kind::software);
    EXPECT_EQ(parseDeviceChoice("12").kind, Kind::index);
    EXPECT_EQ(parseDeviceChoice("12").index, 12);
    for (const char* text : {"", "-1", "1x", "gpu", "99999999999", " 1"})
        expectError(ExitStatus::usage, {"--device", text}, [&] { parseDeviceChoice(text); });
}

TEST(GpuDevice, RefusesAnIndexThatIsNone) {
    closeDevice();
    const int count = static_cast<int>(listDevices().size());
    for (const int index : {count, 99})
        expectError(ExitStatus::device, {"--device " + std::to_string(index)}, [&] {
            Device device({DeviceChoice::Kind::index, index});
        });
}

TEST(GpuDevice, RefusesASoftwareDeviceWhereAGpuIsRequired) {
    closeDevice();
    expectError(ExitStatus::device, {"--require-gpu", "software"}, [] {
        Device device({DeviceChoice::Kind::software, 0, true});
    });
}

TEST(GpuDevice, SaysBeforehandWhatDoesNotFit) {
    const Device& device = eikonal::device();
    const Limits& limits = device.limits();
    EXPECT_NO_THROW(device.requireFit({}));
    EXPECT_NO_THROW(device.requireFit({{"a list", limits.storageBufferBytes, true, 0}}));
    expectError(ExitStatus::memory, {"a list", "bytes", "one buffer"}, [&] {
        device.requireFit({{"a list", limits.storageBufferBytes + 1, true, 0}});
    });
    expectError(ExitStatus::memory, {"a field", "texels", std::to_string(limits.texture3d)}, [&] {
        device.requireFit({{"a field", 1, false, limits.texture3d + 1}});
    });
    // Each fits, all of them don't.
    const std::int64_t half = limits.memoryBytes / 2 + 1;
    EXPECT_NO_THROW(device.requireFit({{"one", half, false, 0}}));
    expectError(ExitStatus::memory, {"bytes", "has"}, [&] {
        device.requireFit({{"one", half, false, 0}, {"another", half, false, 0}});
    });
    expectError(ExitStatus::memory, {"1,152,921,504,606,846,976 bytes"}, [&] {
        device.requireFit({{"all", std::int64_t{1} << 60, true, 0}});
    });
}

TEST(GpuDevice, KeepsAccountOfItsPeak) {
    closeDevice(); // to start from nothing
    Device& device = eikonal::device();
    const std::uint64_t before = device.peakBytes();
    const std::int64_t bytes = static_cast<std::int64_t>(before) + 4096;
    {
        const Buffer first(device, bytes);
        EXPECT_GE(device.peakBytes(), static_cast<std::uint64_t>(bytes));
    }
    const std::uint64_t peak = device.peakBytes();
    const Buffer second(device, bytes); // the first is gone: no higher than before
    EXPECT_EQ(device.peakBytes(), peak);
}
