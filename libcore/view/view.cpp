// The view stage: curved viewing rays through a lit scene volume (Sun et al. 2008, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view.h"

#include "optics/bands.h"
#include "view/background.h"
#include "view/pattern.h"
#include "view/picture.h"
#include "view/rays.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace eikonal::view {

namespace {

/// How many rows a strip has: few enough that each launch, one ray of its every pixel, ends within
/// about a third of a second, so that progress is told and a desktop on the same device stays
/// alive. Pixels do not depend on it.
class StripRows {
public:
    explicit StripRows(const Params& params) : mMost(rowsPerStrip(params)) {
        mRows = wholeGroups((1 << 14) / params.camera.width);
    }
    int rows() const { return mRows; }

    /// Learns from a strip of so many rows, whose longest launch took so long.
    void took(int rows, double milliseconds) {
        if (rows < mRows) return; // a picture's last rows tell little
        // Twice as many at most, since the next rows may hold more.
        mRows = wholeGroups(mRows * std::min(300 / std::max(milliseconds, 1.0), 2.0));
    }

private:
    /// The kernel works on groups of eight rows.
    int wholeGroups(double rows) const {
        return std::min(std::max(static_cast<int>(rows / 8) * 8, 8), mMost);
    }
    int mMost, mRows;
};

/// Goes on with the rays that a launch left at rest, until none is left.
void goOn(Rays& rays, Picture& picture) {
    int half = 1;
    for (int resting = picture.resting(); resting > 0; resting = picture.resting()) {
        picture.clearRests();
        rays.goOn(resting, half);
        gpu::finish();
        half = 1 - half;
    }
}

/// How far samples' lines are shifted: by the golden ratio, so that few of them spread evenly.
int lineShift(int sample) {
    const double turn = 0.6180339887498949 * sample;
    return static_cast<int>((turn - std::floor(turn)) * optics::kLinesPerBand);
}

/// All rays of a strip of the picture: every sample of every band.
/// `progress` is the strip's part. Returns how long the longest launch took [ms].
double traceStrip(Rays& rays, Picture& picture, const std::vector<optics::Band>& bands, int samples,
                  int row, int rows, const Progress& progress) {
    double longest = 0;
    const std::vector<glm::dvec2> places = samplePattern(samples);
    const double share = 1.0 / samples, coverage = share / static_cast<double>(bands.size());
    int done = 0;
    const auto all = static_cast<int>(bands.size()) * samples;
    const auto launch = [&](const Launch& one) {
        const auto began = std::chrono::steady_clock::now();
        picture.clearRests();
        rays.trace(row, rows, one);
        gpu::finish();
        goOn(rays, picture);
        longest = std::max(longest, gpu::millisecondsSince(began));
    };
    // Paths are those of light of 587.6 nm, which may be none of the bands'.
    const bool paths = bands.size() > 1;
    if (paths) {
        rays.setLines(optics::bandsOf({}, false).front().shifted);
        launch({places.front(), true, vec4(0)});
    }
    for (const optics::Band& band : bands) {
        rays.setLines(band.shifted);
        for (int sample = 0; sample < samples; ++sample) {
            launch({places[static_cast<size_t>(sample)], !paths && done == 0,
                    vec4(glm::dvec3(share), coverage), sample, lineShift(sample)});
            report(progress, static_cast<double>(++done) / all);
        }
    }
    return longest;
}

} // namespace

image::Image render(gpu::Device& device, const Plan& plan, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    std::vector<gpu::Need> needs = needsOf(plan, params);
    if (map) needs.push_back(mapNeed(*map));
    device.requireFit(needs);
    gpu::Profiler profiler(stats);
    Rays rays(device, plan, params, map, profiler);
    Picture picture(device, plan, params);
    const std::vector<optics::Band> bands =
        optics::bandsOf(params.wavelengths, plan.scene.disperses);
    rays.bind();
    picture.bind();
    const int all = params.camera.rows;
    StripRows strips(params);
    for (int row = 0, rows = 0; row < all; row += rows) {
        rows = std::min(strips.rows(), all - row);
        profiler.begin("view");
        const double longest = traceStrip(rays, picture, bands, params.samples, row, rows,
                                          partOf(progress, static_cast<double>(row) / all,
                                                 static_cast<double>(row + rows) / all));
        profiler.end();
        strips.took(rows, longest);
        device.check("view");
        profiler.begin("download");
        picture.readStrip(row, rows);
        profiler.end();
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
