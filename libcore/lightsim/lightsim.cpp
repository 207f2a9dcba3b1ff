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
    std::optional<Emission> emission;            ///< and what else photons take
    std::optional<PhotonTracer> tracer, bouncer; ///< of light as it comes, and reflected
    std::optional<EnergyMeter> meter;
    std::optional<Beams> beams;
    std::optional<Fronts> fronts;
    Photons photons{};
    std::vector<optics::Band> bands{};
    unsigned batches = 0;  ///< begun so far
    glm::dvec4 dropped{0}; ///< power, see droppedPower()
    double left = 0;       ///< the same, see leftPower()

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
                {},
                {}};
        if (plan.sendsPhotons()) {
            run.emission.emplace(device, plan, params);
            run.meter.emplace(device);
        }
        if (plan.photons) run.tracer.emplace(device, plan, params, false);
        if (plan.bounces > 0) run.bouncer.emplace(device, plan, params, true);
        if (plan.beams) run.beams.emplace(device, plan, params);
        if (plan.wavefront) run.fronts.emplace(device, plan, params);
        return run;
    });
}

/// What a band has of a unit of white light.
Unit ofBand(Unit unit, const optics::Band& band) {
    unit.colour = unit.rgb / (unit.rgb.x + unit.rgb.y + unit.rgb.z);
    unit.rgb *= band.middle.weight;
    return unit;
}

/// Fronts are of the band's middle wavelength alone, photons of all about it; beams take both.
void takeMiddle(Run& run, const optics::Band& band) {
    run.transport.setLines(std::vector<optics::Line>(optics::kLinesPerBand, band.middle));
}

void takeSpread(Run& run, const optics::Band& band) {
    std::vector<optics::Line> lines;
    for (const double wavelength : band.spread) lines.push_back({wavelength, glm::dvec3(1)});
    run.transport.setLines(lines);
}

/// Traces the photons emitted to the end, or until few are left. Returns how many are.
std::uint32_t trace(Run& run, bool bounced, std::uint32_t emitted, double unit,
                    const Progress& progress) {
    const auto few = static_cast<std::uint32_t>(run.params.thinTo * emitted);
    std::uint32_t count = emitted;
    run.receivers.bind();
    PhotonTracer& tracer = bounced ? *run.bouncer : *run.tracer;
    while (count > few) {
        count =
            tracer.run(run.device, run.transport, run.media, run.leaves, run.photons, count, unit);
        report(progress, 1.0 - static_cast<double>(count) / emitted);
    }
    return count;
}

/// Sends a batch with this fixed-point unit. Returns whether every sum held it.
bool send(Run& run, const Batch& batch, bool bounced, double unit, const Progress& progress) {
    const std::uint32_t emitted = run.pass("photon emission", [&] {
        return run.emission->emit(run.device, run.transport, batch, run.photons);
    });
    const auto sum = [&] { return run.meter->sum(run.transport, run.photons); };
    const BatchEnergy before = run.pass("energy", sum);
    const std::uint32_t left = run.pass(bounced ? "bounced photons" : "photons", [&] {
        return trace(run, bounced, emitted, unit, progress);
    });
    if (PhotonTracer::overflowed(run.photons)) return false;
    const BatchEnergy after = run.pass("energy", sum);
    if (bounced || run.plan.bounces == 0) { // else those that follow it book the same light
        book(run.stats, run.plan, batch.unit, before, after);
        run.dropped += droppedPower(batch.unit, after);
        run.left += leftPower(batch.unit, after);
    }
    if (run.plan.bends && run.params.tracing.integrator == optics::Integrator::adaptive)
        run.stats.raise("position_error_voxels", after.error);
    if (left > 0) run.stats.count("photons_left_by_thinning", left);
    run.profiler.begin("resolve");
    run.receivers.resolve(run.device, batch.unit, unit, bounced);
    run.profiler.end();
    return true;
}

/// A batch from its light to the receivers. Where a sum nears the end of its range it is sent again
/// with a smaller unit.
void sendBatch(Run& run, const Batch& batch, bool bounced, const Progress& progress) {
    const double kLeast = 1.0 / 1024; // 2^32 voxel lengths of every photon: beyond any path
    for (double unit = unitFor(static_cast<double>(batch.pixels())); unit >= kLeast; unit /= 16) {
        if (send(run, batch, bounced, unit, progress)) return report(progress, 1.0);
        run.stats.count("batches_run_again", 1);
        run.receivers.clear();
    }
    throw InternalError("photons overflow a voxel's sum");
}

/// Light that meets nothing, of a window of whose batches this is the first.
void addPlain(Run& run, const Batch& batch, const optics::Band& band) {
    const Part& part = batch.parts.front();
    if (!part.aimed || part.place.x != 0 || part.place.y != 0) return;
    run.pass("light that meets nothing", [&] {
        run.emission->bindPlain(*part.aimed);
        const Source& source = part.window.source;
        run.receivers.voxels().addPlain(run.device, run.plan, source.rgb * band.middle.weight,
                                        source.isPoint());
        return 0;
    });
}

/// All photons of a band of a light that these stand for. Bounced, they leave light only behind the
/// first opaque surface that they meet.
void sendPhotons(Run& run, const std::vector<Source>& sources, const optics::Band& band,
                 bool bounced, const Progress& progress) {
    // What bounces is shared out over more than a voxel.
    const double receivers = bounced                       ? 0.5
                             : run.plan.receivesInVolume() ? 1
                                                           : run.plan.surfaces.detail;
    // Surfaces get light where it lands, not along its way: photons bring them all of it.
    const bool aimed =
        !bounced && run.plan.receivesInVolume() && (run.plan.surfaces.empty() || run.plan.beams);
    std::vector<Batch> batches = run.emission->batchesOf(sources, run.params, receivers, aimed);
    PhotonTracer& tracer = bounced ? *run.bouncer : *run.tracer;
    const auto all = static_cast<double>(batches.size());
    for (size_t b = 0; b < batches.size(); ++b) {
        batches[b].unit = ofBand(batches[b].unit, band);
        tracer.begin(batches[b].unit.colour, ++run.batches);
        const auto begun = static_cast<double>(b);
        sendBatch(run, batches[b], bounced, partOf(progress, begun / all, (begun + 1) / all));
        addPlain(run, batches[b], band);
    }
}

/// A batch of beams to the surfaces. Where a sum nears the end of its range it is sent again with a
/// smaller unit.
void sendBeams(Run& run, const Window& window, const Beams::Batch& batch, const Unit& of) {
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
                surfaces.collect(run.device, of.rgb, of.power, unit);
                return 0;
            });
            if (!run.plan.receivesInVolume() && !run.plan.sendsPhotons())
                run.dropped += book(run.stats, run.plan, of, energy);
            return;
        }
        run.stats.count("batches_run_again", 1);
        surfaces.clearSums();
    }
    throw InternalError("beams overflow a surface voxel's sum");
}

/// All beams of a band of a source, of so many that stand for a light.
void sendBeams(Run& run, const Source& source, const optics::Band& band, size_t sources,
               const Progress& progress) {
    const double h = run.plan.scene.voxelSize();
    const std::vector<Window> windows = run.beams->windowsOf(source, sources);
    run.beams->begin(source.rgb / (source.rgb.x + source.rgb.y + source.rgb.z), band);
    for (size_t w = 0; w < windows.size(); ++w) {
        const Unit whole{source.rgb, windows[w].pixelArea() * (source.isPoint() ? 1.0 : h * h),
                         source.isPoint()};
        const Unit unit = ofBand(whole, band);
        const std::vector<Beams::Batch> batches = Beams::batchesOf(windows[w]);
        const double all = static_cast<double>(windows.size() * batches.size());
        for (size_t b = 0; b < batches.size(); ++b) {
            const double begun = static_cast<double>(w * batches.size() + b);
            sendBeams(run, windows[w], batches[b], unit);
            report(progress, (begun + 1) / all);
        }
    }
}

/// A part of a wavefront with this fixed-point unit. Returns whether every sum held it.
bool sendFront(Run& run, const FrontBatch& front, const Unit& of, double unit,
               const Progress& progress) {
    run.receivers.bind();
    BatchEnergy before, after;
    before.remaining = glm::dvec3(front.flux);
    if (!run.fronts->carry(run.device, run.transport, run.media, front, unit, after, run.profiler,
                           run.stats, progress))
        return false;
    if (run.plan.bounces == 0) {
        book(run.stats, run.plan, of, before, after);
        run.dropped += droppedPower(of, after);
    }
    run.pass("resolve", [&] {
        run.receivers.resolve(run.device, of, unit, false);
        return 0;
    });
    return true;
}

/// The wavefront of a band of a source. Where a sum nears the end of its range a part of it is sent
/// again with a smaller unit.
void sendFronts(Run& run, const Source& source, const optics::Band& band,
                const Progress& progress) {
    const double h = run.plan.scene.voxelSize();
    const std::vector<FrontBatch> fronts = run.fronts->batchesOf(source, band.middle.wavelength);
    run.fronts->begin(source.rgb);
    for (size_t i = 0; i < fronts.size(); ++i) {
        const FrontBatch& front = fronts[i];
        const Unit of =
            ofBand({source.rgb, front.power * (front.point ? 1.0 : h * h), front.point}, band);
        const auto begun = static_cast<double>(i), all = static_cast<double>(fronts.size());
        const Progress part = partOf(progress, begun / all, (begun + 1) / all);
        const double kLeast = 1.0 / 1024;
        double unit = unitFor(std::max(front.flux, 1.0));
        while (unit >= kLeast && !sendFront(run, front, of, unit, part)) {
            run.stats.count("batches_run_again", 1);
            run.receivers.clear();
            unit /= 16;
        }
        if (unit < kLeast) throw InternalError("a wavefront overflows a voxel's sum");
    }
}

/// All of a light that these stand for, one by one.
template<typename Send>
void sendEach(const std::vector<Source>& sources, const Progress& progress, const Send& send) {
    const auto all = static_cast<double>(sources.size());
    for (size_t k = 0; k < sources.size(); ++k) {
        const auto begun = static_cast<double>(k);
        send(sources[k], partOf(progress, begun / all, (begun + 1) / all));
    }
}

void sendLight(Run& run, const Light& light, const Progress& progress) {
    if (light.rgb.x + light.rgb.y + light.rgb.z <= 0) return;
    if (light.hasPlace())
        for (size_t c = 0; c < 3; ++c)
            run.stats.energy.emitted[c] += powerOf(light)[static_cast<int>(c)];
    const auto sources = [&](Method method) {
        const Keep keep = run.plan.receivesInVolume() && method != Method::beams ? Keep::fluence
                                                                                 : Keep::irradiance;
        return sourcesOf(light, samplesFor(run.plan, run.params, light, method), keep,
                         run.plan.scene.voxelFromWorld());
    };
    const bool beams = run.plan.beams && run.receivers.surfaces().count() > 0;
    const int passes = beams + run.plan.photons + run.plan.wavefront + (run.plan.bounces > 0);
    int done = 0;
    const auto next = [&] {
        const double begun = done++;
        return partOf(progress, begun / passes, (begun + 1) / passes);
    };
    const auto eachBand = [&](const Progress& part, const auto& send) {
        const auto count = static_cast<double>(run.bands.size());
        for (size_t b = 0; b < run.bands.size(); ++b) {
            const auto begun = static_cast<double>(b);
            send(run.bands[b], partOf(part, begun / count, (begun + 1) / count));
        }
    };
    if (beams) {
        const std::vector<Source> all = sources(Method::beams);
        eachBand(next(), [&](const optics::Band& band, const Progress& rest) {
            sendEach(all, rest, [&](const Source& source, const Progress& part) {
                sendBeams(run, source, band, all.size(), part);
            });
        });
    }
    if (run.plan.wavefront) {
        const std::vector<Source> all = sources(Method::wavefront);
        eachBand(next(), [&](const optics::Band& band, const Progress& rest) {
            takeMiddle(run, band);
            sendEach(all, rest, [&](const Source& source, const Progress& part) {
                sendFronts(run, source, band, part);
            });
        });
    }
    if (!run.plan.sendsPhotons()) return;
    const std::vector<Source> all = sources(Method::photons);
    for (const bool bounced : {false, true}) {
        if (bounced ? run.plan.bounces == 0 : !run.plan.photons) continue;
        eachBand(next(), [&](const optics::Band& band, const Progress& part) {
            takeSpread(run, band);
            sendPhotons(run, all, band, bounced, part);
        });
    }
}

} // namespace

Result simulate(gpu::Device& device, const Plan& plan, const Params& params, Stats& stats,
                const Progress& progress, const TakeLight& take) {
    device.requireFit(needsOf(plan, params));
    gpu::Profiler profiler(stats);
    stats.hasEnergy = true;
    Run run = begin(device, plan, params, stats, profiler);
    const bool apart = params.lightsApart && plan.points.empty();
    run.bands = optics::bandsOf(params.tracing.wavelengths, plan.scene.disperses);
    const auto parts = static_cast<double>(params.lights.size());
    Result sum;
    for (size_t k = 0; k < params.lights.size(); ++k) {
        const auto done = static_cast<double>(k);
        sendLight(run, params.lights[k],
                  partOf(progress, 0.95 * done / parts, 0.95 * (done + 1) / parts));
        if (params.lightsApart && !apart) run.receivers.readPoints(device, plan);
        if (!apart) continue;
        const Result light = run.receivers.finish(device, plan, params, stats);
        take(k, light);
        add(sum, light);
        if (k + 1 < params.lights.size()) run.receivers.renew(device, plan, params);
    }
    tellDropped(stats, run.dropped);
    if (plan.bounces > 0) tellLeft(stats, run.left);
    profiler.collect();
    Result result = apart ? std::move(sum) : run.receivers.finish(device, plan, params, stats);
    report(progress, 1.0);
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return result;
}

} // namespace eikonal::lightsim
