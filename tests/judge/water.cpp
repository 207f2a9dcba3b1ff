// Light on a floor under waves, with a box above them: exact, by the map from surface to floor.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/water.h"

#include "judge/snell.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace judge {

namespace {

double mostSlope(const Water& water) {
    double most = 0;
    for (const Wave& wave : water.waves) most += std::abs(wave.amplitude) * glm::length(wave.k);
    return most;
}

double mostHeight(const Water& water) {
    double most = 0;
    for (const Wave& wave : water.waves) most += std::abs(wave.amplitude);
    return most;
}

/// The greatest tilt of a refracted ray from the vertical [rad].
double mostTilt(const Water& water) {
    const dvec3 d = glm::normalize(water.direction);
    const double sun = std::acos(-d.y), wave = std::atan(mostSlope(water));
    // The angle that a ray turns by grows with its incidence.
    const double incidence = sun + wave;
    return sun + incidence - std::asin(std::sin(incidence) / water.index);
}

void requireOneWay(const Water& water) {
    const dvec3 d = glm::normalize(water.direction);
    const double sun = std::acos(-d.y), wave = std::atan(mostSlope(water));
    const double right = std::acos(0.0);
    if (sun + wave >= right) throw std::invalid_argument("a wave may stand in another one's light");
    if (sun + 2 * wave >= right - wave)
        throw std::invalid_argument("light may be reflected from wave to wave");
    if (mostTilt(water) >= right - wave)
        throw std::invalid_argument("refracted light may come to the surface again");
    if (water.floor >= -mostHeight(water))
        throw std::invalid_argument("the floor is not below the waves");
}

/// A ray as Snell's law has it in the water, and the share of its power that gets there.
struct Refracted {
    dvec3 direction;
    double transmitted, cosine; ///< cosine: of its incidence
};
Refracted refract(const Water& water, const dvec3& d, const dvec3& normal) {
    const double outside = -glm::dot(d, normal);
    const double inside = std::sqrt(1 - (1 - outside * outside) / (water.index * water.index));
    return {d / water.index + (outside / water.index - inside) * normal,
            1 - reflectance(water.index, outside).mean(), outside};
}

} // namespace

double Water::height(const dvec2& at) const {
    double sum = 0;
    for (const Wave& wave : waves)
        sum += wave.amplitude * std::sin(glm::dot(wave.k, at) + wave.phase);
    return sum;
}

dvec2 Water::slope(const dvec2& at) const {
    dvec2 sum(0);
    for (const Wave& wave : waves)
        sum += wave.amplitude * std::cos(glm::dot(wave.k, at) + wave.phase) * wave.k;
    return sum;
}

dvec3 Water::normal(const dvec2& at) const {
    const dvec2 s = slope(at);
    return glm::normalize(dvec3(-s.x, 1, -s.y));
}

bool meetsBox(const Water& water, const dvec3& x, const dvec3& d, double end) {
    if (water.boxLow == water.boxHigh) return false;
    double enter = 0, leave = end;
    for (int k = 0; k < 3; ++k) {
        if (d[k] == 0) {
            if (x[k] < water.boxLow[k] || x[k] > water.boxHigh[k]) return false;
            continue;
        }
        const double a = (water.boxLow[k] - x[k]) / d[k], b = (water.boxHigh[k] - x[k]) / d[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

double irradianceUnderFlat(const Water& water) {
    const dvec3 d = glm::normalize(water.direction);
    return -d.y * (1 - reflectance(water.index, -d.y).mean());
}

void irradianceUnder(const Water& water, Texels& texels, Weighing weighing, double bend) {
    requireOneWay(water);
    const dvec3 d = glm::normalize(water.direction);
    const double flat = -refract(water, d, {0, 1, 0}).direction.y;
    // Coordinates are the places on the surface.
    const auto map = [&](const dvec2& at) {
        const dvec3 x(at.x, water.height(at), at.y);
        Landing landing;
        if (meetsBox(water, x, -d, 1e300)) return landing;
        const dvec2 slope = water.slope(at);
        const dvec3 up(-slope.x, 1, -slope.y);
        const Refracted ray = refract(water, d, glm::normalize(up));
        const dvec3 end = x + (water.floor - x.y) / ray.direction.y * ray.direction;
        landing.lands = true;
        landing.at = {end.x, end.z};
        landing.density = -glm::dot(d, up) * ray.transmitted;
        if (weighing == Weighing::flatCosine) landing.density *= flat / -ray.direction.y;
        return landing;
    };
    const double reach =
        (mostHeight(water) - water.floor) * std::tan(mostTilt(water)) + texels.edge;
    const dvec2 low = texels.low - reach,
                high = texels.low + texels.edge * dvec2(texels.size) + reach;
    Patching how;
    how.cells = glm::ivec2(glm::ceil((high - low) / texels.edge));
    how.bend = bend;
    how.mostSplits = 6;
    texels.values.assign(texels.values.size(), 0);
    layPatches(texels, low, high, how, map);
    for (double& value : texels.values) value /= texels.edge * texels.edge;
}

} // namespace judge
