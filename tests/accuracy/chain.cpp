// A ball on its way from mesh to smooth voxels, judged by Snell's law.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rays.h"

#include "judge/snell.h"
#include "mesh/shapes.h"
#include "smooth/smooth.h"
#include "voxelize/voxelize.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace accuracy {

using namespace eikonal;

namespace {

constexpr double kRadius = 32, kIndex = 1.5; // in the box of 128 units

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
    for (const float n : index.values) sum += (static_cast<double>(n) - 1) / (kIndex - 1);
    return sum * std::pow(volume.frame().voxelSize, 3);
}

void smoothIndex(Bench& bench, volume::Volume& volume, double sigma, Stats& stats) {
    smooth::Params params;
    params.sigma = sigma;
    volume::PutOptions options;
    options.keepActive = true;
    for (const smooth::Item& item :
         smooth::run(bench.device, smooth::makePlan(volume, params), stats, {})) {
        options.background = item.background;
        volume.put(item.grid, volume.domain(), item.values, options);
    }
}

/// Rays whose impact is within a twentieth of `off` radii: rms of the angle between where they go
/// and where Snell's law sends the ray of their own impact [degree].
double deflectionError(const std::vector<judge::Ray>& rays, const Ends& ends, double off) {
    double squares = 0;
    int count = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const dvec3 d = glm::normalize(rays[i].direction), x = rays[i].x - dvec3(kBox / 2);
        const dvec3 across = x - glm::dot(x, d) * d;
        const double impact = glm::length(across) / kRadius;
        if (std::abs(impact - off) > 0.05) continue;
        const double angle = judge::ballDeflection(kIndex, impact);
        const dvec3 wanted = std::cos(angle) * d - std::sin(angle) * glm::normalize(across);
        // By its tangent: the cosine of a small angle says nothing.
        const double error = std::atan2(glm::length(glm::cross(wanted, ends.direction[i])),
                                        glm::dot(wanted, ends.direction[i]));
        squares += error * error;
        ++count;
    }
    return std::sqrt(squares / count) * 180 / std::numbers::pi;
}

Json measure(Bench& bench, const Knobs& knobs) {
    voxelize::Params params;
    voxelize::Object object;
    object.name = "ball";
    object.material.ior = kIndex;
    // Its facets' corners are on the sphere; 327,680 of them cut off 3e-5 of the volume.
    object.mesh = mesh::moved(mesh::icosphere(kRadius, 7), dvec3(kBox / 2));
    const double solid = mesh::signedVolume(object.mesh);
    params.objects.push_back(std::move(object));
    params.resolution = knobs.voxels;
    params.bounds = mesh::Box{dvec3(0), dvec3(kBox)};
    params.supersample = knobs.supersample;
    params.sharp = false; // the blurred chain is what is measured
    params.check();
    Stats stats;
    volume::Volume volume =
        voxelize::voxelize(bench.device, params, voxelize::makePlan(params), stats).volume;
    const double covered = coveredVolume(volume);
    smoothIndex(bench, volume, knobs.sigma, stats);
    std::vector<volume::Volume> volumes;
    volumes.push_back(std::move(volume));
    const Stage stage{view::Scene(std::move(volumes))};

    view::Camera camera;
    const dvec3 direction = glm::normalize(dvec3(0.1, 0.05, 1));
    camera.eye = dvec3(kBox / 2) - 2 * kBox * direction;
    camera.target = dvec3(kBox / 2);
    camera.parallel = true;
    camera.height = 2 * kRadius;
    camera.width = camera.rows = 64;
    const std::vector<judge::Ray> rays = raysOf(camera);
    const Ends exact = stage.ends(bench, camera, fixed("sharma", "cubic", 0.25));
    const Ends plain = stage.ends(bench, camera, sources());
    const Ends asUsual = stage.ends(bench, camera, usual());
    Json values{{"volume_error", covered / solid - 1},
                {"voxelize_ms", cpuMs(stats, {"voxelize", "materials"})}};
    for (const double off : {0.5, 0.9}) {
        const std::string at = off == 0.5 ? "_half" : "_rim";
        values["exact" + at] = deflectionError(rays, exact, off);
        values["usual" + at] = deflectionError(rays, asUsual, off);
        values["sources" + at] = deflectionError(rays, plain, off);
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
