// View and photon passes against bare kernels, on one device, in one process.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "gpu/program.h"
#include "lightsim/lightsim.h"
#include "scene/field.h"
#include "view/view.h"

#include <chrono>
#include <glm/vec4.hpp>

namespace bench {

using namespace eikonal;

namespace {

constexpr int kWidth = 640, kHeight = 480, kVoxels = 128;

double passMs(const Stats& stats, const std::string& name) {
    for (const PassTime& pass : stats.passes)
        if (pass.name == name) return pass.gpuMs;
    return 0;
}

/// GPU time of one dispatch [ms].
double timed(const gpu::Program& program, glm::ivec3 items) {
    Stats stats;
    gpu::Profiler profiler(stats);
    profiler.begin("bare");
    program.dispatch(items);
    gpu::finish();
    profiler.end();
    profiler.collect();
    return passMs(stats, "bare");
}

/// Steps per second of the bare march: as many rays and steps as the view pass makes, through the
/// same field.
double bareMarch(gpu::Device& device, const gpu::Texture& field) {
    static const gpu::Program program(device, "bench/march.comp.glsl", {});
    const glm::uvec4 values(kWidth, kHeight, kVoxels, 0);
    const gpu::Buffer params(device, sizeof values, &values);
    const gpu::Buffer result(device, std::int64_t{kWidth} * kHeight * 16);
    params.bindUniform(0);
    result.bindStorage(0);
    field.bindSampler(0);
    const double ms = timed(program, {kWidth, kHeight, 1});
    return 1e3 * kWidth * kHeight * kVoxels / ms;
}

/// Adds per second of bare atomics: a million items walk a column of 128 voxels each, eight
/// neighbours on neighbouring words, over as many voxels as the photon pass deposits in.
/// Or, `cached`, over 2^14 words that stay in the cache.
double bareAtomics(gpu::Device& device, bool floats, bool cached = false) {
    const std::int64_t voxels = cached ? 1 << 14 : std::int64_t{kVoxels} * kVoxels * kVoxels;
    const gpu::Program program(device, "bench/atomics.comp.glsl", {{"FLOATS", floats}});
    const glm::uvec4 values(1 << 20, kVoxels, static_cast<unsigned>(voxels - 1), kVoxels * kVoxels);
    const gpu::Buffer params(device, sizeof values, &values);
    gpu::Buffer sums(device, voxels * 4);
    sums.clear();
    params.bindUniform(0);
    sums.bindStorage(0);
    const double ms = timed(program, {1 << 20, 1, 1});
    return 1e3 * (1 << 20) * kVoxels / ms;
}

view::Params viewParams() {
    view::Params params;
    params.camera.eye = {0.2, 0.5, 3.2};
    params.camera.fov = 34;
    params.camera.width = kWidth;
    params.camera.rows = kHeight;
    return params;
}

} // namespace

Json measureKernels(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    std::vector<volume::Volume> volumes;
    volumes.push_back(ballVolume(kVoxels, false));
    const scene::Files scene(std::move(volumes));
    const view::Params params = viewParams();
    const view::Plan plan = view::makePlan(scene, params, false);
    const scene::Field field(device, plan.scene.index, plan.scene.layout, {});

    const volume::Volume hazy = ballVolume(kVoxels, true);
    lightsim::Params light;
    light.lights.push_back(lightsim::parseLight("directional:0.2,-1,0.1"));
    const lightsim::Plan lightPlan = lightsim::makePlan(hazy, light);

    std::vector<double> march, view, viewRatio, atomics, floatAtomics, cachedAtomics, photons,
        photonRatio, frame;
    for (int i = 0; i <= settings.repeats; ++i) {
        Stats seen, lit;
        march.push_back(bareMarch(device, field.texture()));
        view::render(device, plan, params, std::nullopt, seen, {});
        view.push_back(1e3 * seen.counter("steps") / passMs(seen, "view"));
        viewRatio.push_back(view.back() / march.back());
        atomics.push_back(bareAtomics(device, false));
        lightsim::simulate(device, lightPlan, light, lit, {});
        photons.push_back(1e3 * lit.counter("deposits") / passMs(lit, "photons"));
        photonRatio.push_back(photons.back() / atomics.back());
        cachedAtomics.push_back(bareAtomics(device, false, true));
        if (device.info().software) floatAtomics.push_back(bareAtomics(device, true));
        double total = passMs(seen, "view");
        for (const char* pass : {"photon emission", "photons", "resolve", "smooth"})
            total += passMs(lit, pass);
        frame.push_back(total);
        if (i > 0) continue; // the first round warms up
        for (auto* values : {&march, &view, &viewRatio, &atomics, &floatAtomics, &cachedAtomics,
                             &photons, &photonRatio, &frame})
            values->clear();
    }
    return {{"device", device.info().renderer},
            {"bare_march_steps_per_s", median(march)},
            {"view_steps_per_s", median(view)},
            {"view_to_bare", median(viewRatio)},
            {"bare_atomics_per_s", median(atomics)},
            {"bare_float_atomics_per_s", median(floatAtomics)},
            {"bare_cached_atomics_per_s", median(cachedAtomics)},
            {"photon_deposits_per_s", median(photons)},
            {"photons_to_bare", median(photonRatio)},
            {"relight_and_view_gpu_ms", median(frame)},
            {"gpu_peak_bytes", device.peakBytes()}};
}

} // namespace bench
