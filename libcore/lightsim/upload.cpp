// The medium and the domain's faces, as the photon kernels read them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/upload.h"

namespace eikonal::lightsim {

gpu::Texture makeAbsorption(gpu::Device& device, const Plan& plan) {
    const auto h = static_cast<float>(plan.voxelSize); // 1/unit to 1/voxel
    if (!plan.colour)
        return medium::makePadded(device, plan.size, gpu::TexelFormat::rg32f, true,
                                  [&](size_t i, float* out) {
                                      out[0] = plan.absorption.at(i, 0) * h;
                                      out[1] = plan.scattering.at(i, 0) * h;
                                  });
    return medium::makePadded(device, plan.size, gpu::TexelFormat::rgba32f, true,
                              [&](size_t i, float* out) {
                                  for (int c = 0; c < 3; ++c) out[c] = plan.absorption.at(i, c) * h;
                              });
}

gpu::Texture makeScattering(gpu::Device& device, const Plan& plan) {
    const auto h = static_cast<float>(plan.voxelSize);
    return medium::makePadded(device, plan.size, gpu::TexelFormat::rgba32f, true,
                              [&](size_t i, float* out) {
                                  for (int c = 0; c < 3; ++c) out[c] = plan.scattering.at(i, c) * h;
                              });
}

gpu::Texture makeOpaque(gpu::Device& device, const Plan& plan) {
    const auto& opacity = plan.opacity.grid.values;
    std::vector<std::uint8_t> solid(opacity.size());
    for (size_t i = 0; i < solid.size(); ++i) solid[i] = opacity[i] > 0.5f;
    gpu::Texture texture(device, plan.size, gpu::TexelFormat::r8ui, gpu::Filter::nearest);
    texture.upload(solid.data());
    return texture;
}

std::vector<glm::vec4> triangles(const VoxelBox& box) {
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

} // namespace eikonal::lightsim
