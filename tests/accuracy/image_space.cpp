// Refraction in image space against the same meshes traced exactly: what methods cost in truth.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image_space.h"

#include "imagespace/imagespace.h"
#include "raytrace/normal_distances.h"
#include "raytrace/raytrace.h"
#include "support/bodies.h"

#include <chrono>
#include <map>

namespace accuracy {

using namespace eikonal;

namespace {

constexpr double kIndex = 1.5;

struct Way {
    const char* name;
    imagespace::Method method;
    int layers;
};
const Way kWays[] = {{"dir", imagespace::Method::dir, 0},
                     {"dir, 4 layers", imagespace::Method::dir, 4},
                     {"isr", imagespace::Method::isr, 0},
                     {"sir", imagespace::Method::sir, 0}};

camera::Camera cameraOf(const mesh::SampleBody& body, const Bench& bench) {
    camera::Camera camera;
    camera.eye = body.eye;
    camera.fov = 32;
    camera.width = camera.rows = bench.full ? 512 : 256;
    return camera;
}

std::vector<dvec3> exitsOf(const image::Image& picture) {
    const std::vector<float> all =
        image::interleaved(picture, {"exit_direction.X", "exit_direction.Y", "exit_direction.Z"});
    std::vector<dvec3> exits;
    for (size_t i = 0; i < all.size(); i += 3) exits.emplace_back(all[i], all[i + 1], all[i + 2]);
    return exits;
}

/// Where rays leave a body, exactly, and how they come there.
struct Truth {
    std::vector<dvec3> exits;
    std::vector<char> covered, twice; ///< it meets the body; it is refracted twice and no more
    double ms = 0;                    ///< for all orders
};

Truth trace(const mesh::SampleBody& body, const Bench& bench) {
    raytrace::Params params;
    params.camera = cameraOf(body, bench);
    const std::vector<raytrace::Body> bodies = {
        {body.name, body.mesh, kIndex, dvec3(0), false, dvec3(0)}};
    Truth truth;
    Stats timed;
    raytrace::render(params, bodies, std::nullopt, timed, {});
    for (const PassTime& pass : timed.passes)
        if (pass.name == "rays") truth.ms = pass.cpuMs;
    params.aovs = {"exit_direction"};
    // Reflections are not looked at.
    params.cutoff = 0.999;
    Stats unused;
    const image::Image picture = raytrace::render(params, bodies, std::nullopt, unused, {});
    truth.exits = exitsOf(picture);
    params.maxDepth = 2;
    const std::vector<dvec3> early =
        exitsOf(raytrace::render(params, bodies, std::nullopt, unused, {}));
    for (size_t i = 0; i < early.size(); ++i) {
        truth.covered.push_back(picture.plane(3)[i] > 0);
        truth.twice.push_back(early[i] == truth.exits[i]);
    }
    return truth;
}

/// Kept for the ways to come.
const Truth& truthOf(const mesh::SampleBody& body, const Bench& bench) {
    static std::map<std::string, Truth> known;
    const auto found = known.find(body.name);
    if (found != known.end()) return found->second;
    return known[body.name] = trace(body, bench);
}

/// How far directions are off, over some pixels.
struct Angles {
    double pixels = 0, close = 0, sum = 0; ///< close: within 1°
    void add(const dvec3& a, const dvec3& b) {
        const double angle =
            glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
        ++pixels;
        close += angle <= 1 ? 1 : 0;
        sum += angle;
    }
    Json share() const { return pixels > 0 ? Json(close / pixels) : Json(); }
    Json mean() const { return pixels > 0 ? Json(sum / pixels) : Json(); }
};

double msOf(imagespace::Renderer& renderer) {
    std::vector<double> times;
    // The first waits for the driver; layers on a processor take seconds, of which one tells
    // enough.
    for (int i = 0; i < 6 && (times.empty() || times.front() < 1000); ++i) {
        const auto began = std::chrono::steady_clock::now();
        renderer.render({});
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
                .count());
    }
    if (times.size() > 1) times.erase(times.begin());
    return median(times);
}

Json measure(Bench& bench, const mesh::SampleBody& body, const Way& way) {
    imagespace::Params params;
    params.camera = cameraOf(body, bench);
    params.method = way.method;
    params.layers = way.layers;
    params.ior = kIndex;
    imagespace::Body shape{body.mesh, {}};
    if (way.method == imagespace::Method::isr)
        shape.distances = raytrace::distancesAlongNormals(body.mesh);
    Stats stats;
    Json row;
    {
        imagespace::Renderer renderer(bench.device, params, std::nullopt, stats);
        renderer.setScene(shape, {});
        row["ms"] = msOf(renderer);
    }
    params.aovs = {"exit_direction"};
    imagespace::Renderer renderer(bench.device, params, std::nullopt, stats);
    renderer.setScene(shape, {});
    const std::vector<dvec3> exits = exitsOf(renderer.render({}));
    const Truth& truth = truthOf(body, bench);
    Angles all, twice, more;
    for (size_t i = 0; i < exits.size(); ++i) {
        if (!truth.covered[i]) continue;
        all.add(exits[i], truth.exits[i]);
        (truth.twice[i] ? twice : more).add(exits[i], truth.exits[i]);
    }
    row["pixels"] = all.pixels;
    row["more"] = more.pixels / all.pixels;
    row["close"] = all.share();
    row["mean"] = all.mean();
    row["close_twice"] = twice.share();
    row["mean_twice"] = twice.mean();
    row["close_more"] = more.share();
    row["mean_more"] = more.mean();
    row["rays_ms"] = truth.ms;
    return row;
}

const char* nameOf(mesh::BodyKind kind) {
    return kind == mesh::BodyKind::convex    ? "convex"
           : kind == mesh::BodyKind::concave ? "concave"
                                             : "thin";
}

} // namespace

std::vector<Task> imageTasks(Bench& bench) {
    static const std::vector<mesh::SampleBody> kBodies = mesh::sampleBodies();
    std::vector<Task> tasks;
    for (const mesh::SampleBody& body : kBodies)
        for (const Way& way : kWays) {
            Json key{{"part", "image space"},
                     {"body", body.name},
                     {"kind", nameOf(body.kind)},
                     {"way", way.name},
                     {"full", bench.full}};
            key.update(bench.version);
            tasks.push_back({key, "image space: " + body.name + ", " + way.name,
                             [&bench, &body, &way] { return measure(bench, body, way); }});
        }
    return tasks;
}

} // namespace accuracy
