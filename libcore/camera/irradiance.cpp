// How what surrounds the scene lights a matt surface.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/irradiance.h"

#include "image/lat_long.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace eikonal::camera {

namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

std::array<double, 9> harmonicsAt(const dvec3& d) {
    return {1,
            d.y,
            d.z,
            d.x,
            d.x * d.y,
            d.y * d.z,
            3 * d.z * d.z - 1.0,
            d.x * d.z,
            d.x * d.x - d.y * d.y};
}

/// For each of them the square of what makes its mean square over the sphere 1/(4π), times what the
/// cosine's lobe keeps of its degree: π, 2π/3, π/4 (Ramamoorthi and Hanrahan 2001, eqs 3, 8).
constexpr std::array<double, 9> kKept = {kPi / (4 * kPi),
                                         2 * kPi / 3 * 3 / (4 * kPi),
                                         2 * kPi / 3 * 3 / (4 * kPi),
                                         2 * kPi / 3 * 3 / (4 * kPi),
                                         kPi / 4 * 15 / (4 * kPi),
                                         kPi / 4 * 15 / (4 * kPi),
                                         kPi / 4 * 5 / (16 * kPi),
                                         kPi / 4 * 15 / (4 * kPi),
                                         kPi / 4 * 15 / (16 * kPi)};

} // namespace

Irradiance irradianceFrom(const Background& background, const std::optional<image::Image>& map) {
    Irradiance factors{};
    if (!map) {
        factors[0] = kPi * background.background;
        return factors;
    }
    // Over cells of a lat-long grid as fine as the map.
    const glm::dmat3 worldFromMap = glm::transpose(mapFromFrame(background, glm::dmat3(1)));
    for (int row = 0; row < map->height; ++row) {
        const double upper = std::cos(kPi * row / map->height),
                     lower = std::cos(kPi * (row + 1) / map->height);
        const double cell = (upper - lower) * 2 * kPi / map->width; // solid angle [sr]
        for (int column = 0; column < map->width; ++column) {
            const glm::dvec2 place((column + 0.5) / map->width, (row + 0.5) / map->height);
            const dvec3 light = cell * image::radianceAt(*map, place);
            const auto harmonics = harmonicsAt(worldFromMap * image::directionOf(place));
            for (size_t i = 0; i < factors.size(); ++i)
                factors[i] += kKept[i] * harmonics[i] * light;
        }
    }
    return factors;
}

dvec3 irradianceOn(const Irradiance& irradiance, const dvec3& normal) {
    const auto harmonics = harmonicsAt(normal);
    dvec3 sum(0);
    for (size_t i = 0; i < irradiance.size(); ++i) sum += harmonics[i] * irradiance[i];
    return glm::max(sum, dvec3(0));
}

} // namespace eikonal::camera
