// Voxels that receive light: fixed-point sums that become fluence and mean direction.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/voxels.h"

#include "scene/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using volume::kBrick;
using volume::kBrickVoxels;
static_assert(kBrick == kBrickEdge);

int totalsOf(const Plan& plan) {
    return plan.fluenceChannels() + plan.directionChannels();
}

bool isOpaque(const scene::Scene& scene, const ivec3& voxel) {
    if (!scene.sharp) return scene.medium().opacity.at(voxel, 0) > 0.5f;
    for (size_t k = 0; k < scene.objects.size(); ++k)
        if (scene.objects[k].distance.at(voxel) < 0) return scene.regions[k].opaque;
    return scene.medium().opaque;
}

/// Whether each voxel that receives is inside opaque material, as an atlas of one plane.
gpu::Texture makeOpaque(gpu::Device& device, const Plan& plan, const AtlasLayout& atlas) {
    const ReceivingBricks& receiving = plan.receiving;
    const ivec3 texels = atlas.texels(1), last = plan.scene.size() - 1;
    std::vector<std::uint8_t> opaque(scene::placeOf(texels, 0, 0, texels.z));
    tbb::parallel_for(size_t{0}, receiving.list.size(), [&](size_t slot) {
        const ivec3 low =
            receiving.first + kBrick * scene::atPlace(receiving.bricks, receiving.list[slot]);
        const ivec3 corner = scene::atPlace(atlas.bricks, slot) * kBrick;
        for (int i = 0; i < kBrickVoxels; ++i) {
            const ivec3 in(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick);
            const ivec3 at = corner + in;
            opaque[scene::placeOf(texels, at.x, at.y, at.z)] =
                isOpaque(plan.scene, glm::clamp(low + in, ivec3(0), last));
        }
    });
    gpu::Texture texture(device, texels, gpu::TexelFormat::r8ui, gpu::Filter::nearest);
    texture.upload(opaque.data());
    return texture;
}

} // namespace

AtlasLayout atlasOf(const Plan& plan) {
    const ReceivingBricks& receiving = plan.receiving;
    const int planes = std::max(plan.planes(), totalsOf(plan));
    const auto count = static_cast<std::int64_t>(receiving.list.size());
    AtlasLayout whole{receiving.bricks, false};
    const ivec3 texels = whole.texels(planes);
    const bool all = count == std::int64_t{whole.bricks.x} * whole.bricks.y * whole.bricks.z;
    if (all && std::max({texels.x, texels.y, texels.z}) <= scene::kMostTexels) return whole;
    return {scene::atlasOf(count, {kBrick, kBrick, kBrick * planes}), true};
}

double unitFor(double photons) {
    const double range = kNearFull;
    return std::exp2(std::min(24.0, std::floor(std::log2(range / (std::sqrt(3.0) * photons)))));
}

VoxelReceiver::VoxelReceiver(gpu::Device& device, const Plan& plan, const Params& params)
    : mResolve(device, "lightsim/resolve.comp.glsl",
               {{"CHANNELS", plan.tracedChannels()},
                {"FLUENCE", plan.fluenceChannels()},
                {"DIRECTION", plan.wants(Output::direction)}}),
      mBlock(device, sizeof(ResolveParams)), mAtlas(atlasOf(plan)),
      mVoxelSize(plan.scene.voxelSize()) {
    if (params.smoothing > 0)
        mSmooth = gpu::Program(device, "lightsim/smooth.comp.glsl",
                               {{"FLUENCE", plan.fluenceChannels()},
                                {"DIRECTION", plan.wants(Output::direction)},
                                {"OPAQUE", plan.opaque}});
    const ReceivingBricks& receiving = plan.receiving;
    const ivec3 atlas = mAtlas.bricks;
    mParams.size = ivec4(plan.scene.size(), static_cast<int>(receiving.list.size()));
    mParams.first = ivec4(-receiving.first, 0);
    mParams.bricks = ivec4(receiving.bricks, mAtlas.planesApart());
    mParams.atlas = ivec4(atlas, 0);
    mParams.apart =
        ivec4(mAtlas.apart(plan.planes()), mAtlas.apart(totalsOf(plan)), mAtlas.apart(1), 0);
    std::vector<std::uint32_t> table(scene::placeOf(receiving.bricks, 0, 0, receiving.bricks.z),
                                     kNoBrick);
    for (size_t slot = 0; slot < receiving.list.size(); ++slot) {
        const glm::uvec3 place(scene::atPlace(atlas, slot));
        table[receiving.list[slot]] = place.x | place.y << 10u | place.z << 20u;
    }
    const auto upload = [&](const std::vector<std::uint32_t>& values) {
        return gpu::Buffer(device, static_cast<std::int64_t>(values.size() * 4), values.data());
    };
    mTable = upload(table);
    mList = upload(receiving.list);
    mPlanes = gpu::Texture(device, mAtlas.texels(plan.planes()), gpu::TexelFormat::r32ui,
                           gpu::Filter::nearest);
    mTotals = gpu::Texture(device, mAtlas.texels(totalsOf(plan)), gpu::TexelFormat::r32f,
                           gpu::Filter::nearest);
    mTotals.clear();
    if (params.smoothing > 0 && plan.opaque) mOpaque = makeOpaque(device, plan, mAtlas);
    clearPlanes();
}

void VoxelReceiver::bind() const {
    mTable.bindStorage(kBricksBuffer);
    mPlanes.bindImage(kPlanesImage);
}

void VoxelReceiver::clearPlanes() {
    mPlanes.clear();
}

void VoxelReceiver::dispatch(const gpu::Program& program) const {
    // A device takes 65,535 groups along one dimension, maybe not more.
    const int bricks = mParams.size.w, row = std::min(bricks, 1 << 15);
    if (row > 0) program.dispatch({kBrickVoxels, row, (bricks + row - 1) / row});
    gpu::barrier();
}

void VoxelReceiver::resolve(gpu::Device& device, const Unit& of, double unit) {
    // Track-length estimate: power × path length / voxel volume. [1/m² per unit of fixed point]
    const double share = of.power / (mVoxelSize * mVoxelSize) / unit;
    mParams.fluence = vec4(share * of.rgb, 0);
    mParams.colour = vec4(of.colour, share * (of.rgb.x + of.rgb.y + of.rgb.z));
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    bind();
    mTotals.bindImage(kTotalsImage);
    dispatch(mResolve);
    device.check("resolve");
}

void VoxelReceiver::addPlain(gpu::Device& device, const Plan& plan, const glm::dvec3& rgb,
                             bool isPoint) {
    if (mPlain.empty())
        mPlain = gpu::Program(
            device, "lightsim/plain.comp.glsl",
            {{"FLUENCE", plan.fluenceChannels()}, {"DIRECTION", plan.wants(Output::direction)}});
    mParams.fluence = vec4(rgb / (isPoint ? mVoxelSize * mVoxelSize : 1.0), 0);
    mBlock.upload(&mParams, sizeof mParams);
    mBlock.bindUniform(kParamsBlock);
    mTable.bindStorage(kBricksBuffer);
    mList.bindStorage(kBrickListBuffer);
    mTotals.bindImage(kTotalsImage);
    dispatch(mPlain);
    device.check("light that meets nothing");
}

void VoxelReceiver::smooth(gpu::Device& device, int rounds) {
    mPlanes = gpu::Texture(); // its memory serves the other texture
    gpu::Texture other(device, mTotals.size(), gpu::TexelFormat::r32f, gpu::Filter::nearest);
    mTable.bindStorage(kBricksBuffer);
    mList.bindStorage(kBrickListBuffer);
    if (mOpaque.name() != 0) mOpaque.bindSampler(kOpaqueUnit);
    for (int pass = 0; pass < 3 * rounds; ++pass) {
        mParams.first.w = pass % 3;
        mBlock.upload(&mParams, sizeof mParams);
        mBlock.bindUniform(kParamsBlock);
        mTotals.bindImage(kTotalsImage);
        other.bindImage(kSmoothedImage);
        dispatch(mSmooth);
        std::swap(mTotals, other);
    }
    device.check("smooth");
}

Result VoxelReceiver::download(const Plan& plan) const {
    const ReceivingBricks& receiving = plan.receiving;
    const ivec3 texels = mTotals.size();
    std::vector<float> values(scene::placeOf(texels, 0, 0, texels.z));
    mTotals.download(values.data(), mTotals.bytes());
    const int channels = plan.fluenceChannels(), planes = totalsOf(plan);
    const glm::mat3 worldFromVoxel(plan.scene.worldFromVoxelTurn());
    const auto made = [&](Output output) {
        volume::BrickGrid grid;
        if (!plan.wants(output)) return grid;
        grid = volume::BrickGrid(plan.scene.size(), receiving.first, 0, 3);
        grid.values.resize(receiving.list.size() * kBrickVoxels * 3);
        for (size_t slot = 0; slot < receiving.list.size(); ++slot)
            grid.page[receiving.list[slot]] = static_cast<std::int32_t>(slot);
        return grid;
    };
    Result result{made(Output::fluence), made(Output::direction), {}, {}};
    tbb::parallel_for(size_t{0}, receiving.list.size(), [&](size_t slot) {
        const ivec3 apart(1, 1, mAtlas.apart(planes));
        const ivec3 corner = scene::atPlace(mAtlas.bricks, slot) * apart * kBrick;
        for (int i = 0; i < kBrickVoxels; ++i) {
            const ivec3 p = corner + ivec3(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick);
            const auto plane = [&](int k) {
                return values[scene::placeOf(texels, p.x, p.y, p.z + k * mAtlas.planesApart())];
            };
            glm::vec3 fluence(0);
            for (int c = 0; c < 3; ++c) fluence[c] = plane(std::min(c, channels - 1));
            const size_t out = 3 * (slot * kBrickVoxels + static_cast<size_t>(i));
            for (size_t c = 0; c < 3 && plan.wants(Output::fluence); ++c)
                result.fluence.values[out + c] = fluence[static_cast<int>(c)];
            const float power = fluence.x + fluence.y + fluence.z;
            if (!plan.wants(Output::direction) || !(power > 0)) continue;
            glm::vec3 mean(plane(channels), plane(channels + 1), plane(channels + 2));
            mean /= power;
            const float length = glm::length(mean);
            if (length > 1) mean /= length; // rounding of the fixed-point sums
            mean = worldFromVoxel * mean;
            for (size_t c = 0; c < 3; ++c)
                result.direction.values[out + c] = mean[static_cast<int>(c)];
        }
    });
    return result;
}

std::vector<gpu::Need> voxelNeeds(const Plan& plan, const Params& params) {
    const AtlasLayout atlas = atlasOf(plan);
    const auto bytes = [&](int planes) {
        const ivec3 texels = atlas.texels(planes);
        return std::int64_t{texels.x} * texels.y * texels.z * 4;
    };
    const auto edge = [&](int planes) {
        const ivec3 texels = atlas.texels(planes);
        return std::max({texels.x, texels.y, texels.z});
    };
    const ivec3 bricks = plan.receiving.bricks;
    const std::string of =
        " of " + std::to_string(plan.receiving.list.size()) + " bricks of 8 x 8 x 8";
    const std::int64_t planes = bytes(plan.planes()), totals = bytes(totalsOf(plan));
    return {{"the light" + of, planes, false, edge(plan.planes())},
            // Twice while it is smoothed, when the planes are gone.
            {"the summed light" + of,
             totals + (params.smoothing > 0 ? std::max<std::int64_t>(totals - planes, 0) : 0),
             false, edge(totalsOf(plan))},
            {"the table of bricks", std::int64_t{bricks.x} * bricks.y * bricks.z * 4, true, 0}};
}

} // namespace eikonal::lightsim
