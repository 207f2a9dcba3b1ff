// Light that a ball of glass throws on a plane, by exact rays of every order.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/caustic.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
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

/// Where the light of one order lands; order −1 is what would go straight on.
class Orders {
public:
    Orders(const BallOverPlane& scene, int order)
        : mScene(scene), mOrder(order), mAlong(glm::normalize(scene.direction)),
          mU(glm::normalize(glm::cross(mAlong, dvec3(1, 0, 0)))), mV(glm::cross(mU, mAlong)) {}

    /// By the angle of incidence and the angle round the axis.
    Landing operator()(const dvec2& angles) const {
        const double r = mScene.radius, n = mScene.index;
        const double outside = std::cos(angles.x), sine = std::sin(angles.x);
        const dvec3 aside = std::cos(angles.y) * mU + std::sin(angles.y) * mV;
        const dvec3 normal = sine * aside - outside * mAlong;
        const double light = r * r * sine * outside;
        if (mOrder < 0) return landing(r * normal, mAlong, light);
        const double inside = std::sqrt(1 - sine * sine / (n * n));
        const double mirrored = reflectanceAt(outside, inside, n);
        if (mOrder == 0)
            return landing(r * normal, mAlong + 2 * outside * normal, light * mirrored);
        dvec3 x = r * normal, w = mAlong / n + (outside / n - inside) * normal;
        double share = (1 - mirrored) * (1 - mirrored);
        for (int k = 1;; ++k) {
            x += 2 * r * inside * w;
            const dvec3 out = x / r;
            if (k == mOrder) return landing(x, n * w + (outside - n * inside) * out, light * share);
            share *= mirrored;
            w -= 2 * glm::dot(w, out) * out;
        }
    }

private:
    Landing landing(const dvec3& x, const dvec3& d, double density) const {
        // Rays nearly level come down far beyond any texel.
        if (d.y >= -1e-3 || x.y <= mScene.height) return {};
        const dvec3 at = x + (mScene.height - x.y) / d.y * d;
        return {{at.x, at.z}, density, true};
    }

    const BallOverPlane& mScene;
    int mOrder;
    dvec3 mAlong, mU, mV;
};

} // namespace

void irradianceUnder(const BallOverPlane& scene, Texels& texels, double bend) {
    constexpr int kOrders = 9;
    const double area = texels.edge * texels.edge;
    Patching how;
    how.cells = {128, 256};
    how.bend = bend;
    const dvec2 low(0), high(0.5 * std::numbers::pi, 2 * std::numbers::pi);
    texels.values.assign(texels.values.size(), 0);
    layPatches(texels, low, high, how, Orders(scene, -1));
    const double open = -glm::normalize(scene.direction).y * area;
    for (double& power : texels.values) power = open - power;
    for (int order = 0; order <= kOrders; ++order)
        layPatches(texels, low, high, how, Orders(scene, order));
    for (double& power : texels.values) power /= area;
}

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
