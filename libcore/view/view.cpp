// The view stage: curved viewing rays through a lit scene volume (Sun et al. 2008, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view.h"

#include "optics/bands.h"
#include "view/picture.h"
#include "view/rays.h"

#include <algorithm>
#include <glm/common.hpp>

namespace eikonal::view {

namespace {

/// All rays of a strip of the picture: every sample of every band.
void traceStrip(Rays& rays, const std::vector<optics::Band>& bands, int samples, int row,
                int rows) {
    bool first = true;
    for (const optics::Band& band : bands)
        for (int sample = 0; sample < samples; ++sample) {
            // The plastic number's powers: any number of rays is spread evenly over the pixel, and
            // the first goes through its centre.
            const glm::dvec2 place =
                glm::fract(0.5 + static_cast<double>(sample) *
                                     glm::dvec2(0.7548776662466927, 0.5698402909980532));
            const double share = 1.0 / samples;
            rays.trace(row, rows, place, first,
                       vec4(band.weight * share, share / static_cast<double>(bands.size())));
            first = false;
        }
}

} // namespace

image::Image render(gpu::Device& device, const Plan& plan, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    device.requireFit(needsOf(plan, params));
    gpu::Profiler profiler(stats);
    Rays rays(device, plan, params, map, profiler);
    Picture picture(device, plan, params);
    const std::vector<optics::Band> bands = optics::wholeLight();
    rays.bind();
    picture.bind();
    const int all = params.camera.rows;
    for (int row = 0; row < all; row += rowsPerStrip(params)) {
        const int rows = std::min(rowsPerStrip(params), all - row);
        profiler.begin("view");
        traceStrip(rays, bands, params.samples, row, rows);
        profiler.end();
        device.check("view");
        profiler.begin("download");
        picture.readStrip(row, rows);
        profiler.end();
        report(progress, static_cast<double>(row + rows) / all);
    }
    picture.readCounters(plan, params, stats);
    profiler.collect();
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return picture.assemble(plan, params);
}

void describeCamera(const Camera& camera, image::ImageAttributes& attributes) {
    attributes.hasCamera = true;
    attributes.worldToCamera = cameraFromWorld(camera);
    attributes.worldToNDC = ndcFromCamera(camera) * cameraFromWorld(camera);
}

} // namespace eikonal::view
