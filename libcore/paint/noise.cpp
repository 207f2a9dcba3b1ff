// Smooth noise over space, a function of place and seed alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint/noise.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace eikonal::paint {

namespace {

/// A well mixed number of the lattice point: every bit in changes about half of those out (the
/// finalizer of MurmurHash3, after a step for each coordinate).
std::uint32_t hashOf(const glm::ivec3& p, std::uint32_t seed) {
    std::uint32_t h = seed;
    for (int axis = 0; axis < 3; ++axis) {
        h ^= static_cast<std::uint32_t>(p[axis]) + 0x9e3779b9u + (h << 6) + (h >> 2);
        h ^= h >> 16;
        h *= 0x85ebca6bu;
        h ^= h >> 13;
        h *= 0xc2b2ae35u;
        h ^= h >> 16;
    }
    return h;
}

/// The share of a lattice point: its gradient, one of the directions from a cube's middle to those
/// of its edges, times the way from it.
double shareOf(const glm::ivec3& p, const glm::dvec3& away, std::uint32_t seed) {
    const std::uint32_t h = hashOf(p, seed) % 12;
    const double u = h & 1 ? -1 : 1, v = h & 2 ? -1 : 1;
    switch (h / 4) {
    case 0:
        return u * away.x + v * away.y;
    case 1:
        return u * away.y + v * away.z;
    default:
        return u * away.z + v * away.x;
    }
}

} // namespace

double gradientNoise(const glm::dvec3& x, std::uint32_t seed) {
    const glm::dvec3 low = glm::floor(x), t = x - low;
    const glm::ivec3 p(low);
    const glm::dvec3 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= d[axis] ? w[axis] : 1 - w[axis];
        sum += weight * shareOf(p + d, t - glm::dvec3(d), seed);
    }
    return glm::clamp(sum, -1.0, 1.0); // its peaks reach 1.04
}

double fractalNoise(const glm::dvec3& x, int octaves, std::uint32_t seed) {
    double sum = 0, heights = 0, height = 1, scale = 1;
    for (int k = 0; k < octaves; ++k, height /= 2, scale *= 2) {
        sum += height * gradientNoise(scale * x, seed + static_cast<std::uint32_t>(k));
        heights += height;
    }
    return sum / heights;
}

} // namespace eikonal::paint
