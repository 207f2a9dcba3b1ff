// Rays followed among layers of surfaces, peeled off one behind the other.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/follow.h"

#include "imagespace/picture.h"

namespace eikonal::imagespace {

namespace {

constexpr auto kFormat = gpu::TexelFormat::rgba32f;

} // namespace

std::vector<gpu::Need> Follower::needs(const Params& params, bool hasPlates) {
    const auto bytes = [&](int layers) {
        return gpu::Layers::bytesFor(params.camera.width, params.camera.rows, layers, 1, kFormat);
    };
    std::vector<gpu::Need> needs{{"the layers of surfaces", bytes(2 * params.layers)}};
    if (hasPlates) needs.push_back({"the layers of plates", bytes(2 * params.layers)});
    return needs;
}

Follower::Follower(gpu::Device& device, const Params& params, bool hasMap, bool hasPlates)
    : mMost(2 * params.layers), mSize(params.camera.width, params.camera.rows),
      mPeel(device, "imagespace/surface.vert.glsl", "imagespace/surface.frag.glsl",
            {{"PEELS", 1}, {"EXTRA", 0}}),
      mFollow(device, "imagespace/follow.comp.glsl",
              {{"MAP", hasMap}, {"AOVS", wantsPaths(params)}, {"PLATES", hasPlates}}),
      mSurfaces(device, mSize.x, mSize.y, mMost, 1, kFormat), mCounters(device, 4) {
    mCounters.clear();
    if (!hasPlates) return;
    mPeelPlates = gpu::Program(device, "imagespace/surface.vert.glsl",
                               "imagespace/surface.frag.glsl", {{"PEELS", 1}, {"EXTRA", 1}});
    mPlates = gpu::Layers(device, mSize.x, mSize.y, params.layers, 1, kFormat);
    mAlbedos = gpu::Layers(device, mSize.x, mSize.y, params.layers, 1, kFormat);
}

int Follower::peel(gpu::Canvas& canvas, const gpu::Program& program, const gpu::Layers& layers,
                   const gpu::Layers* beside, const Drawn& drawn, ImageSpaceParams& values,
                   const std::function<void()>& upload) {
    values.cameraFromBody = drawn.cameraFromBody;
    const int most = beside ? mMost / 2 : mMost;
    for (int layer = 0; layer < most; ++layer) {
        values.limits.y = layer;
        upload();
        layers.bindSampler(kFrontsUnit);
        std::vector<gpu::Canvas::Target> targets{{&layers, layer}};
        if (beside) targets.push_back({beside, layer});
        canvas.begin(targets, false);
        canvas.draw(program, *drawn.triangles, gpu::Faces::both, drawn.triangles->all());
        if (!canvas.end(true)) return layer;
    }
    return most;
}

void Follower::draw(gpu::Canvas& canvas, const Drawn& body, const Drawn& plates,
                    ImageSpaceParams& values, const std::function<void()>& upload,
                    gpu::Profiler& profiler) {
    profiler.begin("layers");
    values.limits.w = 0;
    if (plates.triangles)
        values.limits.w = peel(canvas, mPeelPlates, mPlates, &mAlbedos, plates, values, upload);
    mUsed = peel(canvas, mPeel, mSurfaces, nullptr, body, values, upload);
    profiler.end();
    profiler.begin("paths");
    values.limits.y = mUsed;
    upload();
    mSurfaces.bindSampler(kFrontsUnit);
    if (plates.triangles) {
        mPlates.bindSampler(kPlatesUnit);
        mAlbedos.bindSampler(kAlbedosUnit);
    }
    mCounters.bindStorage(kCountersBuffer);
    mFollow.dispatch({mSize.x, mSize.y, 1});
    gpu::barrier();
    profiler.end();
}

double Follower::lost() const {
    std::uint32_t lost = 0;
    if (mCounters.bytes() > 0) mCounters.download(&lost, sizeof lost);
    return lost;
}

} // namespace eikonal::imagespace
