// Table 1 of Oliveira and Brauwers 2007: refraction in image space and traced rays, on six meshes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "imagespace/imagespace.h"
#include "mesh/curved_face.h"
#include "mesh/fans.h"
#include "mesh/read.h"
#include "mesh/smooth_surface.h"
#include "raytrace/normal_distances.h"
#include "raytrace/raytrace.h"

#include <chrono>
#include <filesystem>
#include <map>

namespace bench {

using namespace eikonal;
using glm::dvec3;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began) {
    return std::chrono::duration<double>(Clock::now() - began).count();
}

/// A mesh, as often parted into four times as many triangles, and where it is seen from.
struct Model {
    const char* file;
    int subdivisions;
    dvec3 from; ///< the eye's direction
};
const Model kModels[] = {{"armadillo", 0, {0.2, 0.2, -1}}, {"bunny00", 0, {0.3, 0.3, 1}},
                         {"camel", 1, {1, 0.3, 0.5}},      {"bear", 1, {0.5, 0.3, 1}},
                         {"man", 1, {0.3, 0.2, 1}},        {"refined_elephant", 1, {1, 0.3, 0.6}}};

/// Each triangle in four, along curves that bend with the normals.
mesh::TriangleMesh subdivided(mesh::TriangleMesh mesh) {
    mesh.normals = mesh::cornerNormals(mesh::findFans(mesh, mesh::kUsualSmooth));
    const auto curves = mesh::edgeCurves(mesh);
    mesh::TriangleMesh fine;
    fine.points = mesh.points;
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    for (size_t f = 0; f < mesh.triangles.size(); ++f) {
        const glm::uvec3 t = mesh.triangles[f];
        unsigned m[3];
        for (int k = 0; k < 3; ++k) {
            const unsigned a = t[k], b = t[(k + 1) % 3];
            const auto [place, isNew] =
                middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(fine.points.size()));
            if (isNew)
                fine.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]) +
                                      curves[f][static_cast<size_t>(k)].rise);
            m[k] = place->second;
        }
        for (const glm::uvec3& part : {glm::uvec3(t.x, m[0], m[2]), glm::uvec3(m[0], t.y, m[1]),
                                       glm::uvec3(m[2], m[1], t.z), glm::uvec3(m[0], m[1], m[2])})
            fine.triangles.push_back(part);
    }
    return fine;
}

/// About the origin, of a size at which its picture from there just fits a square.
camera::Camera fit(mesh::TriangleMesh& mesh, const dvec3& from) {
    const mesh::Box box = mesh::boundingBox(mesh);
    const dvec3 middle = 0.5 * (box.min + box.max);
    const double radius = 0.5 * glm::length(box.max - box.min);
    for (dvec3& x : mesh.points) x = (x - middle) / radius;
    camera::Camera camera;
    camera.eye = 4.0 * glm::normalize(from);
    camera.width = camera.rows = 512;
    const camera::CameraAxes axes = camera::axesOf(camera);
    double widest = 0;
    for (const dvec3& x : mesh.points) {
        const dvec3 v = x - camera.eye;
        const double depth = glm::dot(v, axes.forward);
        widest = std::max({widest, std::abs(glm::dot(v, axes.right)) / depth,
                           std::abs(glm::dot(v, axes.up)) / depth});
    }
    camera.fov = glm::degrees(2 * std::atan(1.01 * widest));
    return camera;
}

/// A sky that is bright above.
image::Image sky() {
    image::Image map(512, 256);
    std::vector<float> pixels;
    for (int row = 0; row < 256; ++row)
        for (int column = 0; column < 512; ++column)
            for (int c = 0; c < 3; ++c)
                pixels.push_back(static_cast<float>(255 - row) / 256.0f *
                                 (1 + 0.3f * static_cast<float>((column / 32 + c) % 3)));
    map.addChannels({"R", "G", "B"}, pixels, 3);
    return map;
}

/// Frames a second: by the device's time, and of a loop that draws and fetches pictures; the same
/// where each takes its points anew, as those of a mesh that deforms.
struct Rates {
    double device = 0, loop = 0, deforming = 0, covered = 0;
};

Rates ratesOf(const Settings& settings, gpu::Device& device, const camera::Camera& camera,
              const imagespace::Body& body, imagespace::Method method, const image::Image& map) {
    imagespace::Params params;
    params.camera = camera;
    params.method = method;
    Stats stats;
    imagespace::Renderer renderer(device, params, map, stats);
    std::vector<double> drawn, loops, anew;
    Rates rates;
    for (int i = 0; i <= settings.repeats; ++i) {
        const auto began = Clock::now();
        renderer.setScene(body, {});
        const auto ready = Clock::now();
        stats.passes.clear();
        const image::Image picture = renderer.render({});
        if (i == 0) { // the first one waits for the driver
            for (const float alpha : picture.plane(3)) rates.covered += alpha > 0;
            continue;
        }
        anew.push_back(secondsSince(began));
        loops.push_back(secondsSince(ready));
        double ms = 0;
        for (const PassTime& pass : stats.passes)
            if (pass.name != "upload" && pass.name != "download") ms += pass.gpuMs;
        drawn.push_back(1e-3 * ms);
    }
    rates.device = 1 / median(drawn);
    rates.loop = 1 / median(loops);
    rates.deforming = 1 / median(anew);
    return rates;
}

Json measure(const Settings& settings, gpu::Device& device, const Model& model) {
    imagespace::Body body{mesh::readMesh(settings.meshes + "/" + model.file + ".off"), {}};
    for (int i = 0; i < model.subdivisions; ++i) body.mesh = subdivided(std::move(body.mesh));
    const camera::Camera camera = fit(body.mesh, model.from);
    body.mesh.normals = mesh::cornerNormals(mesh::findFans(body.mesh, mesh::kUsualSmooth));
    const auto began = Clock::now();
    body.distances = raytrace::distancesAlongNormals(body.mesh);
    const double distances = secondsSince(began);
    const image::Image map = sky();
    const Rates dir = ratesOf(settings, device, camera, body, imagespace::Method::dir, map),
                isr = ratesOf(settings, device, camera, body, imagespace::Method::isr, map),
                sir = ratesOf(settings, device, camera, body, imagespace::Method::sir, map);
    raytrace::Params params;
    params.camera = camera;
    Stats stats;
    raytrace::render(params, {{model.file, body.mesh, 1.5, dvec3(0), false, dvec3(0)}}, map, stats,
                     {});
    double traced = 0;
    for (const PassTime& pass : stats.passes) traced += 1e-3 * pass.cpuMs;
    return {{"model", model.file},
            {"polygons", static_cast<double>(body.mesh.triangles.size())},
            {"pixels", dir.covered},
            {"dir device [fps]", dir.device},
            {"dir loop [fps]", dir.loop},
            {"dir deforming [fps]", dir.deforming},
            {"isr device [fps]", isr.device},
            {"isr loop [fps]", isr.loop},
            {"isr distances [s]", distances},
            {"sir device [fps]", sir.device},
            {"sir loop [fps]", sir.loop},
            {"rays [s]", traced}};
}

} // namespace

Json measureImageSpace(const Settings& settings) {
    Json rows = Json::array();
    if (settings.meshes.empty()) return rows;
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    for (const Model& model : kModels) rows.push_back(measure(settings, device, model));
    return rows;
}

} // namespace bench
