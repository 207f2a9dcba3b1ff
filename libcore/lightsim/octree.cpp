// The tolerance octree on the device (Sun et al. 2008, §4.2, §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/octree.h"

#include "gpu/program.h"
#include "lightsim/lightsim.h"
#include "lightsim/shared.h"

#include <algorithm>
#include <vector>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;

/// Nodes per axis and the first node in the pyramid, by level. Level 0 stands for level 1 before it
/// is widened; the coarsest level is a single node.
std::vector<ivec4> layLevels(ivec3 size) {
    std::vector<ivec4> levels;
    int first = 0;
    const auto add = [&](ivec3 nodes) {
        levels.emplace_back(nodes, first);
        first += nodes.x * nodes.y * nodes.z;
    };
    ivec3 nodes = (size + 1) / 2;
    add(nodes);
    add(nodes);
    while (nodes != ivec3(1)) add(nodes = (nodes + 1) / 2);
    return levels;
}

/// σ_t of the channel that dims most [1/voxel], or nothing if it is the same in every voxel.
std::vector<float> extinctionPerVoxel(const Plan& plan) {
    if (!plan.attenuates || plan.scene.sharp) return {};
    std::vector<float> sigma(static_cast<size_t>(plan.voxels()));
    const auto h = static_cast<float>(plan.scene.voxelSize());
    const scene::Region& medium = plan.scene.medium();
    bool varies = false;
    for (size_t i = 0; i < sigma.size(); ++i) {
        for (int c = 0; c < plan.tracedChannels(); ++c)
            sigma[i] =
                std::max(sigma[i], (medium.absorption.at(i, c) + medium.scattering.at(i, c)) * h);
        varies |= sigma[i] != sigma[0];
    }
    return varies ? sigma : std::vector<float>();
}

} // namespace

gpu::Texture makeOctree(gpu::Device& device, const Plan& plan, const Params& params) {
    const std::vector<ivec4> levels = layLevels(plan.scene.size());
    const int top = static_cast<int>(levels.size()) - 1;
    gpu::Texture leaves(device, ivec3(levels[0]), gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    const std::vector<float> extinction = extinctionPerVoxel(plan);
    if (!plan.bends && extinction.empty()) {
        // Nothing varies: one leaf without a limit, as packLeaf() in shaders/lib/octree.glsl.
        const std::uint32_t endless = 30u | (16000000u << 5u);
        leaves.fill(&endless);
        return leaves;
    }
    const auto upload = [&](const std::vector<float>& values) {
        return gpu::Buffer(device, static_cast<std::int64_t>(values.size() * sizeof(float)),
                           values.data());
    };
    const gpu::Buffer index =
        upload(plan.bends ? plan.scene.index.grid.values : std::vector<float>());
    const gpu::Buffer dimming = upload(extinction);
    const gpu::Buffer pyramid(device, (std::int64_t{levels.back().w} + 1) * 16);
    const gpu::Buffer table(device, static_cast<std::int64_t>(levels.size() * sizeof(ivec4)),
                            levels.data());
    index.bindStorage(kIndexBuffer);
    pyramid.bindStorage(kPyramidBuffer);
    table.bindStorage(kLevelsBuffer);
    dimming.bindStorage(kExtinctionBuffer);

    OctreeParams values{};
    values.size = ivec4(plan.scene.size(), top);
    values.limits = vec4(params.octreeTolerance, params.octreeTolerance2, params.stepLimit, 0);
    const gpu::Program pass(device, "lightsim/pyramid.comp.glsl",
                            {{"INDEX", plan.bends}, {"EXTINCTION", !extinction.empty()}});
    gpu::Buffer block(device, sizeof values);
    block.bindUniform(kParamsBlock);
    for (int level = 0; level <= top; ++level) {
        values.nodes = ivec4(ivec3(levels[static_cast<size_t>(level)]), level);
        values.source = levels[static_cast<size_t>(std::max(level - 1, 0))];
        const int source = std::min(level, 2);
        values.target = ivec4(levels[static_cast<size_t>(level)].w, source, source == 1 ? 3 : 2, 0);
        block.upload(&values, sizeof values);
        pass.dispatch(ivec3(values.nodes));
        gpu::barrier();
    }
    const gpu::Program label(device, "lightsim/leaves.comp.glsl", {});
    values.nodes = levels[0];
    block.upload(&values, sizeof values);
    leaves.bindImage(kLeavesImage);
    label.dispatch(ivec3(levels[0]));
    gpu::barrier();
    device.check("the octree");
    return leaves;
}

OctreeDump dumpOctree(gpu::Device& device, const Plan& plan, const Params& params) {
    OctreeDump dump;
    dump.level.size = dump.stepLimit.size = plan.scene.size();
    const auto voxels = static_cast<size_t>(plan.voxels());
    dump.level.values.assign(voxels, 0);
    dump.stepLimit.values.assign(voxels, 1e6f);
    const gpu::Texture leaves = makeOctree(device, plan, params);
    const ivec3 pairs = leaves.size();
    std::vector<std::uint32_t> packed(static_cast<size_t>(pairs.x) * pairs.y * pairs.z);
    leaves.download(packed.data(), static_cast<std::int64_t>(packed.size() * 4));
    size_t i = 0;
    for (int z = 0; z < plan.scene.size().z; ++z)
        for (int y = 0; y < plan.scene.size().y; ++y)
            for (int x = 0; x < plan.scene.size().x; ++x, ++i) {
                const std::uint32_t leaf =
                    packed[(static_cast<size_t>(z / 2) * pairs.y + y / 2) * pairs.x + x / 2];
                dump.level.values[i] = static_cast<float>(leaf & 31u);
                dump.stepLimit.values[i] = (leaf & 31u) == 0
                                               ? static_cast<float>(params.stepMin)
                                               : static_cast<float>(leaf >> 5u) / 16.0f;
            }
    return dump;
}

} // namespace eikonal::lightsim
