// Orders of convergence in the step, and orbits of many turns.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "rays.h"

#include "judge/closed.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace accuracy {

using namespace eikonal;
using std::numbers::pi;

namespace {

/// Errors against the same voxels at short steps, so that only the step is judged. Shorter ones
/// would add roundings, and nothing else.
Json stepErrors(Bench& bench, const Field& field, const std::string& integrator,
                const std::string& interpolation, bool plain) {
    const Stage& stage = stageOf(field, 128);
    const view::Camera camera = cameraOf(field, kErrorPixels);
    // Linear samples of Verlet's are its own; all look-ups of one spline are alike.
    const Setting finest = interpolation == "cubic" ? fixed("rk4", "cubic", 0.5)
                                                    : fixed(integrator, interpolation, 0.25, plain);
    const Ends wanted = stage.ends(bench, camera, finest);
    Json steps = Json::array(), errors = Json::array();
    for (int half = 8; half >= 0; --half) { // half octaves from 16 voxels
        const double step = std::exp2(0.5 * half);
        const Ends found = stage.ends(bench, camera, fixed(integrator, interpolation, step, plain));
        steps.push_back(step);
        errors.push_back(deviation(found, wanted).rms);
    }
    return {{"steps", steps}, {"errors", errors}};
}

/// What tolerances ask for and what they reach, against the same voxels; `noted` is the worst error
/// that the tracer itself reckons with.
Json reachOf(Bench& bench, const Field& field) {
    const Stage& stage = stageOf(field, 128);
    const view::Camera camera = cameraOf(field, kErrorPixels);
    const Ends wanted = stage.ends(bench, camera, fixed("rk4", "cubic", 0.5));
    Json asked = Json::array(), rms = Json::array(), worst = Json::array(), noted = Json::array(),
         steps = Json::array();
    for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
        const Ends found = stage.ends(bench, camera, adaptive(tolerance));
        const Deviation off = deviation(found, wanted);
        asked.push_back(tolerance);
        rms.push_back(off.rms);
        worst.push_back(off.worst);
        noted.push_back(found.noted);
        steps.push_back(found.steps / found.rays);
    }
    return {{"asked", asked}, {"rms", rms}, {"worst", worst}, {"noted", noted}, {"steps", steps}};
}

/// Rays that go round for ever: how many steps make a turn, and how far an end is from its orbit.
struct Orbit {
    std::string name;
    glm::ivec3 size{0}; ///< [voxel], of one unit
    std::function<double(dvec3)> index;
    view::Camera camera;    ///< within the box
    double stepsOfTurn = 0; ///< at a step of one voxel
    /// Numbers [unit] that a ray at x along a unit direction keeps.
    std::function<std::vector<double>(dvec3 x, dvec3 direction)> keeps;
};

view::Camera within(const dvec3& eye, const dvec3& direction, double height) {
    view::Camera camera;
    camera.eye = eye;
    camera.target = eye + glm::normalize(direction);
    camera.parallel = true;
    camera.height = height;
    camera.width = camera.rows = 8;
    return camera;
}

/// A rod of ten pitches of 42.7 voxels; rays keep their amplitude.
Orbit rodOrbit() {
    const Field& rod = fieldNamed("GRIN rod"); // whose axis is at 64, 64
    const dvec3 moved(kBox / 2 - 16, kBox / 2 - 16, 0);
    Orbit orbit;
    orbit.name = "GRIN rod, ten pitches";
    orbit.size = {32, 32, 440};
    orbit.index = [&rod, moved](dvec3 p) { return rod.index(p + moved); };
    orbit.camera = within({16.2, 16.1, 3}, {0.1, 0.05, 1}, 3);
    orbit.stepsOfTurn = kBox / 3;
    orbit.keeps = [&rod, moved](dvec3 x, dvec3 direction) {
        const double g = 2 * pi * 3 / kBox, n0 = 1.5;
        const double wz = rod.medium.index(x + moved) * direction.z;
        return std::vector<double>{std::sqrt(std::max(0.0, n0 * n0 - wz * wz)) / (n0 * g)};
    };
    return orbit;
}

/// Circles about the middle of a fish-eye; rays keep their circle's radius and how far it is off
/// the middle. (Voxels turn the circle slowly about the middle, as they are no sphere themselves.)
Orbit fishEyeOrbit() {
    const dvec3 centre(48);
    const double radius = 32;
    const judge::Medium medium = judge::maxwellFishEye(centre, radius);
    Orbit orbit;
    orbit.name = "fish-eye, ten turns";
    orbit.size = glm::ivec3(96);
    orbit.index = medium.index;
    orbit.camera = within(centre + dvec3(28, 0, 0), {0.05, 0.3, 1}, 4);
    // A turn takes close on 2πR of τ, and steps of τ are half a voxel: the highest index is 2.
    orbit.stepsOfTurn = 2 * pi * radius * 2;
    orbit.keeps = [=](dvec3 x, dvec3 direction) {
        const auto [middle, size] = judge::fishEyeCircle(centre, radius, {x, direction});
        return std::vector<double>{glm::length(middle - centre), size};
    };
    return orbit;
}

Json follow(Bench& bench, const Orbit& orbit, const Setting& setting) {
    const Stage stage(sceneOf(orbit.index, orbit.size, 1));
    const std::vector<judge::Ray> rays = raysOf(orbit.camera);
    const int parts = bench.full ? 4 : 2, turns = 10;
    Json turn = Json::array(), off = Json::array(), drift = Json::array();
    for (int part = 1; part <= turns * parts; ++part) {
        const double at = static_cast<double>(part) / parts;
        const double steps = at * orbit.stepsOfTurn / setting.tracing.step;
        const Ends ends =
            stage.ends(bench, orbit.camera, setting, static_cast<int>(std::lround(steps)));
        double squares = 0, drifts = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const auto first = orbit.keeps(rays[i].x, rays[i].direction);
            const auto last = orbit.keeps(ends.place[i], ends.direction[i]);
            for (size_t k = 0; k < first.size(); ++k) squares += std::pow(last[k] - first[k], 2);
            drifts += ends.drift[i] * ends.drift[i];
        }
        const double count = static_cast<double>(rays.size());
        turn.push_back(at);
        off.push_back(std::sqrt(squares / count));
        drift.push_back(std::sqrt(drifts / count));
    }
    return {{"turns", turn}, {"off", off}, {"drift", drift}};
}

void addStepTasks(Bench& bench, std::vector<Task>& tasks) {
    struct Kind {
        const char *integrator, *interpolation;
        bool plain;
    };
    const Kind kinds[] = {{"euler", "linear", true},   {"verlet", "linear", true},
                          {"verlet", "linear", false}, {"verlet", "cubic", false},
                          {"sharma", "cubic", false},  {"rk4", "cubic", false}};
    for (const Field& field : fields())
        for (const Kind& kind : kinds) {
            // In the first of these steps are exact, in the other nearly so.
            const bool exact = field.name == "linear n²" || field.name == "Luneburg core";
            if (exact || !field.smooth || (!bench.full && kind.plain)) continue;
            Json key{{"part", "order"},
                     {"field", field.name},
                     {"integrator", kind.integrator},
                     {"interpolation", kind.interpolation},
                     {"plain", kind.plain}};
            key.update(bench.version);
            tasks.push_back({key,
                             std::string("order of ") + kind.integrator +
                                 (kind.plain ? " plain " : " ") + kind.interpolation + " in " +
                                 field.name,
                             [&bench, &field, kind] {
                                 return stepErrors(bench, field, kind.integrator,
                                                   kind.interpolation, kind.plain);
                             }});
        }
}

} // namespace

std::vector<Task> orderTasks(Bench& bench) {
    std::vector<Task> tasks;
    addStepTasks(bench, tasks);
    for (const Field& field : fields()) {
        Json key{{"part", "tolerance"}, {"field", field.name}};
        key.update(bench.version);
        tasks.push_back({key, "tolerances kept in " + field.name,
                         [&bench, &field] { return reachOf(bench, field); }});
    }
    for (const Orbit& orbit : {rodOrbit(), fishEyeOrbit()})
        for (const Setting& setting : {fixed("verlet", "linear", 1), fixed("verlet", "cubic", 1),
                                       sources(), fixed("sharma", "cubic", 1)}) {
            Json key{{"part", "orbit"}, {"field", orbit.name}};
            key.update(setting.key());
            key["parts"] = bench.full ? 4 : 2;
            key.update(bench.version);
            tasks.push_back({key, setting.name() + " on " + orbit.name,
                             [&bench, orbit, setting] { return follow(bench, orbit, setting); }});
        }
    return tasks;
}

} // namespace accuracy
