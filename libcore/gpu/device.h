// A headless OpenGL 4.5 context on the device the user chose: the ground every engine stands on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace eikonal::gpu {

struct DeviceInfo {
    std::string vendor, renderer, version; ///< as OpenGL names itself
    bool software = false;                 ///< runs on the CPU
};

/// Which device to open: `--device auto|software|N`, `--require-gpu`.
struct DeviceChoice {
    enum class Kind { automatic, software, index } kind = Kind::automatic;
    int index = 0;           ///< into listDevices(), for Kind::index
    bool requireGpu = false; ///< refuse a software device
    int threads = 0;         ///< of a software device; 0: all processors
};

/// "auto", "software" or a number. Throws UsageError.
DeviceChoice parseDeviceChoice(const std::string& text);

/// Every device that gives an OpenGL 4.5 core context, in EGL's order; the index is the N of
/// `--device N`. Empty where there is none.
std::vector<DeviceInfo> listDevices();

/// What the device can hold.
struct Limits {
    std::int64_t storageBufferBytes = 0; ///< largest shader storage buffer [byte]
    int texture3d = 0;                   ///< largest edge of a 3-D texture [texel]
    int texture2d = 0;                   ///< largest edge of a 2-D texture [texel]
    int framebuffer = 0;                 ///< largest edge of a framebuffer [pixel]
    std::int64_t memoryBytes = 0;        ///< free memory when opened [byte]; 0: unknown
};

/// One thing a stage is about to allocate on the device.
struct Need {
    std::string what;
    std::int64_t bytes = 0;
    bool storageBuffer = false; ///< held to Limits::storageBufferBytes
    int edge3d = 0;             ///< longest edge, if a 3-D texture
    int edge2d = 0;             ///< the same of a 2-D texture
};

/// Owns the context, current on the thread that made it, until destroyed. Every gpu object needs
/// one alive; there is one at a time. (EGL_EXT_platform_device first, Mesa's surfaceless platform
/// next.)
class Device {
public:
    /// Throws DeviceError if no device fits the choice.
    explicit Device(const DeviceChoice& choice);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    const Limits& limits() const;

    /// Throws MemoryError naming the bytes needed if `needs` can't all be held at once.
    void requireFit(const std::vector<Need>& needs) const;

    /// Throws InternalError, or MemoryError, if OpenGL has reported an error; `where` names the
    /// pass.
    void check(const std::string& where) const;

    /// Bookkeeping for gpu objects: a (de)allocation of so many bytes.
    void account(std::int64_t bytes);
    std::uint64_t peakBytes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

} // namespace eikonal::gpu
