// The view stage: curved viewing rays through a lit scene volume (Sun et al. 2008, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view.h"

#include "camera/background.h"
#include "camera/pattern.h"
#include "optics/bands.h"
#include "view/domains.h"
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
    StripRows(const Params& params, bool several) : mMost(rowsPerStrip(params, several)) {
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

/// What a picture is made with: a kernel and its scene for each domain, and rays between them.
struct Work {
    std::vector<Rays> rays;
    std::optional<Domains> domains; ///< of several
    Picture picture;

    /// Readies the kernel of a domain, for rays from the eye or those that come from other domains.
    void take(size_t domain, bool arrivals) {
        if (!domains) return;
        rays[domain].bind();
        domains->bind(domain, arrivals);
        picture.bind();
    }
    void setLines(const std::vector<optics::Line>& lines) {
        for (Rays& one : rays) one.setLines(lines);
    }
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

/// One ray of every pixel of a strip, through all domains.
void trace(Work& work, int row, int rows, const Launch& one) {
    const auto launch = [&](size_t domain, bool arrivals) {
        work.take(domain, arrivals);
        work.picture.clearRests();
        work.rays[domain].trace(row, rows, one);
        gpu::finish();
        goOn(work.rays[domain], work.picture);
    };
    if (work.domains) work.domains->clear();
    launch(0, false);
    if (!work.domains) return;
    // Domains are convex: what has left one comes to another, and in the end to none.
    for (size_t domain = 1; work.domains->waiting() > 0; ++domain)
        launch(domain % work.rays.size(), true);
}

/// All rays of a strip of the picture: every sample of every band.
/// `progress` is the strip's part. Returns how long the longest launch took [ms].
double traceStrip(Work& work, const std::vector<optics::Band>& bands, int samples, int row,
                  int rows, const Progress& progress) {
    double longest = 0;
    const std::vector<glm::dvec2> places = camera::samplePattern(samples);
    const double share = 1.0 / samples, coverage = share / static_cast<double>(bands.size());
    int done = 0;
    const auto all = static_cast<int>(bands.size()) * samples;
    const auto launch = [&](const Launch& one) {
        const auto began = std::chrono::steady_clock::now();
        trace(work, row, rows, one);
        longest = std::max(longest, gpu::millisecondsSince(began));
    };
    // Paths are those of light of 587.6 nm, which may be none of the bands'.
    const bool paths = bands.size() > 1;
    if (paths) {
        work.setLines(optics::bandsOf({}, false).front().shifted);
        launch({places.front(), true, vec4(0)});
    }
    for (const optics::Band& band : bands) {
        work.setLines(band.shifted);
        for (int sample = 0; sample < samples; ++sample) {
            launch({places[static_cast<size_t>(sample)], !paths && done == 0,
                    vec4(glm::dvec3(share), coverage), sample, lineShift(sample)});
            report(progress, static_cast<double>(++done) / all);
        }
    }
    return longest;
}

} // namespace

image::Image render(gpu::Device& device, const std::vector<Plan>& plans, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    std::vector<gpu::Need> needs = needsOf(plans, params);
    if (map) needs.push_back(camera::mapNeed(*map));
    device.requireFit(needs);
    gpu::Profiler profiler(stats);
    Work work{{}, {}, Picture(device, plans, params)};
    for (const Plan& plan : plans) work.rays.emplace_back(device, plan, params, map, profiler);
    if (plans.size() > 1) work.domains.emplace(device, plans, params);
    const std::vector<optics::Band> bands =
        optics::bandsOf(params.wavelengths, plans.front().scene.disperses);
    work.rays.front().bind();
    work.picture.bind();
    const int all = params.camera.rows;
    StripRows strips(params, plans.size() > 1);
    for (int row = 0, rows = 0; row < all; row += rows) {
        rows = std::min(strips.rows(), all - row);
        profiler.begin("view");
        const double longest = traceStrip(work, bands, params.samples, row, rows,
                                          partOf(progress, static_cast<double>(row) / all,
                                                 static_cast<double>(row + rows) / all));
        profiler.end();
        strips.took(rows, longest);
        device.check("view");
        profiler.begin("download");
        work.picture.readStrip(row, rows);
        profiler.end();
    }
    work.picture.readCounters(plans, params, stats);
    profiler.collect();
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return work.picture.assemble(plans, params);
}

image::Image render(gpu::Device& device, const Plan& plan, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    return render(device, std::vector<Plan>{plan}, params, map, stats, progress);
}

} // namespace eikonal::view
