// Opaque surfaces that receive light: fixed-point sums that become irradiance.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/surfaces.h"

#include "lightsim/dispatch.h"
#include "scene/block_table.h"
#include "scene/lattice.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/integer.hpp>
#include <glm/packing.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;

gpu::Switches switchesOf(const Plan& plan, int measure) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, {});
    std::erase_if(switches, [](const auto& item) { return item.first == "INTEGRATOR"; });
    switches.emplace_back("MEASURE", measure);
    return switches;
}

ivec3 rowsFor(std::int64_t count, int planes) {
    return scene::rowsFor(static_cast<size_t>(count) * static_cast<size_t>(planes));
}

gpu::Buffer bufferOf(gpu::Device& device, const std::vector<std::uint32_t>& values) {
    return {device, static_cast<std::int64_t>(values.size() * 4), values.data()};
}

/// A bit for each brick of the domain that holds surface voxels, x fastest.
std::vector<std::uint32_t> receivingBits(const scene::SurfaceVoxels& list) {
    const ivec3 bricks = (list.size + kBrickEdge - 1) / kBrickEdge;
    const size_t count = static_cast<size_t>(bricks.x) * bricks.y * bricks.z;
    std::vector<std::uint32_t> bits((count + 31) / 32);
    for (const std::uint32_t place : list.voxels) {
        const ivec3 brick = scene::atPlace(list.size, place) / kBrickEdge;
        const size_t at = scene::placeOf(bricks, brick.x, brick.y, brick.z);
        bits[at / 32] |= 1u << (at % 32);
    }
    return bits;
}

/// The number of a fine voxel, or −1 where no surface crosses it.
std::int64_t numberOf(const scene::SurfaceVoxels& list, const ivec3& fine) {
    const int edge = list.detail;
    if (fine != glm::clamp(fine, ivec3(0), edge * list.size - 1)) return -1;
    const ivec3 voxel = fine / edge, within = fine - edge * voxel;
    const auto place =
        static_cast<std::uint32_t>(scene::placeOf(list.size, voxel.x, voxel.y, voxel.z));
    const auto found = std::lower_bound(list.voxels.begin(), list.voxels.end(), place);
    if (found == list.voxels.end() || *found != place) return -1;
    const size_t record = static_cast<size_t>(found - list.voxels.begin()) *
                          static_cast<size_t>(scene::maskWords(edge) + 1);
    const std::uint32_t* words = list.records.data() + record;
    const int bit = (within.z * edge + within.y) * edge + within.x;
    const std::uint32_t mask = words[1 + bit / 32], one = 1U << (bit % 32);
    if ((mask & one) == 0) return -1;
    std::int64_t number = words[0] + glm::bitCount(mask & (one - 1));
    for (int word = 0; word < bit / 32; ++word) number += glm::bitCount(words[1 + word]);
    return number;
}

} // namespace

SurfaceReceiver::SurfaceReceiver(gpu::Device& device, const Plan& plan,
                                 const scene::Transport& transport, const Media& media,
                                 gpu::Profiler& profiler)
    : mCollect(device, "lightsim/collect.comp.glsl",
               {{"CHANNELS", plan.tracedChannels()},
                {"FLUENCE", plan.fluenceChannels()},
                {"SURFACE_FLOW", plan.sumsFlow()}}),
      mIrradiance(device, "lightsim/irradiance.comp.glsl",
                  {{"FLUENCE", plan.fluenceChannels()}, {"SURFACE_FLOW", plan.sumsFlow()}}),
      mBlock(device, sizeof(LayoutParams)), mChannels(plan.tracedChannels()),
      mStored(plan.fluenceChannels()), mFlow(plan.sumsFlow()), mVoxelSize(plan.scene.voxelSize()) {
    if (mFlow) mReader.emplace(device, mStored);
    const OpaqueSurfaces& surfaces = plan.surfaces;
    const int detail = surfaces.detail, words = scene::maskWords(detail);
    transport.bind();
    media.bind();
    LayoutParams values{};
    values.size = ivec4(plan.scene.size(), detail);
    values.list = ivec4(static_cast<int>(surfaces.voxels.size()), words, 0, 0);
    std::vector<std::uint32_t> masks(surfaces.voxels.size() * static_cast<size_t>(words));
    { // which fine voxels
        const gpu::Program mark(device, "lightsim/surface.comp.glsl", switchesOf(plan, 0));
        const gpu::Buffer list = bufferOf(device, surfaces.voxels);
        gpu::Buffer bits = bufferOf(device, masks);
        mBlock.upload(&values, sizeof values);
        mBlock.bindUniform(kParamsBlock);
        list.bindStorage(kVoxelListBuffer);
        bits.bindStorage(kMasksBuffer);
        profiler.begin("surface voxels");
        dispatchList(mark, values.list.x);
        profiler.end();
        bits.download(masks.data(), bits.bytes());
    }
    mVoxels = scene::SurfaceVoxels(plan.scene.size(), detail, surfaces.voxels, masks);
    mTable = scene::SurfaceTable(device, mVoxels);
    mList = bufferOf(device, mVoxels.voxels);
    mAreas = gpu::Buffer(device, mVoxels.count * 8);
    if (mFlow) mReceiving = bufferOf(device, receivingBits(mVoxels));
    const gpu::Program measure(device, "lightsim/surface.comp.glsl", switchesOf(plan, 1));
    values.list.x = static_cast<int>(mVoxels.voxels.size());
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    mTable.bind();
    mList.bindStorage(kVoxelListBuffer);
    mAreas.bindStorage(kAreasBuffer);
    profiler.begin("surface areas");
    dispatchList(measure, values.list.x);
    profiler.end();
    device.check("surface voxels");
    const int flow = mFlow ? 3 : 0;
    mPower = gpu::Texture(device, rowsFor(mVoxels.count, mStored + flow), gpu::TexelFormat::r32f,
                          gpu::Filter::nearest);
    if (plan.bounces > 0)
        mBounced =
            gpu::Texture(device, mPower.size(), gpu::TexelFormat::r32f, gpu::Filter::nearest);
    renew(device);
}

void SurfaceReceiver::renew(gpu::Device& device) {
    const std::int64_t planes = mChannels + (mFlow ? 3 : 0);
    mSums = gpu::Buffer(device, 4 * std::max<std::int64_t>(mVoxels.count, 1) * planes);
    clearSums();
    mPower.clear();
    if (mBounced.name() != 0) mBounced.clear();
}

void SurfaceReceiver::bind() const {
    mTable.bind();
    mSums.bindStorage(kSurfaceSumsBuffer);
}

void SurfaceReceiver::bindReceiving() const {
    if (mReceiving.bytes() > 0) mReceiving.bindStorage(kReceivingBuffer);
}

void SurfaceReceiver::clearSums() {
    mSums.clear();
}

void SurfaceReceiver::collect(gpu::Device& device, const glm::dvec3& rgb, double power, double unit,
                              bool bounced) {
    LayoutParams values{};
    values.list.z = static_cast<int>(mVoxels.count);
    values.weight = vec4(rgb * (power / unit), (rgb.x + rgb.y + rgb.z) / 3 * (power / unit));
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    bind();
    (bounced ? mBounced : mPower).bindImage(kSurfacePowerImage);
    dispatchList(mCollect, mVoxels.count);
    device.check("collecting light on surfaces");
    clearSums();
}

gpu::Texture SurfaceReceiver::makeIrradiance(gpu::Device& device) {
    gpu::Texture result(device, mPower.size(), gpu::TexelFormat::r32f, gpu::Filter::nearest);
    LayoutParams values{};
    values.size = ivec4(mVoxels.size, mVoxels.detail);
    values.list = ivec4(static_cast<int>(mVoxels.voxels.size()), 0, mVoxels.count, 0);
    values.weight.w = static_cast<float>(mVoxelSize * mVoxelSize);
    mBlock.upload(&values, sizeof values);
    mBlock.bindUniform(kParamsBlock);
    mTable.bind();
    mList.bindStorage(kVoxelListBuffer);
    mAreas.bindStorage(kAreasBuffer);
    mPower.bindImage(kSurfacePowerImage);
    result.bindImage(kIrradianceImage);
    dispatchList(mIrradiance, values.list.x);
    device.check("irradiance");
    return result;
}

std::vector<LightAtPoint> SurfaceReceiver::readPoints(gpu::Device& device,
                                                      const std::vector<PointOnSurface>& points,
                                                      const glm::dmat3& turn) {
    const gpu::Texture irradiance = makeIrradiance(device);
    std::vector<LightAtPoint> found =
        mReader->read(device, points, mTable, irradiance, mVoxels.count);
    for (LightAtPoint& light : found) light.flow = glm::mat3(turn) * light.flow;
    mPower.clear();
    return found;
}

volume::FineGrid SurfaceReceiver::finish(gpu::Device& device) {
    mSums = gpu::Buffer(); // its memory serves the result
    const gpu::Texture result = makeIrradiance(device);
    const ivec3 rows = result.size();
    std::vector<float> stored(static_cast<size_t>(rows.x) * rows.y * rows.z);
    result.download(stored.data(), result.bytes());
    volume::FineGrid found;
    found.detail = mVoxels.detail;
    found.voxels.resize(static_cast<size_t>(mVoxels.count));
    found.values.resize(found.voxels.size());
    mVoxels.forEach([&](std::uint32_t number, const ivec3& fine) {
        found.voxels[number] = fine;
        for (int c = 0; c < 3; ++c)
            found.values[number][c] =
                stored[number +
                       static_cast<size_t>(std::min(c, mStored - 1)) * found.voxels.size()];
    });
    return found;
}

SurfacePatches SurfaceReceiver::takeBounced() {
    const auto count = static_cast<size_t>(mVoxels.count);
    std::vector<glm::uvec2> areas(count);
    mAreas.download(areas.data(), mVoxels.count * 8);
    const ivec3 rows = mBounced.size();
    std::vector<float> stored(static_cast<size_t>(rows.x) * rows.y * rows.z);
    mBounced.download(stored.data(), mBounced.bytes());
    mBounced.clear();
    SurfacePatches patches;
    mVoxels.forEach([&](std::uint32_t i, const ivec3& fine) {
        const auto plane = [&](int k) { return stored[i + static_cast<size_t>(k) * count]; };
        SurfacePatch part;
        part.voxel = fine / mVoxels.detail;
        for (int c = 0; c < 3; ++c) part.power[c] = plane(std::min(c, mStored - 1));
        for (int c = 0; c < 3 && mFlow; ++c) part.flow[c] = plane(mStored + c);
        part.normal = glm::vec3(glm::unpackSnorm4x8(areas[i].y));
        part.area = glm::uintBitsToFloat(areas[i].x) * static_cast<float>(mVoxelSize * mVoxelSize);
        gather(patches, part);
    });
    link(patches);
    return patches;
}

/// Patches of neighbouring voxels hang together where surface voxels of both touch.
void SurfaceReceiver::link(SurfacePatches& patches) const {
    std::vector<ivec3> fine(static_cast<size_t>(mVoxels.count));
    mVoxels.forEach([&](std::uint32_t i, const ivec3& at) { fine[i] = at; });
    using Links = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    tbb::enumerable_thread_specific<Links> parts;
    const tbb::blocked_range<size_t> all(0, fine.size(), 1024);
    tbb::parallel_for(all, [&](const tbb::blocked_range<size_t>& some) {
        Links& links = parts.local();
        for (size_t i = some.begin(); i < some.end(); ++i)
            for (int k = 0; k < 27; ++k) {
                const ivec3 at = fine[i] + ivec3(k % 3, k / 3 % 3, k / 9) - 1;
                if (at / mVoxels.detail == fine[i] / mVoxels.detail) continue;
                const std::int64_t number = numberOf(mVoxels, at);
                if (number < 0) continue;
                const std::uint32_t from = patches.ofFine[i];
                const std::uint32_t to = patches.ofFine[static_cast<size_t>(number)];
                const std::pair link(from, to);
                if ((links.empty() || links.back() != link) &&
                    areOne(patches.all[from].normal, patches.all[to].normal))
                    links.push_back(link);
            }
    });
    for (const Links& links : parts)
        patches.links.insert(patches.links.end(), links.begin(), links.end());
    std::sort(patches.links.begin(), patches.links.end());
    patches.links.erase(std::unique(patches.links.begin(), patches.links.end()),
                        patches.links.end());
}

std::vector<gpu::Need> surfaceNeeds(const Plan& plan) {
    const OpaqueSurfaces& surfaces = plan.surfaces;
    const std::int64_t count = surfaces.about();
    std::vector<gpu::Need> needs = scene::surfaceTableNeeds(
        static_cast<std::int64_t>(surfaces.voxels.size()) / 2, surfaces.detail);
    needs.push_back(
        {"the bits of fine voxels",
         4 * static_cast<std::int64_t>(surfaces.voxels.size()) * scene::maskWords(surfaces.detail),
         true, 0});
    needs.push_back({"the areas of surface voxels", 8 * count, true, 0});
    const int flow = plan.sumsFlow() ? 3 : 0;
    needs.push_back(
        {"what falls on surfaces", 4 * count * (plan.tracedChannels() + flow), true, 0});
    needs.push_back({"the light on surfaces",
                     4 * count * (plan.fluenceChannels() + flow) * (plan.bounces > 0 ? 3 : 2),
                     false, 0});
    return needs;
}

} // namespace eikonal::lightsim
