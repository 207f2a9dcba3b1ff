// Pictures of exits, their distance from the judge's, and the time of larger pictures.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rays.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace accuracy {

using namespace eikonal;
using optics::Integrator;
using optics::Interpolation;

namespace {

constexpr int kRepeats = 3;

double counter(const Stats& stats, const std::string& name) {
    for (const auto& [known, value] : stats.counters)
        if (known == name) return value;
    return 0;
}

double passMs(const Stats& stats, const std::string& name) {
    for (const PassTime& pass : stats.passes)
        if (pass.name == name) return pass.gpuMs;
    return 0;
}

view::Params paramsOf(const view::Camera& camera, const Setting& setting) {
    view::Params params;
    static_cast<optics::Tracing&>(params) = setting.tracing;
    params.camera = camera;
    params.maxDepth = setting.maxDepth;
    return params;
}

/// Edge of the picture that is timed: large enough that what a dispatch costs by itself hardly
/// counts.
int pixelsToTime(const Bench& bench) {
    return bench.full ? 384 : 128;
}

/// Errors of one setting in one field, and its time beside that of the sources' scheme.
Json measure(Bench& bench, const Field& field, int voxels, const Setting& setting, bool timed) {
    const Stage& stage = stageOf(field, voxels);
    const Ends found = stage.ends(bench, cameraOf(field, kErrorPixels), setting);
    const Deviation off = deviation(found, truthOf(field, kErrorPixels));
    Json values{{"rms", off.rms},           {"worst", off.worst},
                {"mrad", off.mrad},         {"optical", off.optical},
                {"trapped", found.trapped}, {"steps_per_ray", found.steps / found.rays}};
    if (setting.tracing.integrator == Integrator::adaptive) values["noted"] = found.noted;
    if (!timed) return values;
    const view::Camera camera = cameraOf(field, pixelsToTime(bench));
    std::vector<double> ms, base, ratio;
    for (int i = 0; i < kRepeats; ++i) {
        base.push_back(stage.time(bench, camera, sources()));
        ms.push_back(stage.time(bench, camera, setting));
        ratio.push_back(ms.back() / base.back());
    }
    values["ms"] = median(ms);
    values["base_ms"] = median(base);
    values["time_ratio"] = median(ratio);
    return values;
}

std::vector<Setting> settingsOf(bool full) {
    std::vector<Setting> all{sources(), usual()};
    const auto add = [&](const std::string& integrator, const std::string& interpolation,
                         std::vector<double> steps, bool plain = false) {
        for (const double step : steps) {
            const Setting next = fixed(integrator, interpolation, step, plain);
            const auto same = [&](const Setting& other) { return other.name() == next.name(); };
            if (std::none_of(all.begin(), all.end(), same)) all.push_back(next);
        }
    };
    if (full) {
        add("euler", "linear", {0.25, 0.5, 2, 4, 8});
        add("verlet", "linear", {0.25, 0.5, 1, 1.5, 2, 3, 4, 8});
        add("verlet", "linear", {0.25, 0.5, 1, 2, 4, 8}, true);
        add("euler", "cubic", {1});
        add("verlet", "cubic", {1.5, 3});
        for (const char* name : {"verlet", "sharma", "rk4"})
            add(name, "cubic", {0.25, 0.5, 1, 2, 4, 8});
        add("sharma", "linear", {0.5, 1, 2});
        add("rk4", "linear", {1});
        for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) all.push_back(adaptive(tolerance));
        for (const double step : {2.0, 8.0, 16.0}) all.push_back(adaptive(0.01, step));
        for (const double tolerance : {0.1, 0.01}) all.push_back(adaptive(tolerance, 0, "linear"));
    } else {
        add("verlet", "linear", {0.5, 1, 1.5, 2, 4});
        add("verlet", "linear", {1}, true);
        add("verlet", "cubic", {1, 2, 3, 4});
        add("sharma", "cubic", {2, 4});
        for (const double tolerance : {0.1, 0.01}) all.push_back(adaptive(tolerance));
    }
    return all;
}

/// What is worth knowing where the field has an edge.
std::vector<Setting> fewSettings(bool full) {
    std::vector<Setting> all{sources(), usual(), fixed("verlet", "cubic", 1)};
    if (full)
        for (const Setting& more :
             {fixed("verlet", "linear", 0.5), fixed("sharma", "cubic", 0.5), adaptive(0.01)})
            all.push_back(more);
    return all;
}

} // namespace

std::string Setting::name() const {
    const std::string samples =
        tracing.plainSamples && tracing.integrator != Integrator::euler ? " plain" : "";
    std::string text = optics::integratorNames()[static_cast<size_t>(tracing.integrator)] +
                       samples +
                       (tracing.sampling() == Interpolation::cubic ? " cubic" : " linear");
    if (tracing.integrator == Integrator::adaptive) text += " to " + toText(tracing.tolerance);
    if (tracing.integrator != Integrator::adaptive || tracing.step > 0)
        text += " step " + toText(tracing.step);
    return text;
}

Json Setting::key() const {
    Json key{{"integrator", optics::integratorNames()[static_cast<size_t>(tracing.integrator)]},
             {"interpolation", tracing.sampling() == Interpolation::cubic ? "cubic" : "linear"},
             {"plain", tracing.plainSamples},
             {"step", tracing.step}};
    if (tracing.integrator == Integrator::adaptive) key["tolerance"] = tracing.tolerance;
    return key;
}

Setting fixed(const std::string& integrator, const std::string& interpolation, double step,
              bool plainSamples) {
    Setting result;
    result.tracing.integrator = optics::parseIntegrator(integrator);
    result.tracing.interpolation = optics::parseInterpolation(interpolation);
    result.tracing.step = step;
    result.tracing.plainSamples = plainSamples;
    return result;
}

Setting adaptive(double tolerance, double step, const std::string& interpolation) {
    Setting result = fixed("adaptive", interpolation, step);
    result.tracing.tolerance = tolerance;
    return result;
}

Setting sources() {
    return fixed("euler", "linear", 1, true);
}

Setting usual() {
    Setting result;
    result.tracing.step = result.tracing.usualStep();
    return result;
}

Stage::Stage(scene::Files scene)
    : mScene(std::move(scene)), mPlan(view::makePlan(mScene, view::Params{}, false)) {}

Ends Stage::ends(Bench& bench, const view::Camera& camera, const Setting& setting,
                 int maxSteps) const {
    view::Params params = paramsOf(camera, setting);
    params.maxSteps = maxSteps;
    params.aovs = {"exit_position", "exit_direction", "optical_path_length", "error"};
    params.check();
    Stats stats;
    const image::Image picture = view::render(bench.device, mPlan, params, std::nullopt, stats, {});
    const auto plane = [&](const std::string& name) { return picture.plane(*picture.find(name)); };
    const auto vectors = [&](const std::string& name) {
        const auto x = plane(name + ".X"), y = plane(name + ".Y"), z = plane(name + ".Z");
        std::vector<dvec3> all;
        for (size_t i = 0; i < x.size(); ++i) all.emplace_back(x[i], y[i], z[i]);
        return all;
    };
    Ends ends;
    ends.place = vectors("exit_position");
    ends.direction = vectors("exit_direction");
    for (const float length : plane("optical_path_length.V")) ends.optical.push_back(length);
    for (const float drift : plane("error.V")) ends.drift.push_back(drift);
    ends.viewMs = passMs(stats, "view");
    ends.steps = counter(stats, "steps");
    ends.rays = counter(stats, "rays");
    ends.trapped = counter(stats, "trapped");
    ends.noted = counter(stats, "position_error_voxels");
    return ends;
}

double Stage::time(Bench& bench, const view::Camera& camera, const Setting& setting) const {
    Stats stats;
    view::render(bench.device, mPlan, paramsOf(camera, setting), std::nullopt, stats, {});
    return passMs(stats, "view");
}

const Stage& stageOf(const Field& field, int voxels) {
    static std::pair<std::string, std::unique_ptr<Stage>> last;
    const std::string wanted = field.name + " " + std::to_string(voxels);
    if (last.first != wanted) {
        last.second.reset(); // its memory first
        last = {wanted,
                std::make_unique<Stage>(sceneOf(field.index, glm::ivec3(voxels), kBox / voxels))};
    }
    return *last.second;
}

Deviation deviation(const Ends& found, const Ends& wanted) {
    Deviation off;
    double place = 0, direction = 0, optical = 0;
    const size_t count = wanted.place.size();
    for (size_t i = 0; i < count; ++i) {
        const double d = glm::length(found.place[i] - wanted.place[i]);
        place += d * d;
        off.worst = std::max(off.worst, d);
        direction += std::pow(glm::length(found.direction[i] - wanted.direction[i]), 2);
        optical += std::pow(found.optical[i] - wanted.optical[i], 2);
    }
    const double share = 1 / static_cast<double>(count);
    off.rms = std::sqrt(place * share);
    off.mrad = 1e3 * std::sqrt(direction * share);
    off.optical = std::sqrt(optical * share);
    return off;
}

const Ends& truthOf(const Field& field, int pixels) {
    static std::map<std::pair<std::string, int>, Ends> known;
    Ends& ends = known[{field.name, pixels}];
    if (!ends.place.empty()) return ends;
    for (const judge::Ray& ray : raysOf(cameraOf(field, pixels))) {
        const judge::Exit exit = judge::trace(field.medium, ray, dvec3(0), dvec3(kBox));
        ends.place.push_back(exit.x);
        ends.direction.push_back(exit.direction);
        ends.optical.push_back(exit.opticalLength);
    }
    return ends;
}

std::vector<Task> rayTasks(Bench& bench) {
    std::vector<Task> tasks;
    const auto add = [&](const Field& field, int voxels, const Setting& setting, bool timed) {
        Json key{{"part", timed ? "rays" : "voxels"}, {"field", field.name}, {"voxels", voxels}};
        key.update(setting.key());
        key["pixels"] = pixelsToTime(bench);
        key.update(bench.version);
        tasks.push_back({key,
                         setting.name() + " on " + field.name +
                             (timed ? "" : ", " + std::to_string(voxels) + " voxels"),
                         [&bench, &field, voxels, setting, timed] {
                             return measure(bench, field, voxels, setting, timed);
                         }});
    };
    for (const Field& field : fields())
        for (const Setting& setting :
             field.smooth ? settingsOf(bench.full) : fewSettings(bench.full))
            add(field, 128, setting, true);
    std::vector<int> sizes{16, 32, 64, 128};
    if (bench.full) sizes.push_back(256);
    for (const Field& field : fields())
        for (const int voxels : sizes)
            for (const Setting& setting : {sources(), usual(), fixed("verlet", "linear", 0.25),
                                           fixed("sharma", "cubic", 0.5)})
                if (field.smooth || bench.full) add(field, voxels, setting, false);
    return tasks;
}

} // namespace accuracy
