// Pictures of floors under a ball of glass and under waves, with the exact light on them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/floor_view.h"

#include "judge/snell.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace judge {

namespace {

/// What a ray brings to the eye, and what it meets first.
struct Found {
    double radiance = 0;
    Meets meets = Meets::other;
};

/// The mean of many rays in every pixel; `follow` takes a ray to what it finds.
template<typename Follow> Picture take(const View& view, const Follow& follow) {
    const dvec3 forward = glm::normalize(view.target - view.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
    const dvec3 up = glm::cross(right, forward);
    const double pixel = 2 * std::tan(glm::radians(view.fov) / 2) / view.rows;
    const auto area = static_cast<size_t>(view.width) * static_cast<size_t>(view.rows);
    Picture picture{std::vector<double>(area), std::vector<Meets>(area)};
    const auto takePixel = [&](int x, int y) {
        const size_t i =
            static_cast<size_t>(y) * static_cast<size_t>(view.width) + static_cast<size_t>(x);
        for (int k = 0; k < view.strata * view.strata; ++k) {
            const double u = x + (k % view.strata + 0.5) / view.strata;
            const double v = y + (k / view.strata + 0.5) / view.strata;
            const dvec3 off =
                pixel * (u - 0.5 * view.width) * right + pixel * (0.5 * view.rows - v) * up;
            const Found found = follow(Ray{view.eye, glm::normalize(forward + off)});
            picture.radiance[i] += found.radiance / (view.strata * view.strata);
            if (k == 0) picture.met[i] = found.meets;
            if (picture.met[i] != found.meets) picture.met[i] = Meets::other;
        }
    };
    const int parts = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::vector<std::thread> threads;
    for (int part = 0; part < parts; ++part)
        threads.emplace_back([&, part] {
            for (int y = part; y < view.rows; y += parts)
                for (int x = 0; x < view.width; ++x) takePixel(x, y);
        });
    for (std::thread& thread : threads) thread.join();
    return picture;
}

/// The floor with its light, by maps of which the first that holds a place counts.
class LitFloor {
public:
    LitFloor(const Floor& floor, double height, std::vector<Texels> maps)
        : mFloor(floor), mHeight(height), mMaps(std::move(maps)) {}

    /// Whether a ray from above comes to it, and its radiance there.
    Found seenBy(const dvec3& x, const dvec3& d) const {
        if (d.y >= 0) return {};
        const dvec3 end = x + (mHeight - x.y) / d.y * d;
        if (std::max(std::abs(end.x), std::abs(end.z)) > mFloor.extent) return {};
        for (const Texels& map : mMaps)
            if (map.holds({end.x, end.z}))
                return {mFloor.albedo / std::numbers::pi * map.at({end.x, end.z}), Meets::floor};
        return {};
    }

private:
    Floor mFloor;
    double mHeight;
    std::vector<Texels> mMaps;
};

// ---- the ball

/// What comes to the eye along a ray that meets the ball at x.
double throughBall(const BallOverPlane& scene, const LitFloor& floor, dvec3 x, const dvec3& d) {
    const double n = scene.index, r = scene.radius;
    const dvec3 normal = x / r;
    const double outside = -glm::dot(d, normal);
    const double inside = std::sqrt(1 - (1 - outside * outside) / (n * n));
    const double mirrored = reflectance(n, outside).mean();
    double radiance = mirrored * floor.seenBy(x, d + 2 * outside * normal).radiance;
    dvec3 w = d / n + (outside / n - inside) * normal;
    double share = (1 - mirrored) * (1 - mirrored); // n² in, n² out
    for (int order = 1; order <= 10; ++order) {
        x += 2 * r * inside * w;
        const dvec3 out = x / r;
        radiance += share * floor.seenBy(x, n * w + (outside - n * inside) * out).radiance;
        share *= mirrored;
        w -= 2 * glm::dot(w, out) * out;
    }
    return radiance;
}

// ---- the water

/// Where a ray from above the waves or from a wave upwards meets them next; t < 0: nowhere.
double nextWave(const Water& water, double high, const dvec3& x, const dvec3& d) {
    const auto above = [&](double t) {
        const dvec3 p = x + t * d;
        return p.y - water.height({p.x, p.z});
    };
    // Steps that are short beside every wave, from where the waves may begin.
    constexpr double kStep = 0.02, kClear = 1e-6, kFar = 100;
    const double start = d.y < 0 ? std::max((high - x.y) / d.y, kClear) : kClear;
    double from = start;
    double before = above(from);
    while (true) {
        const double to = from + kStep, after = above(to);
        if (before > 0 && after <= 0) {
            double t = from + kStep * before / (before - after);
            for (int i = 0; i < 4; ++i) { // Newton's method, from so near that it doubles digits
                const dvec3 p = x + t * d;
                const dvec2 slope = water.slope({p.x, p.z});
                t -= above(t) / (d.y - slope.x * d.x - slope.y * d.z);
            }
            return t;
        }
        if (d.y >= 0 && x.y + to * d.y > high) return -1;
        if (to - start > kFar) return -1; // a level ray above all waves
        from = to, before = after;
    }
}

Found overWater(const Water& water, const LitFloor& floor, double high, const dvec3& x,
                const dvec3& d, int depth) {
    const double t = nextWave(water, high, x, d);
    if (t < 0 || meetsBox(water, x, d, t)) return {};
    const dvec3 at = x + t * d, normal = water.normal({at.x, at.z});
    const double n = water.index, outside = -glm::dot(d, normal);
    const double inside = std::sqrt(1 - (1 - outside * outside) / (n * n));
    const double mirrored = reflectance(n, outside).mean();
    double radiance = (1 - mirrored) / (n * n) *
                      floor.seenBy(at, d / n + (outside / n - inside) * normal).radiance;
    if (depth < 3)
        radiance += mirrored *
                    overWater(water, floor, high, at, d + 2 * outside * normal, depth + 1).radiance;
    return {radiance, Meets::through};
}

} // namespace

Picture pictureOf(const BallOverPlane& scene, const Floor& floor, const View& view) {
    // Round the shadow, which is all that is not smooth.
    const dvec3 d = glm::normalize(scene.direction);
    const dvec3 middle = scene.height / d.y * d;
    const double round = 1.3 * scene.radius;
    std::vector<Texels> maps;
    maps.emplace_back(dvec2(middle.x, middle.z) - round, dvec2(middle.x, middle.z) + round,
                      floor.fine);
    maps.emplace_back(dvec2(-floor.extent), dvec2(floor.extent), floor.fine / 4);
    for (Texels& map : maps) irradianceUnder(scene, map);
    const LitFloor lit(floor, scene.height, std::move(maps));
    return take(view, [&](const Ray& ray) -> Found {
        const double along = -glm::dot(ray.x, ray.direction);
        const dvec3 nearest = ray.x + along * ray.direction;
        const double square = scene.radius * scene.radius - glm::dot(nearest, nearest);
        if (square <= 0) return lit.seenBy(ray.x, ray.direction);
        const dvec3 x = nearest - std::sqrt(square) * ray.direction;
        return {throughBall(scene, lit, x, ray.direction), Meets::through};
    });
}

Picture pictureOf(const Water& water, const Floor& floor, const View& view) {
    std::vector<Texels> maps;
    maps.emplace_back(dvec2(-floor.extent), dvec2(floor.extent), floor.fine);
    irradianceUnder(water, maps[0]);
    const LitFloor lit(floor, water.floor, std::move(maps));
    double high = 0;
    for (const Wave& wave : water.waves) high += std::abs(wave.amplitude);
    return take(
        view, [&](const Ray& ray) { return overWater(water, lit, high, ray.x, ray.direction, 0); });
}

} // namespace judge
