// What surrounds the scene: a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/background.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

gpu::Texture makeMap(gpu::Device& device, const std::optional<image::Image>& map) {
    if (!map) return {};
    std::vector<float> rgba(map->area() * 4);
    for (size_t c = 0; c < 3; ++c) {
        const auto plane = map->plane(c);
        for (size_t i = 0; i < plane.size(); ++i) rgba[4 * i + c] = plane[i];
    }
    gpu::Texture texture(device, {map->width, map->height, 0}, gpu::TexelFormat::rgba32f,
                         gpu::Filter::nearest);
    texture.upload(rgba.data());
    return texture;
}

void tellBackground(ViewParams& values, const scene::Scene& scene, const Params& params,
                    const std::optional<image::Image>& map) {
    const bool byEdges = map && map->envmap == image::Envmap::latLong;
    values.background = vec4(params.background, !map ? 1 : byEdges ? 3 : 2);
    const double angle = glm::radians(params.environmentTurn);
    // A turn by +90° brings what the map shows at +X to +Z, as turning the map to the right does.
    glm::dmat3 mapFromWorld(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0,
                            std::cos(angle));
    // A Z-up map's pole +Z is the map's +Y; its +X stays.
    if (params.environmentZUp) mapFromWorld = mapFromWorld * glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);
    const glm::dmat3 rows = glm::transpose(mapFromWorld * scene.worldFromVoxelTurn());
    values.mapFromVoxel0 = vec4(rows[0], 0);
    values.mapFromVoxel1 = vec4(rows[1], 0);
    values.mapFromVoxel2 = vec4(rows[2], 0);
}

} // namespace eikonal::view
