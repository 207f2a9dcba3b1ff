// Photons through a blurred ball in haze, against converged runs of our own.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "light.h"

#include "base/text.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace accuracy {

using namespace eikonal;

namespace {

constexpr int kVoxels = 64;
constexpr double kUnits = 64; // of the box

/// The knobs of a row; photons beside them.
struct Knobs {
    Setting trace = fixed("verlet", "linear", 0);
    double tolerance = 0.005, secondTolerance = 0.02, stepMin = 1;
    int smoothing = 0;

    Json key() const {
        Json key = trace.key();
        key["eps"] = tolerance;
        key["eps2"] = secondTolerance;
        key["step_min"] = stepMin;
        key["smoothing"] = smoothing;
        return key;
    }
};

/// Steps of a quarter voxel everywhere, through a spline.
Knobs converged() {
    return {.trace = fixed("sharma", "cubic", 0),
            .tolerance = 0,
            .secondTolerance = 0,
            .stepMin = 0.25};
}

lightsim::Params paramsOf(const Knobs& knobs, std::int64_t photons, std::uint32_t seed) {
    lightsim::Params params = lightParams(slantingLight(), photons);
    params.tracing = knobs.trace.tracing;
    params.octreeTolerance = knobs.tolerance;
    params.octreeTolerance2 = knobs.secondTolerance;
    params.stepMin = knobs.stepMin;
    params.smoothing = knobs.smoothing;
    params.seed = seed;
    return params;
}

const volume::Volume& scene() {
    static const volume::Volume volume = hazyBall(kVoxels, 1.5, true).take();
    return volume;
}

std::vector<float> reference(Bench& bench, const Knobs& knobs, std::int64_t photons,
                             std::uint32_t seed) {
    Json key{{"part", "light"}, {"photons", photons}, {"seed", seed}};
    key.update(knobs.key());
    key.update(bench.version);
    return kept(bench.work, key,
                [&] { return light(bench, scene(), paramsOf(knobs, photons, seed)).fluence; });
}

std::int64_t mostPhotons(const Bench& bench) {
    return bench.full ? 1 << 22 : 1 << 19;
}

/// `error` is the whole error, `step_error` that of the steps alone: the same photons, traced
/// better; `noise` that of the photons alone: the same steps, many photons.
Json measure(Bench& bench, const Knobs& knobs, std::int64_t photons, bool knobOnly) {
    Knobs exact = converged();
    Json values;
    std::vector<double> ms;
    Lit lit;
    const int repeats = photons > 1 << 20 ? 1 : 3;
    for (int i = 0; i < repeats; ++i) {
        lit = light(bench, scene(), paramsOf(knobs, photons, 0));
        ms.push_back(lit.ms);
    }
    values["ms"] = median(ms);
    values["steps"] = lit.steps;
    values["error"] = relativeRms(lit.fluence, reference(bench, exact, mostPhotons(bench) / 4, 1));
    if (knobOnly)
        values["step_error"] = relativeRms(lit.fluence, reference(bench, exact, photons, 0));
    else
        values["noise"] = relativeRms(lit.fluence, reference(bench, knobs, mostPhotons(bench), 1));
    return values;
}

struct Named {
    std::string name;
    Knobs knobs;
};

std::vector<Named> knobRows(bool full) {
    std::vector<Named> all;
    const auto add = [&](const std::string& name, const Knobs& knobs) {
        all.push_back({name, knobs});
    };
    add("default", {});
    add("--integrator euler, plain samples", {.trace = fixed("euler", "linear", 0, true)});
    add("--interpolation cubic", {.trace = fixed("verlet", "cubic", 0)});
    add("--integrator sharma", {.trace = fixed("sharma", "cubic", 0)});
    add("--integrator rk4", {.trace = fixed("rk4", "cubic", 0)});
    for (const double tolerance : {0.1, 0.01, 0.001})
        if (full || tolerance == 0.01)
            add("--tolerance " + toText(tolerance), {.trace = adaptive(tolerance)});
    for (const double stepMin : {0.25, 0.5, 2.0, 4.0})
        if (full || stepMin == 0.5 || stepMin == 2)
            add("--step-min " + toText(stepMin), {.stepMin = stepMin});
    const std::pair<double, double> pairs[] = {
        {0, 0}, {0.0005, 0.002}, {0.002, 0.01}, {0.02, 0.05}, {0.05, 0.2}};
    for (const auto& [first, second] : pairs)
        if (full || first != 0.002)
            add("--octree-tolerance " + toText(first) + " --octree-tolerance2 " + toText(second),
                {.tolerance = first, .secondTolerance = second});
    if (full) {
        add("--step-min 0.5 --interpolation cubic",
            {.trace = fixed("verlet", "cubic", 0), .stepMin = 0.5});
        add("--step-min 0.5 --integrator sharma",
            {.trace = fixed("sharma", "cubic", 0), .stepMin = 0.5});
    }
    for (const int rounds : {1, 2})
        add("--smoothing " + std::to_string(rounds), {.smoothing = rounds});
    return all;
}

/// Settings whose photons are numbered, too: the frontier of light.
std::vector<Named> frontierRows() {
    return {{"sources' scheme", {.trace = fixed("euler", "linear", 0, true)}},
            {"default", {}},
            {"--step-min 0.5", {.stepMin = 0.5}},
            {"--integrator sharma", {.trace = fixed("sharma", "cubic", 0)}}};
}

} // namespace

lightsim::Light slantingLight() {
    return {lightsim::Light::Kind::directional, glm::normalize(dvec3(0.2, -1, 0.1)), dvec3(1)};
}

const dvec3& ballCentre() {
    static const dvec3 centre(32, 38, 32);
    return centre;
}

TestVolume hazyBall(int voxels, double sigma, bool haze) {
    const double h = kUnits / voxels;
    TestVolume volume(glm::ivec3(voxels), h);
    const judge::Medium ball = judge::blob(ballCentre(), 16, sigma * h, 1.5);
    volume.index(ball.index);
    if (haze)
        volume.addVector("scattering",
                         [=](dvec3 p) { return dvec3(0.02 * (1.5 - ball.index(p))); });
    return volume;
}

lightsim::Params lightParams(const lightsim::Light& light, std::int64_t photons) {
    lightsim::Params params;
    params.lights = {light};
    params.photons = photons;
    params.smoothing = 0;
    params.automaticOutputs = false;
    params.outputs = lightsim::Output::fluence;
    return params;
}

Lit light(Bench& bench, const volume::Volume& volume, const lightsim::Params& params) {
    params.check();
    Stats stats;
    const lightsim::Result result = lightsim::simulate(bench.device, lightsim::makePlan(volume, params), params, stats, {});
    Lit lit;
    forEachVoxel(volume.domain().size(), [&](const glm::ivec3& p) {
        lit.fluence.push_back(result.fluence.at(p));
    });
    for (const PassTime& pass : stats.passes)
        for (const char* name : {"photon birth", "photons", "resolve", "smooth"})
            if (pass.name == name) lit.ms += pass.gpuMs;
    for (const auto& [name, value] : stats.counters)
        if (name == "steps") lit.steps = value;
    return lit;
}

double relativeRms(const std::vector<float>& found, const std::vector<float>& wanted,
                   const std::function<bool(size_t)>& counts) {
    double squares = 0, sum = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (counts && !counts(i)) continue;
        const double a = found[i], b = wanted[i];
        squares += (a - b) * (a - b);
        sum += b * b;
    }
    return std::sqrt(squares / sum);
}

std::vector<Task> lightTasks(Bench& bench) {
    std::vector<Task> tasks;
    const auto add = [&](const Named& named, std::int64_t photons, bool knobOnly) {
        Json key{{"part", knobOnly ? "light" : "photons"}, {"photons", photons}};
        key.update(named.knobs.key());
        key["most"] = mostPhotons(bench);
        key.update(bench.version);
        tasks.push_back({key, named.name + ", " + std::to_string(photons) + " photons",
                         [&bench, knobs = named.knobs, photons, knobOnly] {
                             Json values = measure(bench, knobs, photons, knobOnly);
                             return values;
                         }});
    };
    for (const Named& named : knobRows(bench.full))
        add(named, bench.full ? 1 << 18 : 1 << 16, true);
    const int from = 12, to = bench.full ? 20 : 16;
    for (const Named& named : frontierRows())
        for (int power = from; power <= to; power += 2) add(named, std::int64_t{1} << power, false);
    addTruthTasks(bench, tasks);
    return tasks;
}

} // namespace accuracy
