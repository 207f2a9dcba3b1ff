// Triangles on the device and the layers they are drawn into: what methods in image space stand on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "gpu/resources.h"

#include <cstdint>
#include <span>
#include <vector>

namespace eikonal::gpu {

/// Triangles by indices into vertices. Attribute k of a vertex shader is the k-th group of a
/// vertex's floats.
class Triangles {
public:
    Triangles() = default;
    /// `sizes` are the floats of each attribute; `vertices` holds their sum a vertex.
    Triangles(Device& device, std::span<const float> vertices, std::span<const int> sizes,
              std::span<const std::uint32_t> indices);
    ~Triangles();
    Triangles(Triangles&& other) noexcept;
    Triangles& operator=(Triangles&& other) noexcept;

    /// Some of them, in the list's order.
    struct Part {
        std::int64_t first, count;
    };
    void draw(const Part& part) const;
    Part all() const { return {0, mIndexCount / 3}; }

private:
    unsigned mName = 0;
    Buffer mVertices, mIndices;
    std::int64_t mIndexCount = 0;
};

/// An array of pictures of floats with mip levels. Look-ups by texelFetch take the nearest texel;
/// filtered ones are bilinear, and trilinear between levels, beyond the edges clamped.
class Layers {
public:
    Layers() = default;
    Layers(Device& device, int width, int height, int layers, int levels, TexelFormat format);
    ~Layers();
    Layers(Layers&& other) noexcept;
    Layers& operator=(Layers&& other) noexcept;

    void clear(int layer); ///< its finest level, to zero
    void makeLevels();     ///< all coarser ones, from the finest
    void bindSampler(unsigned unit) const;
    void bindImage(unsigned unit) const; ///< its finest level, for reading and writing
    /// The finest level, layer by layer.
    void download(void* data, std::int64_t bytes) const;
    unsigned name() const { return mName; }
    int width() const { return mWidth; }
    int height() const { return mHeight; }

    /// What it takes on the device.
    static std::int64_t bytesFor(int width, int height, int layers, int levels, TexelFormat format);

private:
    Device* mDevice = nullptr;
    unsigned mName = 0;
    int mWidth = 0, mHeight = 0;
    std::int64_t mBytes = 0;
    TexelFormat mFormat = TexelFormat::rgba32f;
};

enum class Faces { front, back, both };

/// Draws triangles into a layer, the nearest or the furthest of what falls on a pixel. Clip space
/// has y down, so that row 0 is on top, and depths from 0, far, to 1, near; faces whose corners run
/// anticlockwise in the picture, as the eye sees it, are front faces.
class Canvas {
public:
    Canvas() = default;
    Canvas(Device& device, int width, int height);
    ~Canvas();
    Canvas(Canvas&& other) noexcept;
    Canvas& operator=(Canvas&& other) noexcept;

    struct Target {
        const Layers* layers = nullptr;
        int layer = 0;
    };
    /// Clears depth; attachment k of the fragment shader is the k-th target.
    void begin(const std::vector<Target>& targets, bool furthest);
    void draw(const Program& program, const Triangles& triangles, Faces faces,
              const Triangles::Part& part);
    /// Whether a fragment was kept since begin(); waits for the device.
    bool end(bool ask);
    /// Runs a fragment program, whose vertex program makes one triangle of gl_VertexID 0 to 2, for
    /// each pixel of a 2-D texture that the last triangles drawn here, the nearest, cover or leave
    /// bare, and adds what it gives.
    void addWhere(bool covered, const Program& program, const Texture& target) const;

private:
    unsigned mName = 0, mDepth = 0, mQuery = 0;
    unsigned mOverall = 0, mNoVertices = 0; ///< what addWhere() draws to, and from
    int mWidth = 0, mHeight = 0;
};

} // namespace eikonal::gpu
