// Blurred media, as the photon kernel reads them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/media.h"

#include "lightsim/shared.h"
#include "scene/lattice.h"
#include "scene/voxel_textures.h"

#include <tbb/parallel_for.h>

namespace eikonal::lightsim {

namespace {

gpu::Texture makeAbsorption(gpu::Device& device, const Plan& plan) {
    const scene::Region& medium = plan.scene.medium();
    const auto h = static_cast<float>(plan.scene.voxelSize()); // 1/unit to 1/voxel
    if (!plan.colour)
        return scene::makeVoxelTexture(device, plan.scene.layout, gpu::TexelFormat::rg32f, true,
                                       [&](const glm::ivec3& i, float* out) {
                                           out[0] = medium.absorption.at(i, 0) * h;
                                           out[1] = medium.scattering.at(i, 0) * h;
                                       });
    return scene::makeVoxelTexture(device, plan.scene.layout, gpu::TexelFormat::rgba32f, true,
                                   [&](const glm::ivec3& i, float* out) {
                                       for (int c = 0; c < 3; ++c)
                                           out[c] = medium.absorption.at(i, c) * h;
                                   });
}

gpu::Texture makeScattering(gpu::Device& device, const Plan& plan) {
    const scene::Region& medium = plan.scene.medium();
    const auto h = static_cast<float>(plan.scene.voxelSize());
    return scene::makeVoxelTexture(device, plan.scene.layout, gpu::TexelFormat::rgba32f, true,
                                   [&](const glm::ivec3& i, float* out) {
                                       for (int c = 0; c < 3; ++c)
                                           out[c] = medium.scattering.at(i, c) * h;
                                   });
}

gpu::Texture makeOpaque(gpu::Device& device, const Plan& plan) {
    const scene::Values& opacity = plan.scene.medium().opacity;
    const glm::ivec3 size = plan.scene.size();
    std::vector<std::uint8_t> opaque(static_cast<size_t>(plan.voxels()));
    tbb::parallel_for(0, size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                opaque[scene::placeOf(size, x, y, z)] = opacity.at({x, y, z}, 0) > 0.5f;
    });
    gpu::Texture texture(device, plan.scene.size(), gpu::TexelFormat::r8ui, gpu::Filter::nearest);
    texture.upload(opaque.data());
    return texture;
}

gpu::Texture makeOpacity(gpu::Device& device, const Plan& plan) {
    const scene::Values& opacity = plan.scene.medium().opacity;
    if (plan.bounces == 0)
        return scene::makeVoxelTexture(
            device, plan.scene.layout, gpu::TexelFormat::r32f, true,
            [&](const glm::ivec3& i, float* out) { out[0] = opacity.at(i, 0); });
    const scene::Values& albedo = plan.scene.medium().albedo;
    return scene::makeVoxelTexture(device, plan.scene.layout, gpu::TexelFormat::rgba32f, true,
                                   [&](const glm::ivec3& i, float* out) {
                                       out[0] = opacity.at(i, 0);
                                       for (int c = 0; c < 3; ++c) out[1 + c] = albedo.at(i, c);
                                   });
}

} // namespace

Media::Media(gpu::Device& device, const Plan& plan) {
    if (plan.scene.sharp) return;
    if (plan.attenuates) absorption = makeAbsorption(device, plan);
    if (plan.attenuates && plan.colour) scattering = makeScattering(device, plan);
    if (plan.opaque && (plan.sendsPhotons() || plan.wavefront)) opaque = makeOpaque(device, plan);
    if (!plan.surfaces.empty()) opacity = makeOpacity(device, plan);
}

void Media::bind() const {
    if (absorption.name() != 0) absorption.bindSampler(kAbsorptionUnit);
    if (scattering.name() != 0) scattering.bindSampler(kScatteringUnit);
    if (opaque.name() != 0) opaque.bindSampler(kOpaqueUnit);
    if (opacity.name() != 0) opacity.bindSampler(kOpacityFieldUnit);
}

} // namespace eikonal::lightsim
