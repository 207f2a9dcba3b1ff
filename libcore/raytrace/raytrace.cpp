// Meshes traced exactly on the host.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/raytrace.h"

#include "camera/pattern.h"
#include "raytrace/paths.h"
#include "raytrace/picture.h"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

double millisecondsSince(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
        .count();
}

/// Rows between two reports of progress.
constexpr int kStrip = 16;

/// A picture's rows, each on whichever thread.
class Tracer {
public:
    Tracer(const Scene& scene, const Params& params, Pixels& pixels)
        : mScene(scene), mParams(params), mPixels(pixels), mEye(params.camera),
          mPlaces(camera::samplePattern(params.samples)),
          mWithin(scene.windingsAt(params.camera.eye)) {}

    Counters traceRow(int row) const {
        Counters counters;
        const auto width = static_cast<size_t>(mParams.camera.width);
        for (size_t column = 0; column < width; ++column) {
            dvec3 light(0);
            double coverage = 0;
            for (size_t sample = 0; sample < mPlaces.size(); ++sample) {
                const camera::Ray ray = mEye.rayThrough(glm::dvec2(column, row) + mPlaces[sample]);
                FirstPath first;
                light +=
                    mScene.radiance(ray.start, ray.direction, withinAt(ray.start), first, counters);
                coverage += first.changed ? 1 : 0;
                if (sample == 0 && !mPixels.paths.empty())
                    mPixels.paths[static_cast<size_t>(row) * width + column] = first;
            }
            mPixels.colours[static_cast<size_t>(row) * width + column] =
                glm::vec4(glm::dvec4(light, coverage) / static_cast<double>(mPlaces.size()));
        }
        return counters;
    }

private:
    Windings withinAt(const dvec3& start) const {
        return mParams.camera.parallel ? mScene.windingsAt(start) : mWithin;
    }

    const Scene& mScene;
    const Params& mParams;
    Pixels& mPixels;
    camera::Eye mEye;
    std::vector<glm::dvec2> mPlaces;
    Windings mWithin; ///< the eye
};

} // namespace

image::Image render(const Params& params, const std::vector<Body>& bodies,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    params.check();
    auto began = std::chrono::steady_clock::now();
    const Scene scene(bodies, params, map);
    stats.addPass("tree", 0, millisecondsSince(began));
    began = std::chrono::steady_clock::now();
    Pixels pixels;
    const size_t area = static_cast<size_t>(params.camera.width) * params.camera.rows;
    pixels.colours.resize(area);
    const bool coloured = scene.coloured();
    if (coloured || !params.aovs.empty()) pixels.paths.resize(area);
    const Tracer tracer(scene, params, pixels);
    std::vector<Counters> rows(static_cast<size_t>(params.camera.rows));
    for (int row = 0; row < params.camera.rows; row += kStrip) {
        const int end = std::min(row + kStrip, params.camera.rows);
        tbb::parallel_for(row, end,
                          [&](int r) { rows[static_cast<size_t>(r)] = tracer.traceRow(r); });
        report(progress, static_cast<double>(end) / params.camera.rows);
    }
    Counters all;
    for (const Counters& counters : rows) all += counters; // in order: sums repeat
    stats.addPass("rays", 0, millisecondsSince(began));
    const double rays = std::max(all.rays, 1.0);
    stats.count("rays", all.rays);
    stats.count("boundaries_met", all.interfaces);
    stats.count("light_dropped_by_depth", all.deep / rays);
    stats.count("light_dropped_as_dim", all.dim / rays);
    stats.count("light_lost_by_holes", all.lost / rays);
    return assemble(pixels, params, coloured);
}

} // namespace eikonal::raytrace
