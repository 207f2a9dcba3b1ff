// Photons on the device: one batch of them, and how they are traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/photons.h"

#include "lightsim/voxels.h"

#include <utility>

namespace eikonal::lightsim {

namespace {

// Steps a photon makes in one run before the list is thinned, looks for boundaries included: enough
// for the photons that meet no boundary to be through, few enough that those done do not hold up
// their neighbours for long.
constexpr unsigned kStepsPerRun = 48;

gpu::Switches switchesOf(const Plan& plan, const Params& params, bool bounced) {
    gpu::Switches switches = scene::transportSwitches(plan.scene, params.tracing, plan.polarised);
    switches.emplace_back("CHANNELS", plan.tracedChannels());
    switches.emplace_back("MEDIUM", !plan.attenuates ? 0 : plan.dense ? 2 : 1);
    switches.emplace_back("DIRECTION", plan.wants(Output::direction));
    switches.emplace_back("VOLUME", plan.receivesInVolume());
    switches.emplace_back("SPARSE", plan.receivesInVolume() && atlasOf(plan).sparse);
    const bool onSurfaces = !plan.surfaces.empty() && (bounced || !plan.beams);
    switches.emplace_back("SURFACES", onSurfaces);
    switches.emplace_back("SURFACE_FLOW", plan.sumsFlow() && onSurfaces);
    switches.emplace_back("BOUNCES", bounced);
    return switches;
}

} // namespace

void Photons::fit(gpu::Device& device, std::int64_t all, const glm::ivec2& largest,
                  bool manyObjects, bool polarised) {
    if (mapSize != largest) {
        mapSize = largest;
        map = gpu::Texture(); // freed before the next is allocated
        map = gpu::Texture(device, glm::ivec3(largest, 0), gpu::TexelFormat::rgba32f,
                           gpu::Filter::nearest);
    }
    if (pixels == all) return;
    pixels = all;
    for (gpu::Buffer* buffer : {&slots, &list, &nextList, &objects, &polarisations})
        *buffer = gpu::Buffer();
    slots = gpu::Buffer(device, all * static_cast<std::int64_t>(sizeof(Photon)));
    list = gpu::Buffer(device, all * 4);
    nextList = gpu::Buffer(device, all * 4);
    if (manyObjects) objects = gpu::Buffer(device, all * kBytesPerSet);
    if (polarised) polarisations = gpu::Buffer(device, all * kBytesPerPolarisation);
    if (count.bytes() == 0) count = gpu::Buffer(device, 16);
}

void Photons::bind() const {
    count.bindStorage(kCountBuffer);
    slots.bindStorage(kPhotonsBuffer);
    list.bindStorage(kListBuffer);
    if (objects.bytes() > 0) objects.bindStorage(kObjectsBuffer);
    if (polarisations.bytes() > 0) polarisations.bindStorage(kPolarisationsBuffer);
}

PhotonTracer::PhotonTracer(gpu::Device& device, const Plan& plan, const Params& params,
                           bool bounced)
    : mProgram(device, "lightsim/trace.comp.glsl", switchesOf(plan, params, bounced)),
      mBlock(device, sizeof(PhotonParams)) {
    mParams.size = ivec4(plan.scene.size(), 0);
    if (plan.receivesInVolume()) {
        const glm::ivec3 bricks = plan.receiving.bricks;
        mParams.first = ivec4(-plan.receiving.first, 0);
        const AtlasLayout atlas = atlasOf(plan);
        mParams.bricks =
            ivec4(bricks.x, bricks.x * bricks.y, atlas.apart(plan.planes()), atlas.planesApart());
    }
    mParams.list = uvec4(0, kStepsPerRun, params.maxSteps, 0);
    mParams.depth = uvec4(params.maxDepth, params.seed << 16u, plan.bounces, 0);
    mParams.limits = vec4(params.stepMin, params.dropBelow, 0, 0);
}

void PhotonTracer::begin(const glm::dvec3& colour, unsigned batch) {
    mParams.colour = vec4(colour, 0);
    mParams.depth.y = (mParams.depth.y & 0xFFFF0000u) + batch;
}

std::uint32_t PhotonTracer::run(gpu::Device& device, const scene::Transport& transport,
                                const Media& media, const gpu::Texture& leaves, Photons& photons,
                                std::uint32_t count, double unit) {
    const std::uint32_t zero = 0;
    photons.count.upload(&zero, sizeof zero);
    mParams.list.x = count;
    mParams.limits.z = static_cast<float>(unit);
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    photons.bind();
    photons.nextList.bindStorage(kNextListBuffer);
    transport.bind();
    media.bind();
    if (leaves.name() != 0) leaves.bindSampler(kLeavesUnit);
    mProgram.dispatch({static_cast<int>(count), 1, 1});
    gpu::barrier();
    device.check("photons");
    std::uint32_t left = 0;
    photons.count.download(&left, sizeof left);
    std::swap(photons.list, photons.nextList);
    return left;
}

bool PhotonTracer::overflowed(const Photons& photons) {
    std::uint32_t overflowed = 0;
    photons.count.download(&overflowed, 4, 4);
    return overflowed != 0;
}

} // namespace eikonal::lightsim
