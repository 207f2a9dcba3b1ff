// How photons leave a light: one for every pixel of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/emission.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;

gpu::Switches switchesOf(const Plan& plan, const Params& params) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, params.tracing);
    std::erase_if(switches, [](const auto& item) { return item.first == "INTEGRATOR"; });
    return switches;
}

// Between the photons that --photons auto sends [voxel, or of surfaces alone fine voxel]: so near
// that a voxel, smoothed once, is off by half a percent of the mean, in the mean.
constexpr double kPhotonEdge = 1.0 / 6;
constexpr std::int64_t kMostPhotons = 1 << 24;

/// Twelve triangles, outward.
std::vector<glm::vec4> trianglesOf(const VoxelBox& box) {
    const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<glm::vec4> corners;
    for (const auto& face : faces)
        for (int i : {0, 1, 2, 0, 2, 3}) {
            const int c = face[i];
            corners.emplace_back(c & 1 ? box.high.x : box.low.x, c & 2 ? box.high.y : box.low.y,
                                 c & 4 ? box.high.z : box.low.z, 1.0);
        }
    return corners;
}

} // namespace

std::vector<Batch> batchesOf(const Window& window) {
    const double pixels = static_cast<double>(window.pixels.x) * window.pixels.y;
    const int edge = std::max(
        1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(kBatchPixels)))));
    std::vector<Batch> batches;
    for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
            batches.push_back({window.batch(i, j, edge), {i, j, edge, 0}});
    return batches;
}

Emission::Emission(gpu::Device& device, const Plan& plan, const Params& params)
    : mMapProgram(device, "lightsim/map.vert.glsl", "lightsim/map.frag.glsl", {}),
      mProgram(device, "lightsim/emit.comp.glsl", switchesOf(plan, params)),
      mBlock(device, sizeof(EmissionParams)), mDomain{dvec3(-0.5), dvec3(plan.scene.size()) - 0.5},
      mTarget(mDomain), mReceivers(plan.receivesInVolume() ? 1 : plan.surfaces.detail),
      mSeed(params.seed), mManyObjects(scene::areMany(plan.scene.objects)) {
    std::vector<glm::vec4> corners;
    if (params.proxy.empty()) {
        corners = trianglesOf(mDomain);
    } else {
        mTarget = {dvec3(1e300), dvec3(-1e300)};
        const glm::dmat4 voxelFromWorld = plan.scene.voxelFromWorld();
        for (const dvec3& corner : params.proxy) {
            const dvec3 p(voxelFromWorld * glm::dvec4(corner, 1.0));
            mTarget.low = glm::min(mTarget.low, p);
            mTarget.high = glm::max(mTarget.high, p);
            corners.emplace_back(p, 1.0);
        }
    }
    mCorners = static_cast<std::int64_t>(corners.size());
    mSurface = gpu::Buffer(device, mCorners * 16, corners.data());
}

std::vector<Window> Emission::windowsOf(const Light& light, const Params& params) const {
    // The plastic number's powers spread successive seeds evenly over a pixel.
    const dvec2 shift = glm::fract(static_cast<double>(params.seed) *
                                   dvec2(0.7548776662466927, 0.5698402909980532));
    return lightsim::windowsOf(light, mTarget, mDomain,
                               {params.photons, kPhotonEdge / mReceivers, kMostPhotons}, shift,
                               !params.proxy.empty());
}

std::uint32_t Emission::emit(gpu::Device& device, const scene::Transport& transport,
                             const Batch& batch, Photons& photons) {
    const Window& window = batch.window;
    photons.fit(device, window.pixels, mManyObjects);
    EmissionParams values{};
    values.clipFromVoxel = mat4(window.clipFromVoxel());
    values.right = vec4(window.right, 0);
    values.up = vec4(window.up, 0);
    values.forward = vec4(window.forward, 0);
    values.window = vec4(window.low, window.extent);
    values.origin = vec4(window.origin, window.startsAtLight ? 1 : 0);
    values.low = vec4(mDomain.low, 0);
    values.high = vec4(mDomain.high, 0);
    values.weight = vec4(window.point ? 1 : 0, 0, 0, 0);
    values.map = ivec4(window.pixels, static_cast<int>(mSeed), 0);
    values.batch = batch.place;
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    photons.map.clear();
    if (!window.startsAtLight) {
        mSurface.bindStorage(kCornersBuffer);
        gpu::drawTriangles(mMapProgram, mCorners, window.pixels.x, window.pixels.y, &photons.map);
        gpu::barrier();
    }
    photons.count.clear();
    photons.bind();
    photons.map.bindSampler(kPhotonMapUnit);
    transport.bind();
    mProgram.dispatch({window.pixels, 1});
    gpu::barrier();
    device.check("photon emission");
    std::uint32_t emitted = 0;
    photons.count.download(&emitted, sizeof emitted);
    return emitted;
}

} // namespace eikonal::lightsim
