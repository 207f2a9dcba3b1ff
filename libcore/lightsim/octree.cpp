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

} // namespace

gpu::Texture makeOctree(gpu::Device& device, const volume::DenseGrid& index, const Params& params) {
    const std::vector<ivec4> levels = layLevels(index.size);
    const int top = static_cast<int>(levels.size()) - 1;
    const std::int64_t nodes = std::int64_t{levels.back().w} + 1;
    const gpu::Buffer source(device, static_cast<std::int64_t>(index.values.size() * sizeof(float)),
                             index.values.data());
    const gpu::Buffer pyramid(device, nodes * 8);
    const gpu::Buffer table(device, static_cast<std::int64_t>(levels.size() * sizeof(ivec4)),
                            levels.data());
    source.bindStorage(0);
    pyramid.bindStorage(1);
    table.bindStorage(2);

    OctreeParams values{};
    values.size = ivec4(index.size, top);
    values.limits = vec4(params.tolerance, params.secondTolerance, params.stepLimit, 0);
    const gpu::Program programs[3] = {{device, "lightsim/pyramid.comp.glsl", {{"SOURCE", 0}}},
                                      {device, "lightsim/pyramid.comp.glsl", {{"SOURCE", 1}}},
                                      {device, "lightsim/pyramid.comp.glsl", {{"SOURCE", 2}}}};
    gpu::Buffer block(device, sizeof values);
    block.bindUniform(0);
    for (int level = 0; level <= top; ++level) {
        values.nodes = ivec4(ivec3(levels[static_cast<size_t>(level)]), level);
        values.source = levels[static_cast<size_t>(std::max(level - 1, 0))];
        values.target.x = levels[static_cast<size_t>(level)].w;
        block.upload(&values, sizeof values);
        programs[std::min(level, 2)].dispatch(ivec3(values.nodes));
        gpu::barrier();
    }
    gpu::Texture leaves(device, ivec3(levels[0]), gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    const gpu::Program label(device, "lightsim/leaves.comp.glsl", {});
    values.nodes = levels[0];
    block.upload(&values, sizeof values);
    leaves.bindImage(0);
    label.dispatch(ivec3(levels[0]));
    gpu::barrier();
    device.check("the octree");
    return leaves;
}

OctreeDump dumpOctree(gpu::Device& device, const Plan& plan, const Params& params) {
    OctreeDump dump;
    dump.level.size = dump.stepLimit.size = plan.size;
    const auto voxels = static_cast<size_t>(plan.voxels());
    dump.level.values.assign(voxels, 0);
    dump.stepLimit.values.assign(voxels, 1e6f);
    volume::DenseGrid index = plan.index.grid;
    if (index.values.empty()) {
        index.size = plan.size;
        index.values.assign(voxels, plan.index.background);
    }
    const gpu::Texture leaves = makeOctree(device, index, params);
    const ivec3 pairs = leaves.size();
    std::vector<std::uint32_t> packed(static_cast<size_t>(pairs.x) * pairs.y * pairs.z);
    leaves.download(packed.data(), static_cast<std::int64_t>(packed.size() * 4));
    size_t i = 0;
    for (int z = 0; z < plan.size.z; ++z)
        for (int y = 0; y < plan.size.y; ++y)
            for (int x = 0; x < plan.size.x; ++x, ++i) {
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
