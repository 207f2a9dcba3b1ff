// Photons against paper: a slab, a point light, the caustic of a ball.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "light.h"
#include "support/glass_volume.h"

#include <algorithm>

#include <cmath>
#include <glm/geometric.hpp>

namespace accuracy {

using namespace eikonal;

namespace {

constexpr int kVoxels = 64;

template<typename Value> std::vector<float> overVoxels(int voxels, const Value& value) {
    std::vector<float> values;
    forEachVoxel(glm::ivec3(voxels),
                 [&](glm::ivec3 p) { values.push_back(static_cast<float>(value(p))); });
    return values;
}

/// Light straight down through grey absorption: every voxel has the mean of Beer and Lambert's law.
Json measureSlab(Bench& bench, std::int64_t photons) {
    const double sigma = 0.03;
    TestVolume volume{glm::ivec3(kVoxels)};
    volume.constantVector("absorption", dvec3(sigma));
    const lightsim::Light down{lightsim::Light::Kind::directional, dvec3(0, -1, 0), dvec3(1)};
    lightsim::Params params = lightParams(down, photons);
    params.thinTo = 0;
    const Lit lit = light(bench, volume.volume(), params);
    const auto wanted = overVoxels(kVoxels, [&](glm::ivec3 p) {
        const double depth = kVoxels - 1 - p.y;
        return judge::beerLambertMean(1, sigma, depth, depth + 1);
    });
    return {{"error", relativeRms(lit.fluence, wanted)}, {"ms", lit.ms}};
}

/// A point light above the box, in thin haze.
Json measurePoint(Bench& bench, std::int64_t photons) {
    const double sigma = 0.01;
    TestVolume volume{glm::ivec3(kVoxels)};
    volume.constantVector("absorption", dvec3(sigma));
    const dvec3 place(30, 80, 35);
    lightsim::Params params =
        lightParams({lightsim::Light::Kind::point, place, dvec3(1e3)}, photons);
    params.thinTo = 0;
    const Lit lit = light(bench, volume.volume(), params);
    // Only the way within the box dims: the light stands above it, and the face is at 64.
    const auto wanted = overVoxels(kVoxels, [&](glm::ivec3 p) {
        const double all = judge::inverseSquareMean(1e3, place, dvec3(p), 1);
        const dvec3 to = dvec3(p) + 0.5 - place;
        // The way within: of the whole the share below the face the light comes in by; light that
        // comes in by a side has a shorter one.
        double share = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double face = to[axis] < 0 ? kVoxels : 0;
            const double at = to[axis] != 0 ? (face - place[axis]) / to[axis] : -1;
            share = std::max(share, at);
        }
        return all * std::exp(-sigma * glm::length(to) * (1 - share));
    });
    return {{"error", relativeRms(lit.fluence, wanted)}, {"ms", lit.ms}};
}

/// Light through the ball by Snell's law, in the same voxels; made once per size.
std::vector<float> snellFluence(Bench& bench, int voxels) {
    return kept(bench.work, {{"part", "snell"}, {"voxels", voxels}}, [&] {
        judge::BallScene scene;
        scene.centre = ballCentre();
        scene.radius = 16;
        scene.index = 1.5;
        scene.direction = slantingLight().vector;
        scene.photons = voxels > 64 ? 1e6 : 4e5;
        const judge::Grid grid{dvec3(0), 64.0 / voxels, glm::ivec3(voxels)};
        std::vector<float> values;
        for (const double value : judge::ballFluence(scene, grid))
            values.push_back(static_cast<float>(value));
        return values;
    });
}

/// Relative rms over the voxels below the ball, where the caustic is, and over all.
Json measureCaustic(Bench& bench, int voxels, double sigma, const Setting& trace,
                    std::int64_t photons) {
    lightsim::Params params = lightParams(slantingLight(), photons);
    params.tracing = trace.tracing;
    params.smoothing = 0; // whose mean over voxels is no matter of tracing
    params.stepMin = 0.5;
    const Lit lit = light(bench, hazyBall(voxels, sigma, false).volume(), params);
    const auto wanted = snellFluence(bench, voxels);
    const double h = 64.0 / voxels;
    const dvec3 down = slantingLight().vector;
    const auto behind = [&](size_t i) {
        const auto n = static_cast<size_t>(voxels);
        const dvec3 p = (dvec3(i % n, i / n % n, i / n / n) + 0.5) * h - ballCentre();
        const double along = glm::dot(p, down);
        return along > 16 && glm::length(p - along * down) < 16;
    };
    return {{"error", relativeRms(lit.fluence, wanted)},
            {"behind", relativeRms(lit.fluence, wanted, behind)},
            {"ms", lit.ms}};
}

/// The plane of voxels at height `y` of a slab or box.
std::vector<float> planeAt(const std::vector<float>& values, const glm::ivec3& size, int y) {
    std::vector<float> plane;
    size_t i = 0;
    forEachVoxel(size, [&](glm::ivec3 p) {
        if (p.y == y) plane.push_back(values[i]);
        ++i;
    });
    return plane;
}

/// Three planes of voxels about height `y` under a ball of glass, all reflections in them; made
/// once per size. Photons so many to a voxel that their own error, smallest where light is dense,
/// does not count.
std::vector<float> beamFluence(Bench& bench, const judge::Glass& glass, const dvec3& direction,
                               int voxels, int y) {
    return kept(bench.work, {{"part", "beam"}, {"voxels", voxels}}, [&] {
        const judge::Grid slab{{0, y - 1, 0}, 1, {voxels, 3, voxels}};
        const double disc = 4.5 * voxels * voxels; // about what photons start over [voxel²]
        std::vector<float> values;
        for (const double value :
             judge::beamFluence(glass, {.direction = direction, .photons = 200 * disc}, slab))
            values.push_back(static_cast<float>(value));
        return values;
    });
}

/// A sun aslant through a ball of glass with a sharp boundary, radius 0.5 in a box of 1.6 units:
/// the plane 0.75 below its centre.
Json measureSharpLight(Bench& bench, int voxels, int power) {
    const double h = 1.6 / voxels;
    const dvec3 centre(0.71, 1.02, 0.76), sun = glm::normalize(dvec3(0.3, -1, 0.15));
    const int y = static_cast<int>((centre.y - 0.75) / h);
    const judge::Glass glass{{judge::glassBall(centre / h, 0.5 / h, 1.5)}};
    lightsim::Params params =
        lightParams({lightsim::Light::Kind::directional, sun, dvec3(1)}, std::int64_t{1} << power);
    params.tracing.boundary = optics::Boundary::sharp;
    params.smoothing = 0;
    const Lit lit = light(
        bench, sharp::volumeOf(glass, {.size = glm::ivec3(voxels), .voxelSize = h, .halfWidth = 6}),
        params);
    const glm::ivec3 slab(voxels, 3, voxels);
    const auto wanted = beamFluence(bench, glass, sun, voxels, y);
    return {{"error",
             relativeRms(planeAt(lit.fluence, glm::ivec3(voxels), y), planeAt(wanted, slab, 1))},
            {"ms", lit.ms}};
}

} // namespace

void addTruthTasks(Bench& bench, std::vector<Task>& tasks) {
    const auto add = [&](Json key, const std::string& label, const std::function<Json()>& measure) {
        key.update(bench.version);
        tasks.push_back({key, label, measure});
    };
    const int to = bench.full ? 20 : 16;
    for (int power = 12; power <= to; power += 2) {
        const std::int64_t photons = std::int64_t{1} << power;
        const std::string many = ", " + std::to_string(photons) + " photons";
        add({{"part", "slab"}, {"photons", photons}}, "slab" + many,
            [&bench, photons] { return measureSlab(bench, photons); });
        add({{"part", "point"}, {"photons", photons}}, "point light" + many,
            [&bench, photons] { return measurePoint(bench, photons); });
    }
    const int size = bench.full ? 128 : 64, power = bench.full ? 24 : 20;
    add({{"part", "sharp light"}, {"voxels", size}, {"power", power}}, "sharp: light under a ball",
        [&bench, size, power] { return measureSharpLight(bench, size, power); });
    const std::int64_t photons = bench.full ? 1 << 20 : 1 << 17;
    std::vector<int> sizes{32, 64};
    if (bench.full) sizes.push_back(128);
    for (const int voxels : sizes)
        for (const double sigma : {0.75, 1.5})
            for (const Setting& trace :
                 {fixed("verlet", "linear", 0), fixed("sharma", "cubic", 0)}) {
                Json key{{"part", "caustic"},
                         {"voxels", voxels},
                         {"sigma", sigma},
                         {"photons", photons}};
                key.update(trace.key());
                add(key,
                    "caustic of " + std::to_string(voxels) + " voxels, sigma " +
                        std::to_string(sigma).substr(0, 4) + ", " + trace.name(),
                    [&bench, voxels, sigma, trace, photons] {
                        return measureCaustic(bench, voxels, sigma, trace, photons);
                    });
            }
}

} // namespace accuracy
