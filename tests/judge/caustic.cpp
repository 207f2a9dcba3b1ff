// Light that a ball of glass throws on a plane, by exact rays of every order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/caustic.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <random>
#include <thread>

namespace judge {

namespace {

/// Adds a ray's share to the texel of the plane that it comes to.
void land(const BallOverPlane& scene, std::vector<double>& texels, const dvec3& x, const dvec3& d,
          double share) {
    if (d.y >= 0 || x.y <= scene.height) return;
    const dvec3 at = x + (scene.height - x.y) / d.y * d;
    const double scale = scene.texels / (2 * scene.extent);
    const double i = std::floor((at.x + scene.extent) * scale);
    const double j = std::floor((at.z + scene.extent) * scale);
    if (i < 0 || j < 0 || i >= scene.texels || j >= scene.texels) return;
    texels[static_cast<size_t>(j) * static_cast<size_t>(scene.texels) + static_cast<size_t>(i)] +=
        share;
}

/// Fresnel's reflectance at the ball, the same from both sides at angles that belong together.
double reflectanceAt(double cosOutside, double cosInside, double n) {
    const double s = (cosOutside - n * cosInside) / (cosOutside + n * cosInside);
    const double p = (n * cosOutside - cosInside) / (n * cosOutside + cosInside);
    return 0.5 * (s * s + p * p);
}

} // namespace

std::vector<double> irradianceUnder(const BallOverPlane& scene, int strata) {
    const size_t count = static_cast<size_t>(scene.texels) * static_cast<size_t>(scene.texels);
    const dvec3 d = glm::normalize(scene.direction);
    const dvec3 u = glm::normalize(glm::cross(d, dvec3(1, 0, 0))), v = glm::cross(u, d);
    // All light that comes to the texels, or that the ball may send there.
    const double reach = 1.5 * scene.extent + std::abs(scene.height) + scene.radius;
    const double cell = 2 * reach / strata, n = scene.index, r = scene.radius;
    const auto addRow = [&](int j, std::vector<double>& texels) {
        std::mt19937_64 random(static_cast<std::uint64_t>(j));
        std::uniform_real_distribution<double> uniform;
        for (int i = 0; i < strata; ++i) {
            const double a = (i + uniform(random)) * cell - reach;
            const double b = (j + uniform(random)) * cell - reach;
            const dvec3 from = a * u + b * v - 4 * reach * d;
            const double square = a * a + b * b;
            double share = cell * cell;
            if (square >= r * r) {
                land(scene, texels, from, d, share);
                continue;
            }
            dvec3 x = a * u + b * v - std::sqrt(r * r - square) * d;
            const dvec3 normal = x / r;
            const double outside = -glm::dot(d, normal);
            const double inside = std::sqrt(1 - (1 - outside * outside) / (n * n));
            const double mirrored = reflectanceAt(outside, inside, n);
            land(scene, texels, x, d + 2 * outside * normal, share * mirrored);
            dvec3 w = d / n + (outside / n - inside) * normal;
            share *= 1 - mirrored;
            while (share > 1e-6 * cell * cell) {
                x += 2 * r * inside * w;
                const dvec3 out = x / r;
                land(scene, texels, x, n * w + (outside - n * inside) * out,
                     share * (1 - mirrored));
                share *= mirrored;
                w -= 2 * glm::dot(w, out) * out;
            }
        }
    };
    // By so many parts, whatever threads there are, so that sums are the same.
    constexpr int kParts = 8;
    std::array<std::vector<double>, kParts> parts;
    std::array<std::thread, kParts> threads;
    for (size_t part = 0; part < kParts; ++part)
        threads[part] = std::thread([&, part] {
            parts[part].resize(count);
            for (int j = static_cast<int>(part); j < strata; j += kParts) addRow(j, parts[part]);
        });
    std::vector<double> texels(count);
    for (size_t part = 0; part < kParts; ++part) {
        threads[part].join();
        for (size_t i = 0; i < count; ++i) texels[i] += parts[part][i];
    }
    const double texel = 2 * scene.extent / scene.texels;
    for (double& value : texels) value /= texel * texel;
    return texels;
}

} // namespace judge
