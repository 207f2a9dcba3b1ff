// What surrounds the scene: a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/background.h"

#include "image/halves.h"
#include "image/lat_long.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

namespace {

/// Rows that are uploaded at a time, so that the host never holds the whole twice.
constexpr int kRows = 64;

/// `copy(plane, row, rows, out)` writes a channel to every fourth number from `out` on.
template<typename Number, typename Copy>
gpu::Texture uploaded(gpu::Device& device, const image::Image& map, gpu::TexelFormat format,
                      const Copy& copy) {
    gpu::Texture texture(device, {map.width, map.height, 0}, format, gpu::Filter::nearest);
    std::vector<Number> rgba(static_cast<size_t>(map.width) * kRows * 4);
    for (int row = 0; row < map.height; row += kRows) {
        const int rows = std::min(kRows, map.height - row);
        for (size_t c = 0; c < 3; ++c) copy(c, row, rows, rgba.data() + c);
        texture.uploadRows(row, rows, rgba.data());
    }
    return texture;
}

} // namespace

gpu::Texture makeMap(gpu::Device& device, const std::optional<image::Image>& map) {
    if (!map) return {};
    if (image::areHalves(*map))
        return uploaded<std::uint16_t>(device, *map, gpu::TexelFormat::rgba16f,
                                       [&](size_t c, int row, int rows, std::uint16_t* out) {
                                           image::copyHalves(*map, c, row, rows, out, 4);
                                       });
    return uploaded<float>(device, *map, gpu::TexelFormat::rgba32f,
                           [&](size_t c, int row, int rows, float* out) {
                               const auto width = static_cast<size_t>(map->width);
                               const auto first = static_cast<size_t>(row) * width;
                               for (size_t i = 0; i < static_cast<size_t>(rows) * width; ++i)
                                   out[4 * i] = map->plane(c)[first + i];
                           });
}

gpu::Need mapNeed(const image::Image& map) {
    const std::int64_t texels = std::int64_t{map.width} * map.height;
    return {"the environment map", texels * 16, false, 0, std::max(map.width, map.height)};
}

void tellBackground(ViewParams& values, const scene::Scene& scene, const Params& params,
                    const std::optional<image::Image>& map) {
    const bool byEdges = map && map->envmap == image::Envmap::latLong;
    values.background = vec4(params.background, !map ? 1 : byEdges ? 3 : 2);
    const glm::dmat3 mapFromWorld =
        image::mapFromWorld(params.environmentTurn, params.environmentZUp);
    const glm::dmat3 rows = glm::transpose(mapFromWorld * scene.worldFromVoxelTurn());
    values.mapFromVoxel0 = vec4(rows[0], 0);
    values.mapFromVoxel1 = vec4(rows[1], 0);
    values.mapFromVoxel2 = vec4(rows[2], 0);
}

} // namespace eikonal::view
