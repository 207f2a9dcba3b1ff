// Buffers, textures and timers on the device, released by their destructors.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/stats.h"
#include "gpu/device.h"

#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::gpu {

/// Whether the host reads a buffer's content in place.
enum class InPlace { no, yes };

/// A storage or uniform buffer.
class Buffer {
public:
    Buffer() = default;
    Buffer(Device& device, std::int64_t bytes, InPlace read = InPlace::no);
    /// Filled at once with `bytes` from `data`.
    Buffer(Device& device, std::int64_t bytes, const void* data);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    void upload(const void* data, std::int64_t bytes, std::int64_t offset = 0);
    void download(void* data, std::int64_t bytes, std::int64_t offset = 0) const;
    void clear(); ///< to zero bytes
    /// Calls `look` with the content of a buffer that is read in place: nothing is copied where the
    /// device's memory is the host's.
    template<typename Look> void read(const Look& look) const {
        look(map());
        unmap();
    }
    /// The first `bytes` of another one.
    void copyFrom(const Buffer& other, std::int64_t bytes, std::int64_t offset = 0);
    void bindStorage(unsigned binding) const;
    void bindUniform(unsigned binding) const;
    unsigned name() const { return mName; }
    std::int64_t bytes() const { return mBytes; }

private:
    void allocate(const void* data, unsigned flags);
    const void* map() const;
    void unmap() const;

    Device* mDevice = nullptr;
    unsigned mName = 0;
    std::int64_t mBytes = 0;
};

enum class TexelFormat { r32f, rg32f, rgba16f, rgba32f, r8ui, r32ui, rg32ui, rgba32ui };
int componentsOf(TexelFormat format);
int bytesOf(TexelFormat format);

enum class Filter { nearest, linear };

/// A 2-D (depth of zero) or 3-D texture, one mip level, clamped at its edges.
class Texture {
public:
    Texture() = default;
    Texture(Device& device, glm::ivec3 size, TexelFormat format, Filter filter);
    ~Texture();
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;

    /// The whole content, x fastest. Floats of 32 bits take float, the others their own type.
    void upload(const void* data);
    /// `data` holds `count` slices from `slice` on.
    void uploadSlices(int slice, int count, const void* data);
    /// `data` holds `count` rows of a 2-D texture from `row` on.
    void uploadRows(int row, int count, const void* data);
    void download(void* data, std::int64_t bytes) const;
    void clear();                 ///< to zero
    void fill(const void* texel); ///< every texel to this one
    void bindSampler(unsigned unit) const;
    void bindImage(unsigned unit) const; ///< for reading and writing
    unsigned name() const { return mName; }
    glm::ivec3 size() const { return mSize; }
    std::int64_t bytes() const;

private:
    Device* mDevice = nullptr;
    unsigned mName = 0;
    glm::ivec3 mSize{0};
    TexelFormat mFormat = TexelFormat::r32f;
};

/// Orders everything written by shaders before what reads it next.
void barrier();

/// Waits until the device has done all it was told.
void finish();

/// Times passes on the device and the host; results land in a Stats.
class Profiler {
public:
    explicit Profiler(Stats& stats) : mStats(stats) {}
    ~Profiler();
    Profiler(const Profiler&) = delete;
    Profiler& operator=(const Profiler&) = delete;

    void begin(const std::string& pass);
    void end();
    /// Waits for the device and adds all finished passes to the stats.
    void collect();

private:
    struct Pending {
        std::string pass;
        unsigned queries[2] = {0, 0};
        double cpuMs = 0;
    };
    Stats& mStats;
    std::vector<Pending> mPending;
    std::chrono::steady_clock::time_point mBegin;
};

/// Milliseconds since `begin`, for host-only passes.
double millisecondsSince(std::chrono::steady_clock::time_point begin);

} // namespace eikonal::gpu
