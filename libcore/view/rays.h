// Viewing rays on the device: the kernel, the media and the light that it reads.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/program.h"
#include "scene/transport.h"
#include "view/shared.h"
#include "view/view.h"

namespace eikonal::view {

/// Coefficients and light as textures, in the form the plan's effects call for.
struct Media {
    gpu::Texture extinction, source, direction, emission, opacity, fluence;
    scene::SurfaceLightTable surfaces;

    Media() = default;
    Media(gpu::Device& device, const Plan& plan);
    void bind() const;
};

/// What media and light take on the device.
std::vector<gpu::Need> mediaNeeds(const Plan& plan);

/// One ray of each pixel.
struct Launch {
    glm::dvec2 place{0.5}; ///< where in its pixel it goes
    bool first = true;     ///< replaces what the picture held, and writes the ray's path
    vec4 weight{1};        ///< its share of the pixel's colour and, w, coverage
    int number = 0;        ///< among its pixel's
    int shift = 0;         ///< of its line among a band's
};

class Rays {
public:
    /// Times its programs as the pass "shaders", what it uploads as "medium".
    Rays(gpu::Device& device, const Plan& plan, const Params& params,
         const std::optional<image::Image>& map, gpu::Profiler& profiler);

    /// What the next rays see: see scene::Transport::setLines().
    void setLines(const std::vector<optics::Line>& lines) { mTransport.setLines(lines); }
    /// Traces one ray of each pixel of a strip: `rows` rows from `row` on.
    void trace(int row, int rows, const Launch& launch);
    /// Goes on with so many rays that the last launch left at rest, in one half of their buffer.
    void goOn(int resting, int half);
    /// Binds all it reads but the picture's own buffers.
    void bind() const;

private:
    void launch(int width, int rows);
    void uploadPoints(gpu::Device& device, const Plan& plan, const PointLights& points);

    gpu::Program mProgram;
    scene::Transport mTransport;
    Media mMedia;
    gpu::Texture mMap, mPlatePicture, mPointPlaces, mPointLights;
    gpu::Buffer mBlock, mGround, mPlate;
    ViewParams mValues{};
    int mWidth;
};

} // namespace eikonal::view
