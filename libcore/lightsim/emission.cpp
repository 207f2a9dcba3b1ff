// How photons leave a light: one for every pixel of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/emission.h"

#include "lightsim/spread.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace eikonal::lightsim {

namespace {

using glm::dvec2;
using glm::dvec3;

gpu::Switches switchesOf(const Plan& plan, const Params& params) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, params.tracing, plan.polarised);
    std::erase_if(switches, [](const auto& item) { return item.first == "INTEGRATOR"; });
    switches.emplace_back("EXTENDED", plan.sourcesDiffer);
    return switches;
}

// Between the photons that --photons auto sends [voxel, or of surfaces alone fine voxel]: so near
// that a voxel, smoothed once, is off by half a percent of the mean, in the mean.
constexpr double kPhotonEdge = 1.0 / 6;
constexpr std::int64_t kMostPhotons = 1 << 24;

// Edge of the tiles of a map that are aimed at or not [pixel].
constexpr int kTile = 16;

// A lamp so far off the domain is next to it [voxel].
constexpr double kNextTo = 2;

/// The interleaved parts of a window, none of more than kBatchPixels.
std::vector<Part> interleaved(const Window& window, unsigned number) {
    const double pixels = static_cast<double>(window.pixels.x) * window.pixels.y;
    const int edge = std::max(
        1, static_cast<int>(std::ceil(std::sqrt(pixels / static_cast<double>(kBatchPixels)))));
    std::vector<Part> parts;
    for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
            parts.push_back(
                {window.batch(i, j, edge), {i, j, edge, 0}, number, window.pixelArea()});
    return parts;
}

/// How far the pixels of a light's sources are shifted, so that photons of many fill each other's
/// gaps; 0 of the first.
dvec2 shiftOf(unsigned number) {
    return glm::fract(static_cast<double>(number) * dvec2(0.7548776662466927, 0.5698402909980532));
}

/// A batch of many sources' parts, in units of the brightest of each channel.
Batch together(std::vector<Part> parts, double voxelArea) {
    Batch batch;
    batch.unit = {dvec3(0), 1, parts[0].window.point};
    Unit& unit = batch.unit;
    for (Part& part : parts) {
        part.weight = part.window.source.rgb * part.area * (unit.isPoint ? 1.0 : voxelArea);
        unit.rgb = glm::max(unit.rgb, part.weight);
    }
    for (Part& part : parts)
        for (int c = 0; c < 3; ++c) part.weight[c] /= unit.rgb[c] > 0 ? unit.rgb[c] : 1.0;
    batch.parts = std::move(parts);
    return batch;
}

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

std::int64_t Batch::pixels() const {
    std::int64_t sum = 0;
    for (const Part& part : parts) sum += part.pixels();
    return sum;
}

Emission::Emission(gpu::Device& device, const Plan& plan, const Params& params)
    : mMapProgram(device, "lightsim/map.vert.glsl", "lightsim/map.frag.glsl", {}),
      mProgram(device, "lightsim/emit.comp.glsl", switchesOf(plan, params)), mDevice(device),
      mBlock(device, sizeof(EmissionParams)), mTiles(device, 4),
      mAims(plan), mDomain{dvec3(-0.5), dvec3(plan.scene.size()) - 0.5}, mTarget(mDomain),
      mVoxelSize(plan.scene.voxelSize()), mSeed(params.seed),
      mManyObjects(scene::areMany(plan.scene.objects)), mPolarises(plan.polarises()),
      mSourcesDiffer(plan.sourcesDiffer), mStartsOnDomain(params.proxy.empty()) {
    const auto voxel = static_cast<float>(mVoxelSize);
    mAbsorption = vec4(voxel * plan.scene.medium().absorption.value, 0);
    mScattering = vec4(voxel * plan.scene.medium().scattering.value, 0);
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

std::vector<Part> Emission::partsOf(const std::vector<Source>& sources, const Params& params,
                                    double receivers, bool aimed) const {
    // The plastic number's powers spread successive seeds evenly over a pixel.
    const dvec2 seeded =
        static_cast<double>(params.seed) * dvec2(0.7548776662466927, 0.5698402909980532);
    const auto count = std::max<std::int64_t>(static_cast<std::int64_t>(sources.size()), 1);
    const MapDetail detail{
        params.photons > 0 ? std::max<std::int64_t>(params.photons / count, 1) : 0,
        kPhotonEdge / receivers * std::sqrt(static_cast<double>(count)), kMostPhotons / count};
    std::vector<Part> parts;
    // Of a light of many sources each would look at all voxels for its few photons.
    const bool aims = aimed && !mAims.everywhere() && mStartsOnDomain && sources.size() == 1;
    for (unsigned k = 0; k < sources.size(); ++k) {
        const dvec2 shift = glm::fract(seeded + shiftOf(k));
        for (const Window& window : lightsim::windowsOf(sources[k], mTarget, mDomain, detail, shift,
                                                        !params.proxy.empty())) {
            std::shared_ptr<const AimedMap> map;
            // Voxels next to a lamp see it at all angles.
            if (aims && !(window.point && mDomain.contains(window.origin, kNextTo)))
                map = std::make_shared<AimedMap>(mAims.mapOf(window, kTile));
            for (Part& part : interleaved(window, k)) {
                part.aimed = map;
                if (part.pixels() > 0) parts.push_back(std::move(part));
            }
        }
    }
    return parts;
}

std::vector<Batch> Emission::batchesOf(const std::vector<Source>& sources, const Params& params,
                                       double receivers, bool aimed) const {
    const double voxelArea = mVoxelSize * mVoxelSize;
    std::vector<Batch> batches;
    std::vector<Part> some;
    std::int64_t pixels = 0;
    for (Part& part : partsOf(sources, params, receivers, aimed)) {
        if (sources.size() == 1) {
            const bool point = part.window.point;
            const double power = part.area * (point ? 1.0 : voxelArea);
            batches.push_back({{part}, {sources[0].rgb, power, point}});
            continue;
        }
        if (pixels + part.pixels() > kBatchPixels && !some.empty()) {
            batches.push_back(together(std::move(some), voxelArea));
            some.clear();
            pixels = 0;
        }
        pixels += part.pixels();
        some.push_back(std::move(part));
    }
    if (!some.empty()) batches.push_back(together(std::move(some), voxelArea));
    return batches;
}

/// What a window alone tells.
EmissionParams Emission::paramsOf(const Window& window) const {
    EmissionParams values{};
    values.clipFromVoxel = mat4(window.clipFromVoxel());
    values.right = vec4(window.right, 0);
    values.up = vec4(window.up, 0);
    values.forward = vec4(window.forward, 0);
    values.window = vec4(window.low, window.extent);
    values.origin = vec4(window.origin, 0);
    values.low = vec4(mDomain.low, 0);
    values.high = vec4(mDomain.high, 0);
    values.weight = vec4(window.point ? 1 : 0, 1, 1, 1);
    values.map = ivec4(window.pixels, 0, 0);
    values.batch = ivec4(0, 0, 1, 0);
    values.axis = axisOf(window.source);
    values.cone = coneOf(window.source);
    values.absorption = mAbsorption;
    values.scattering = mScattering;
    values.tiles = ivec4(kTile, 0, 0, 0);
    return values;
}

void Emission::bindTiles(const AimedMap* map) {
    if (map != nullptr) {
        const auto bytes = static_cast<std::int64_t>(map->tiles.size() * sizeof(std::uint32_t));
        if (mTiles.bytes() < bytes) mTiles = gpu::Buffer(mDevice, bytes);
        mTiles.upload(map->tiles.data(), bytes);
    }
    mTiles.bindStorage(kAimsBuffer);
}

void Emission::bindPlain(const AimedMap& map) {
    EmissionParams values = paramsOf(map.window);
    values.tiles.y = map.across;
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kEmissionBlock);
    bindTiles(&map);
}

void Emission::emit(gpu::Device& device, const Part& part, std::int64_t first, Photons& photons) {
    const Window& window = part.window;
    EmissionParams values = paramsOf(window);
    const bool onFaces = mSourcesDiffer && mStartsOnDomain;
    values.origin.w = window.startsAtLight ? 1 : onFaces ? 2 : 0;
    values.weight = vec4(values.weight.x, part.weight);
    values.map.z = static_cast<int>(mSeed + 0x9E3779B9u * part.number);
    values.map.w = static_cast<int>(first);
    values.batch = part.place;
    values.tiles.y = part.aimed ? part.aimed->across : 0;
    // Windows of points are not shifted: their rays are, within the pixels.
    const bool shifts = window.point && (onFaces || window.startsAtLight);
    const dvec2 inPixel = shifts ? glm::fract(0.5 + shiftOf(part.number)) : dvec2(0.5);
    values.polarizer = vec4(window.source.polarizer, 0);
    values.cone.z = static_cast<float>(inPixel.x);
    values.cone.w = static_cast<float>(inPixel.y);
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    bindTiles(part.aimed.get());
    if (!window.startsAtLight && !onFaces) {
        photons.map.clear();
        mSurface.bindStorage(kCornersBuffer);
        gpu::drawTriangles(mMapProgram, mCorners, window.pixels.x, window.pixels.y, &photons.map);
        gpu::barrier();
    }
    photons.bind();
    mProgram.dispatch({window.pixels, 1});
    gpu::barrier();
    device.check("photon emission");
}

std::uint32_t Emission::emit(gpu::Device& device, const scene::Transport& transport,
                             const Batch& batch, Photons& photons) {
    glm::ivec2 largest(0);
    for (const Part& part : batch.parts) largest = glm::max(largest, part.window.pixels);
    photons.fit(device, batch.pixels(), largest, mManyObjects, mPolarises);
    photons.count.clear();
    photons.map.bindSampler(kPhotonMapUnit);
    transport.bind();
    std::int64_t first = 0;
    for (const Part& part : batch.parts) {
        emit(device, part, first, photons);
        first += part.pixels();
    }
    std::uint32_t emitted = 0;
    photons.count.download(&emitted, sizeof emitted);
    return emitted;
}

} // namespace eikonal::lightsim
