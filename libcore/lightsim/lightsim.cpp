// The light stage: photons through a scene volume, fluence and direction out (Sun et al. 2008).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/lightsim.h"

#include "base/error.h"
#include "lightsim/beams.h"
#include "lightsim/emission.h"
#include "lightsim/energy.h"
#include "lightsim/fronts.h"
#include "lightsim/octree.h"
#include "lightsim/photons.h"
#include "lightsim/receivers.h"
#include "optics/bands.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace eikonal::lightsim {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Times what `work` does on the device under that name.
template<typename Work> auto timed(gpu::Profiler& profiler, const char* name, const Work& work) {
    profiler.begin(name);
    auto result = work();
    profiler.end();
    return result;
}

/// A simulation: what it was asked, and what is on the device for its duration.
struct Run {
    gpu::Device& device;
    const Plan& plan;
    const Params& params;
    Stats& stats;
    gpu::Profiler& profiler;
    scene::Transport transport;
    Media media;
    gpu::Texture leaves;
    Receivers receivers;
    std::optional<Emission> emission; ///< and what else photons take
    std::optional<PhotonTracer> tracer;
    std::optional<EnergyMeter> meter;
    std::optional<Beams> beams;
    std::optional<Fronts> fronts;
    Photons photons{};
    unsigned batches = 0;  ///< begun so far
    glm::dvec4 dropped{0}; ///< power, see droppedPower()

    template<typename Work> auto pass(const char* name, const Work& work) {
        return timed(profiler, name, work);
    }
};

scene::StepLengths stepsOf(const Params& params) {
    const double longest = params.tracing.step > 0 ? params.tracing.step : 1e6;
    return {longest, 1e-3, longest, false};
}

gpu::Texture upload(gpu::Device& device, const Leaves& leaves) {
    gpu::Texture texture(device, leaves.pairs, gpu::TexelFormat::r32ui, gpu::Filter::nearest);
    texture.upload(leaves.packed.data());
    return texture;
}

Run begin(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats,
          gpu::Profiler& profiler) {
    const auto make = [&](const char* name, const auto& work) {
        return timed(profiler, name, work);
    };
    scene::Transport transport = make("medium", [&] {
        return scene::Transport(device, plan.scene, params.tracing, stepsOf(params));
    });
    Media media = make("medium", [&] { return Media(device, plan); });
    gpu::Texture leaves;
    if (plan.usesOctree())
        leaves = make("octree", [&] { return upload(device, makeLeaves(plan, params)); });
    Receivers receivers(device, plan, params, transport, media, profiler);
    return make("shaders", [&] {
        Run run{device,
                plan,
                params,
                stats,
                profiler,
                std::move(transport),
                std::move(media),
                std::move(leaves),
                std::move(receivers),
                {},
                {},
                {},
                {},
                {}};
        if (plan.photons) {
            run.emission.emplace(device, plan, params);
            run.tracer.emplace(device, plan, params);
            run.meter.emplace(device);
        }
        if (plan.beams) run.beams.emplace(device, plan, params);
        if (plan.wavefront) run.fronts.emplace(device, plan, params);
        return run;
    });
}

/// Traces the photons emitted to the end, or until few are left. Returns how many are.
std::uint32_t trace(Run& run, std::uint32_t emitted, double unit, const Progress& progress) {
    const auto few = static_cast<std::uint32_t>(run.params.thinTo * emitted);
    std::uint32_t count = emitted;
    run.receivers.bind();
    while (count > few) {
        count = run.tracer->run(run.device, run.transport, run.media, run.leaves, run.photons,
                                count, unit);
        report(progress, 1.0 - static_cast<double>(count) / emitted);
    }
    return count;
}

/// Sends a batch with this fixed-point unit. Returns whether every sum held it.
bool send(Run& run, const Light& light, const Batch& batch, double power, double unit,
          const Progress& progress) {
    const std::uint32_t emitted = run.pass("photon emission", [&] {
        return run.emission->emit(run.device, run.transport, batch, run.photons);
    });
    const auto sum = [&] { return run.meter->sum(run.transport, run.photons); };
    const BatchEnergy before = run.pass("energy", sum);
    const std::uint32_t left =
        run.pass("photons", [&] { return trace(run, emitted, unit, progress); });
    if (PhotonTracer::overflowed(run.photons)) return false;
    const BatchEnergy after = run.pass("energy", sum);
    book(run.stats, run.plan, light, power, before, after);
    run.dropped += droppedPower(light, power, after);
    if (run.plan.bends && run.params.tracing.integrator == optics::Integrator::adaptive)
        run.stats.raise("position_error_voxels", after.error);
    if (left > 0) run.stats.count("photons_left_by_thinning", left);
    run.profiler.begin("resolve");
    run.receivers.resolve(run.device, light.rgb, power, unit);
    run.profiler.end();
    return true;
}

/// A batch from its light to the receivers. Where a sum nears the end of its range it is sent again
/// with a smaller unit.
void sendBatch(Run& run, const Light& light, const Batch& batch, double power,
               const Progress& progress) {
    const double pixels = static_cast<double>(batch.window.pixels.x) * batch.window.pixels.y;
    if (pixels == 0) return;
    const double kLeast = 1.0 / 1024; // 2^32 voxel lengths of every photon: beyond any path
    for (double unit = unitFor(pixels); unit >= kLeast; unit /= 16) {
        if (send(run, light, batch, power, unit, progress)) return report(progress, 1.0);
        run.stats.count("batches_run_again", 1);
        run.receivers.clear();
    }
    throw InternalError("photons overflow a voxel's sum");
}

/// All photons of a light in voxel space.
void sendPhotons(Run& run, const Light& light, const Progress& progress) {
    const double total = light.rgb.x + light.rgb.y + light.rgb.z;
    const std::vector<Window> windows = run.emission->windowsOf(light, run.params);
    const double h = run.plan.scene.voxelSize();
    for (size_t w = 0; w < windows.size(); ++w) {
        // Radiant power per unit of the light's RGB in a photon of weight 1 [m² or sr].
        const double power = windows[w].pixelArea() * (windows[w].point ? 1.0 : h * h);
        const std::vector<Batch> batches = batchesOf(windows[w]);
        const double all = static_cast<double>(windows.size() * batches.size());
        for (size_t b = 0; b < batches.size(); ++b) {
            const double begun = static_cast<double>(w * batches.size() + b);
            run.tracer->begin(light.rgb / total, ++run.batches);
            sendBatch(run, light, batches[b], power,
                      partOf(progress, begun / all, (begun + 1) / all));
        }
    }
}

/// A batch of beams to the surfaces. Where a sum nears the end of its range it is sent again with a
/// smaller unit.
void sendBeams(Run& run, const Light& light, const Window& window, const Beams::Batch& batch,
               double power) {
    SurfaceReceiver& surfaces = run.receivers.surfaces();
    // A surface voxel gets 2^20 in the mean, if all light comes to surfaces. No one part is more
    // than what kNearFull leaves free.
    const double cells = static_cast<double>(window.pixels.x) * window.pixels.y;
    const double share = static_cast<double>(surfaces.count()) / cells;
    const double kLeast = 1.0 / 1024;
    for (double unit = std::exp2(std::min(24.0, std::floor(20 + std::log2(share)))); unit >= kLeast;
         unit /= 16) {
        BeamEnergy energy;
        const bool held =
            run.beams->carry(run.device, run.transport, run.media, run.leaves, surfaces, window,
                             batch, unit, energy, run.profiler, run.stats);
        if (held) {
            run.pass("collect", [&] {
                surfaces.collect(run.device, light.rgb, power, unit);
                return 0;
            });
            if (!run.plan.receivesInVolume())
                run.dropped += book(run.stats, run.plan, light, power, energy);
            return;
        }
        run.stats.count("batches_run_again", 1);
        surfaces.clearSums();
    }
    throw InternalError("beams overflow a surface voxel's sum");
}

/// All beams of a light in voxel space.
void sendBeams(Run& run, const Light& light, const Progress& progress) {
    const double h = run.plan.scene.voxelSize();
    const std::vector<Window> windows = run.beams->windowsOf(light);
    run.beams->begin(light.rgb / (light.rgb.x + light.rgb.y + light.rgb.z));
    for (size_t w = 0; w < windows.size(); ++w) {
        // Radiant power per unit of the light's RGB in a cell of weight 1 [m² or sr].
        const double power = windows[w].pixelArea() * (windows[w].point ? 1.0 : h * h);
        const std::vector<Beams::Batch> batches = Beams::batchesOf(windows[w]);
        const double all = static_cast<double>(windows.size() * batches.size());
        for (size_t b = 0; b < batches.size(); ++b) {
            const double begun = static_cast<double>(w * batches.size() + b);
            sendBeams(run, light, windows[w], batches[b], power);
            report(progress, (begun + 1) / all);
        }
    }
}

/// A part of a wavefront with this fixed-point unit. Returns whether every sum held it.
bool sendFront(Run& run, const Light& light, const FrontBatch& front, double power, double unit,
               const Progress& progress) {
    run.receivers.bind();
    BatchEnergy before, after;
    before.remaining = glm::dvec3(front.flux);
    if (!run.fronts->carry(run.device, run.transport, run.media, front, unit, after, run.profiler,
                           run.stats, progress))
        return false;
    book(run.stats, run.plan, light, power, before, after);
    run.dropped += droppedPower(light, power, after);
    run.pass("resolve", [&] {
        run.receivers.resolve(run.device, light.rgb, power, unit);
        return 0;
    });
    return true;
}

/// The wavefront of a light in voxel space. Where a sum nears the end of its range a part of it is
/// sent again with a smaller unit.
void sendFronts(Run& run, const Light& light, const Progress& progress) {
    const double h = run.plan.scene.voxelSize();
    const std::vector<FrontBatch> fronts = run.fronts->batchesOf(light);
    run.fronts->begin(light.rgb);
    for (size_t i = 0; i < fronts.size(); ++i) {
        const FrontBatch& front = fronts[i];
        const double power = front.power * (front.point ? 1.0 : h * h);
        const auto begun = static_cast<double>(i), all = static_cast<double>(fronts.size());
        const Progress part = partOf(progress, begun / all, (begun + 1) / all);
        const double kLeast = 1.0 / 1024;
        double unit = unitFor(std::max(front.flux, 1.0));
        while (unit >= kLeast && !sendFront(run, light, front, power, unit, part)) {
            run.stats.count("batches_run_again", 1);
            run.receivers.clear();
            unit /= 16;
        }
        if (unit < kLeast) throw InternalError("a wavefront overflows a voxel's sum");
    }
}

void sendLight(Run& run, const Light& light, const Progress& progress) {
    if (light.rgb.x + light.rgb.y + light.rgb.z <= 0) return;
    if (light.kind == Light::Kind::point)
        for (size_t c = 0; c < 3; ++c)
            run.stats.energy.emitted[c] += 4 * kPi * light.rgb[static_cast<int>(c)];
    const bool volume = run.plan.receivesInVolume();
    const double split = volume && run.plan.beams ? 0.5 : run.plan.beams ? 1.0 : 0.0;
    if (run.plan.beams && run.receivers.surfaces().count() > 0)
        sendBeams(run, light, partOf(progress, 0, split));
    if (run.plan.photons) sendPhotons(run, light, partOf(progress, split, 1));
    if (run.plan.wavefront) sendFronts(run, light, partOf(progress, split, 1));
}

} // namespace

Result simulate(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats,
                const Progress& progress) {
    device.requireFit(needsOf(plan, params));
    gpu::Profiler profiler(stats);
    stats.hasEnergy = true;
    Run run = begin(device, plan, params, stats, profiler);
    const std::vector<optics::Band> bands = optics::wholeLight();
    const glm::dmat4 voxelFromWorld = plan.scene.voxelFromWorld();
    const double parts = static_cast<double>(bands.size() * params.lights.size());
    double done = 0;
    for (const Light& light : params.lights) {
        for (const optics::Band& band : bands) {
            Light part = inVoxels(light, voxelFromWorld);
            part.rgb *= band.weight;
            sendLight(run, part, partOf(progress, 0.95 * done / parts, 0.95 * (done + 1) / parts));
            ++done;
        }
        if (params.lightsApart && !plan.points.empty()) run.receivers.readPoints(device, plan);
    }
    tellDropped(stats, run.dropped);
    profiler.collect();
    Result result = run.receivers.finish(device, plan, params, stats);
    report(progress, 1.0);
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return result;
}

} // namespace eikonal::lightsim
