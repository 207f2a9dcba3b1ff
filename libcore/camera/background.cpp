// What surrounds the scene: a colour or an environment map.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/background.h"

#include "base/error.h"
#include "base/text.h"
#include "image/halves.h"
#include "image/lat_long.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <numbers>

namespace eikonal::camera {

namespace {

/// Rows that are uploaded at a time, so that the host never holds the whole twice.
constexpr int kRows = 64;

/// `copy(plane, row, rows, out)` writes a channel to every fourth number from `out` on.
template<typename Number, typename Copy>
gpu::Texture uploaded(gpu::Device& device, const image::Image& map, gpu::TexelFormat format,
                      gpu::Filter filter, const Copy& copy) {
    gpu::Texture texture(device, {map.width, map.height, 0}, format, filter);
    std::vector<Number> rgba(static_cast<size_t>(map.width) * kRows * 4);
    for (int row = 0; row < map.height; row += kRows) {
        const int rows = std::min(kRows, map.height - row);
        for (size_t c = 0; c < 3; ++c) copy(c, row, rows, rgba.data() + c);
        texture.uploadRows(row, rows, rgba.data());
    }
    return texture;
}

} // namespace

void Background::check() const {
    requireOption(background.x >= 0 && background.y >= 0 && background.z >= 0, "--background",
                  "a radiance below 0", "0 or more");
    requireOption(std::isfinite(environmentTurn), "--env-rotate", toText(environmentTurn),
                  "a number of degrees");
}

gpu::Texture makeMap(gpu::Device& device, const std::optional<image::Image>& map,
                     gpu::Filter filter) {
    if (!map) return {};
    if (image::areHalves(*map))
        return uploaded<std::uint16_t>(device, *map, gpu::TexelFormat::rgba16f, filter,
                                       [&](size_t c, int row, int rows, std::uint16_t* out) {
                                           image::copyHalves(*map, c, row, rows, out, 4);
                                       });
    return uploaded<float>(device, *map, gpu::TexelFormat::rgba32f, filter,
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

glm::vec4 backgroundValues(const Background& background, const std::optional<image::Image>& map) {
    const bool byEdges = map && map->envmap == image::Envmap::latLong;
    return {background.background, !map ? 1 : byEdges ? 3 : 2};
}

glm::dmat3 mapFromFrame(const Background& background, const glm::dmat3& worldFromFrame) {
    return image::mapFromWorld(background.environmentTurn, background.environmentZUp) *
           worldFromFrame;
}

glm::dvec3 radianceFrom(const Background& background, const std::optional<image::Image>& map,
                        const glm::dvec3& direction) {
    if (!map) return background.background;
    const glm::dvec3 d = mapFromFrame(background, glm::dmat3(1)) * direction;
    const double longitude = std::atan2(d.x, d.z), latitude = std::atan2(d.y, std::hypot(d.x, d.z));
    return image::radianceAt(
        *map, {0.5 - longitude / (2 * std::numbers::pi), 0.5 - latitude / std::numbers::pi});
}

} // namespace eikonal::camera
