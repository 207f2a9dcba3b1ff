// A ball on its way from mesh to smooth voxels, judged by Snell's law.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball.h"

#include <algorithm>
#include <cmath>

namespace accuracy {

using namespace eikonal;

namespace {

const Ball kBall;

struct Knobs {
    int voxels = 128, supersample = 4;
    double sigma = 1.5;
};

double cpuMs(const Stats& stats, const std::vector<std::string>& names) {
    double ms = 0;
    for (const PassTime& pass : stats.passes)
        if (std::find(names.begin(), names.end(), pass.name) != names.end()) ms += pass.cpuMs;
    return ms;
}

/// Sum of the ball's share of every voxel, times the voxel's volume [unit³].
double coveredVolume(const volume::Volume& volume) {
    const volume::DenseGrid index = volume.dense("ior", volume.domain());
    double sum = 0;
    for (const float n : index.values) sum += (static_cast<double>(n) - 1) / (kBall.index - 1);
    return sum * std::pow(volume.frame().voxelSize, 3);
}

Json measure(Bench& bench, const Knobs& knobs) {
    Stats stats;
    const volume::Volume volume =
        voxelised(bench, kBall, knobs.voxels, knobs.supersample, false, stats);
    const double covered = coveredVolume(volume), solid = mesh::signedVolume(meshOf(kBall));
    const Stage stage{sceneWith(blurred(bench, volume, knobs.sigma, stats))};
    const view::Camera camera = cameraAt(kBall, kErrorPixels, 2 * kBall.radius);
    const std::vector<judge::Ray> rays = raysOf(camera);
    const Ends exact = stage.ends(bench, camera, fixed("sharma", "cubic", 0.25));
    const Ends plain = stage.ends(bench, camera, sources());
    const Ends asUsual = stage.ends(bench, camera, usual());
    Json values{{"volume_error", covered / solid - 1},
                {"voxelize_ms", cpuMs(stats, {"voxelize", "materials"})}};
    for (const double off : {0.5, 0.9}) {
        const std::string at = off == 0.5 ? "_half" : "_rim";
        const auto error = [&](const Ends& ends) {
            return deflectionError(kBall, rays, ends, off - 0.05, off + 0.05);
        };
        values["exact" + at] = error(exact);
        values["usual" + at] = error(asUsual);
        values["sources" + at] = error(plain);
    }
    return values;
}

} // namespace

std::vector<Task> chainTasks(Bench& bench) {
    std::vector<Knobs> all;
    const auto add = [&](const Knobs& knobs) { all.push_back(knobs); };
    for (const double sigma : {0.5, 0.75, 1.0, 1.5, 2.0, 3.0})
        if (bench.full || sigma != 0.75) add({.sigma = sigma});
    for (const int supersample : {1, 2, 8})
        for (const double sigma : {0.75, 1.5})
            if (bench.full || sigma == 1.5) add({.supersample = supersample, .sigma = sigma});
    add({.voxels = 32});
    add({.voxels = 64});
    if (bench.full) add({.voxels = 256});
    std::vector<Task> tasks;
    for (const Knobs& knobs : all) {
        Json key{{"part", "chain"},
                 {"voxels", knobs.voxels},
                 {"supersample", knobs.supersample},
                 {"sigma", knobs.sigma}};
        key.update(bench.version);
        tasks.push_back({key,
                         "ball of " + std::to_string(knobs.voxels) + " voxels, " +
                             std::to_string(knobs.supersample) + " samples, sigma " +
                             std::to_string(knobs.sigma).substr(0, 4),
                         [&bench, knobs] { return measure(bench, knobs); }});
    }
    return tasks;
}

} // namespace accuracy
