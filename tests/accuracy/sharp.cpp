// A ball of glass, its edge blurred or sharp: what its rays are off by, and what the picture costs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball.h"
#include "support/glass_volume.h"

#include <algorithm>
#include <memory>

namespace accuracy {

using namespace eikonal;

namespace {

/// On no lattice point of any size, and at no one's half.
const Ball kBall{.centre = {63.26, 64.42, 63.74}, .radius = 52.6, .index = 1.5};

// The sources' edge [voxel], and half the width of level sets' bands as mesh2vol writes them.
constexpr double kSourcesSigma = 1.5, kBand = 6;

/// One way to draw the ball.
struct Way {
    std::string edge; ///< "blurred", "sharp", or "mesh": sharp by the mesh's own distances
    std::string name;
    const Stage* stage;
    Setting setting;
    double sigma = 0;         ///< [voxel]
    double half = 0, rim = 0; ///< errors [degree]
    std::vector<double> ms{}, ratio{};
};

Setting toDepth(int depth) {
    Setting setting = usual();
    setting.maxDepth = depth;
    return setting;
}

/// Distances of the formula, in a band.
volume::Volume sharpBall(int voxels) {
    const double h = kBox / voxels;
    const judge::Glass glass{{judge::glassBall(kBall.centre / h, kBall.radius / h, kBall.index)}};
    return sharp::volumeOf(glass, {.size = glm::ivec3(voxels), .voxelSize = h, .halfWidth = kBand});
}

/// Rays about half the radius, and near the rim.
void findErrors(Bench& bench, Way& way) {
    const view::Camera camera = cameraAt(kBall, kErrorPixels, 2 * kBall.radius);
    const Ends ends = way.stage->ends(bench, camera, way.setting);
    const std::vector<judge::Ray> rays = raysOf(camera);
    way.half = deflectionError(kBall, rays, ends, 0.45, 0.55);
    way.rim = deflectionError(kBall, rays, ends, 0.94, 0.96);
}

std::vector<double> sigmasOf(const Bench& bench, int voxels) {
    if (bench.full) return {0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4, 6};
    if (voxels > 128) return {1, 1.5, 2};
    return {0.75, 1, 1.5, 2, 2.5, 3};
}

/// Ways to trace rays through the best blur.
std::vector<Setting> settingsOf(const Bench& bench, int voxels) {
    std::vector<Setting> all{fixed("verlet", "linear", 4), usual(), fixed("verlet", "linear", 0.5)};
    if (bench.full || voxels <= 128) all.push_back(fixed("verlet", "cubic", 1));
    if (bench.full)
        for (const Setting& more :
             {fixed("verlet", "cubic", 0.5), fixed("sharma", "cubic", 1), adaptive(0.1)})
            all.push_back(more);
    return all;
}

/// Of all blurs the one whose rays, traced well, are off by the least about half the radius.
struct BestBlur {
    std::unique_ptr<Stage> stage;
    double sigma = 0, half = 1e300;
    Json tried = Json::array(); ///< {sigma, half, rim}
};
BestBlur bestBlur(Bench& bench, const volume::Volume& covered, int voxels) {
    BestBlur best;
    Stats stats;
    for (const double sigma : sigmasOf(bench, voxels)) {
        auto stage = std::make_unique<Stage>(sceneWith(blurred(bench, covered, sigma, stats)));
        Way way{"blurred", "", stage.get(), fixed("verlet", "cubic", 0.5)};
        findErrors(bench, way);
        best.tried.push_back({{"sigma", sigma}, {"half", way.half}, {"rim", way.rim}});
        if (way.half >= best.half) continue;
        best.stage = std::move(stage);
        best.sigma = sigma;
        best.half = way.half;
    }
    return best;
}

/// The ways take turns, so that a machine that slows down slows them all. What a first run costs
/// more is no median.
void timeAll(Bench& bench, std::vector<Way>& ways, int voxels) {
    const int pixels = bench.full ? 256 : 128;
    const int rounds = bench.full || voxels <= 128 ? 5 : 3; // at 256³ making the field takes most
    const view::Camera camera = cameraAt(kBall, pixels, 2.1 * kBall.radius);
    for (int round = 0; round < rounds; ++round)
        for (Way& way : ways) {
            way.ms.push_back(way.stage->time(bench, camera, way.setting));
            way.ratio.push_back(way.ms.back() / ways.front().ms.back());
        }
}

Json measure(Bench& bench, int voxels) {
    Stats stats;
    const Stage asSources(sceneWith(
        blurred(bench, voxelised(bench, kBall, voxels, 4, false, stats), kSourcesSigma, stats)));
    const BestBlur best = bestBlur(bench, voxelised(bench, kBall, voxels, 8, false, stats), voxels);
    const Stage byFormula(sceneWith(sharpBall(voxels)));
    std::unique_ptr<Stage> byMesh; // whose distances take a while at 256³
    if (bench.full || voxels <= 128)
        byMesh =
            std::make_unique<Stage>(sceneWith(voxelised(bench, kBall, voxels, 4, true, stats)));

    std::vector<Way> ways{{"blurred", sources().name(), &asSources, sources(), kSourcesSigma}};
    for (const Setting& setting : settingsOf(bench, voxels))
        ways.push_back({"blurred", setting.name(), best.stage.get(), setting, best.sigma});
    ways.push_back({"sharp", "depth 2", &byFormula, toDepth(2)});
    ways.push_back({"sharp", "depth 8", &byFormula, toDepth(8)});
    if (byMesh) ways.push_back({"mesh", "depth 2", byMesh.get(), toDepth(2)});
    for (Way& way : ways) findErrors(bench, way);
    timeAll(bench, ways, voxels);

    Json values{{"sigmas", best.tried}, {"ways", Json::array()}};
    for (const Way& way : ways)
        values["ways"].push_back({{"edge", way.edge},
                                  {"name", way.name},
                                  {"sigma", way.sigma},
                                  {"half", way.half},
                                  {"rim", way.rim},
                                  {"ms", median(way.ms)},
                                  {"to_sources", median(way.ratio)}});
    return values;
}

} // namespace

std::vector<Task> sharpTasks(Bench& bench) {
    std::vector<Task> tasks;
    for (const int voxels : {64, 128, 256}) {
        Json key{{"part", "sharp"}, {"voxels", voxels}, {"full", bench.full}};
        key.update(bench.version);
        tasks.push_back({key, "blurred and sharp ball of " + std::to_string(voxels) + " voxels",
                         [&bench, voxels] { return measure(bench, voxels); }});
    }
    return tasks;
}

} // namespace accuracy
