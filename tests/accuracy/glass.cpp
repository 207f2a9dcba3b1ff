// Sharp boundaries against the judge at 64³, one number a bar: directions, Fresnel's shares, what a
// tree of reflections loses.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball.h"
#include "support/glass_volume.h"

#include <array>
#include <cmath>
#include <limits>

namespace accuracy {

using namespace eikonal;

namespace {

// Lengths are in voxels, of 64³.
const dvec3 kCentre(31.63, 32.21, 31.87); // on no lattice point, and at no one's half
constexpr double kRadius = 26.3;
const dvec3 kViews[] = {{0, 0, -1}, {1, 0.37, -0.21}, {-0.4, -1, 0.7}};

scene::Files sceneOf(const judge::Glass& glass) {
    return sceneWith(sharp::volumeOf(glass, {.halfWidth = 6})); // mesh2vol's band
}

struct Kind {
    const char* name;
    double inside, around;
    judge::Glass glass() const { return {{judge::glassBall(kCentre, kRadius, inside)}, around}; }
    double ratio() const { return inside / around; }
    /// Where refraction turns into total reflection the deflection has an infinite slope.
    bool critical(double impact) const { return ratio() < 1 && std::abs(impact - ratio()) < 0.005; }
};
constexpr Kind kKinds[] = {{"glass", 1.5, 1}, {"bubble", 1, 1.5}, {"diamond", 2.42, 1}};

double impactOf(const judge::Ray& ray) {
    return sharp::impactOf(ray, kCentre, kRadius);
}

/// The largest angle [degree] of rays whose impact `counts`, from where the judge's leave.
double worstDegrees(Bench& bench, const Stage& stage, const judge::Glass& glass, int pixels,
                    const std::function<bool(double)>& counts) {
    double worst = 0;
    for (const dvec3& direction : kViews) {
        const view::Camera camera =
            sharp::along(direction, kCentre, 2 * kRadius, {pixels, pixels}).camera;
        const Ends ends = stage.ends(bench, camera, usual());
        const std::vector<judge::Ray> rays = raysOf(camera);
        for (size_t i = 0; i < rays.size(); ++i) {
            if (!counts(impactOf(rays[i]))) continue;
            const judge::Exit wanted = judge::exitOf(glass, rays[i], dvec3(0), dvec3(64));
            worst = std::max(worst, sharp::degreesBetween(ends.direction[i], wanted.direction));
        }
    }
    return worst;
}

Json measureBall(Bench& bench, const Kind& kind) {
    const judge::Glass glass = kind.glass();
    const Stage stage(sceneOf(glass));
    const auto worst = [&](double from, double to) {
        return worstDegrees(bench, stage, glass, 61, [&](double impact) {
            return impact > from && impact <= to && !kind.critical(impact);
        });
    };
    return {{"to_95", worst(0, 0.95)}, {"to_99", worst(0.95, 0.99)}};
}

Json measureGraded(Bench& bench) {
    const judge::Glass glass{{judge::luneburgBall(kCentre, kRadius, 1.5)}};
    const Stage stage(sceneOf(glass));
    return {{"to_95",
             worstDegrees(bench, stage, glass, 41, [](double impact) { return impact <= 0.95; })}};
}

/// Colours of a picture, x fastest.
std::vector<dvec3> coloursOf(Bench& bench, const scene::Files& scene, const view::Params& params,
                             const std::optional<image::Image>& map = {}) {
    Stats stats;
    const image::Image picture = view::render(
        bench.device, view::makePlan(scene, params, map.has_value()), params, map, stats, {});
    std::vector<dvec3> colours;
    for (size_t i = 0; i < picture.area(); ++i) {
        const auto channel = [&](const char* name) {
            return picture.plane(*picture.find(name))[i];
        };
        colours.emplace_back(channel("R"), channel("G"), channel("B"));
    }
    return colours;
}

/// A ray past the centre at impact · radius, on the side of `azimuth`.
judge::Ray aimed(double impact, double azimuth) {
    const dvec3 d = glm::normalize(kViews[1]);
    const dvec3 u = glm::normalize(glm::cross(d, dvec3(0.3, 0.8, 0.5))), v = glm::cross(d, u);
    return {kCentre - 60.0 * d + impact * kRadius * (std::cos(azimuth) * u + std::sin(azimuth) * v),
            d};
}

constexpr size_t kOrders = 4;
using Directions = std::array<dvec3, kOrders>;

/// Where the first four orders go; none where another branch leaves within 6° of one of them: the
/// cones that tell them apart are 5° wide, their edges 0.7°.
std::optional<Directions> ordersApart(const judge::Tree& tree) {
    const std::string courses[] = {"R", "TT", "TRT", "TRRT"};
    Directions directions{};
    for (const judge::Branch& branch : tree.left)
        for (size_t order = 0; order < kOrders; ++order)
            if (branch.course == courses[order]) directions[order] = branch.ray.direction;
    for (const judge::Branch& branch : tree.left)
        for (size_t order = 0; order < kOrders; ++order)
            if (branch.course != courses[order] &&
                sharp::degreesBetween(branch.ray.direction, directions[order]) <= 6)
                return {};
    return directions;
}

/// The largest difference of an order's share of the power from Fresnel's, over impacts. The
/// surroundings shine in a cone about each order's direction.
Json measureOrders(Bench& bench) {
    double off = 0;
    int rays = 0;
    for (const Kind& kind : kKinds) {
        const judge::Glass glass = kind.glass();
        const scene::Files scene = sceneOf(glass);
        for (double impact = 0.04; impact < 0.99; impact += bench.full ? 0.025 : 0.1) {
            if (kind.critical(impact) || impact > kind.ratio()) continue;
            const judge::Ray ray = aimed(impact, 9 * impact);
            const auto directions =
                ordersApart(judge::followAll(glass, ray, {.maxDepth = 8, .minThroughput = 1e-5}));
            if (!directions) continue;
            ++rays;
            const auto shares = judge::ballOrders(kind.ratio(), impact, false);
            for (size_t order = 0; order < kOrders; ++order) {
                const image::Image map = sharp::mapOf([&](dvec3 d) {
                    return dvec3(sharp::degreesBetween(d, (*directions)[order]) < 5);
                });
                const dvec3 seen = coloursOf(bench, scene, sharp::oneRay(ray), map).front();
                off = std::max(off, std::abs(seen.x - shares[order]));
            }
        }
    }
    return {{"off", off}, {"rays", rays}};
}

/// Whether what a ray's tree leaves is told by the ray: a hundredth of a voxel aside it is the same
/// to a fifth of the bar, so that no rounding decides on a branch.
bool tellable(const judge::Glass& glass, const judge::Ray& ray, const judge::Limits& limits) {
    const double sum = judge::followAll(glass, ray, limits).sum();
    const dvec3 u = glm::normalize(glm::cross(ray.direction, dvec3(0.3, 0.8, 0.5)));
    const dvec3 v = glm::cross(ray.direction, u);
    for (const dvec3& aside : {u, -u, v, -v})
        if (std::abs(judge::followAll(glass, {ray.x + 0.01 * aside, ray.direction}, limits).sum() -
                     sum) > 2e-5)
            return false;
    return true;
}

/// Wine in a ball of glass, a bubble in the wine, in surroundings of radiance 1: the largest
/// difference from 1 less what depth 8 drops.
Json measureWine(Bench& bench) {
    const judge::Glass glass{{judge::glassBall(kCentre, 26, 1.5, 0),
                              judge::glassBall(kCentre + dvec3(1, 2, -1), 20, 1.34, 1),
                              judge::glassBall(kCentre + dvec3(-2, 1, 1), 11, 1, 2)}};
    const scene::Files scene = sceneOf(glass);
    double off = 0;
    int count = 0;
    for (const dvec3& direction : kViews) {
        view::Params params = sharp::along(direction, kCentre, 50, {45, 45});
        params.aovs.clear();
        params.background = dvec3(1);
        const std::vector<dvec3> colours = coloursOf(bench, scene, params);
        const std::vector<judge::Ray> rays = raysOf(params.camera);
        const judge::Limits limits{.maxDepth = params.maxDepth, .minThroughput = params.cutoff};
        for (size_t i = 0; i < rays.size(); ++i) {
            if (!tellable(glass, rays[i], limits)) continue;
            off = std::max(off,
                           std::abs(colours[i].x - judge::followAll(glass, rays[i], limits).sum()));
            ++count;
        }
    }
    return {{"off", off}, {"rays", count}};
}

} // namespace

std::vector<Task> glassTasks(Bench& bench) {
    std::vector<Task> tasks;
    const auto add = [&](const std::string& what, const std::function<Json()>& measure) {
        Json key{{"part", "glass"}, {"what", what}, {"full", bench.full}};
        key.update(bench.version);
        tasks.push_back({key, "sharp: " + what, measure});
    };
    for (const Kind& kind : kKinds)
        add(kind.name, [&bench, &kind] { return measureBall(bench, kind); });
    add("graded", [&bench] { return measureGraded(bench); });
    add("orders", [&bench] { return measureOrders(bench); });
    add("wine", [&bench] { return measureWine(bench); });
    return tasks;
}

} // namespace accuracy
