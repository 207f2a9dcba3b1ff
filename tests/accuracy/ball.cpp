// A ball of glass on its way from mesh to voxels, and how far its rays are from Snell's.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball.h"

#include "judge/snell.h"
#include "smooth/smooth.h"
#include "support/shapes.h"
#include "voxelize/curve.h"
#include "voxelize/voxelize.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace accuracy {

using namespace eikonal;

mesh::TriangleMesh meshOf(const Ball& ball) {
    return mesh::moved(mesh::icosphere(ball.radius, 7), ball.centre);
}

volume::Volume voxelised(Bench& bench, const Ball& ball, int voxels, int supersample, bool sharp,
                         Stats& stats) {
    voxelize::Params params;
    voxelize::Object object;
    object.name = "ball";
    object.material.ior = ball.index;
    object.mesh = meshOf(ball);
    params.objects.push_back(std::move(object));
    params.resolution = voxels;
    params.bounds = mesh::Box{dvec3(0), dvec3(kBox)};
    params.supersample = supersample;
    params.sharp = sharp;
    params.check();
    voxelize::curveObjects(params, stats);
    return voxelize::voxelize(bench.device, params, voxelize::makePlan(params), stats).volume;
}

volume::Volume blurred(Bench& bench, const volume::Volume& volume, double sigma, Stats& stats) {
    smooth::Params params;
    params.sigma = sigma;
    volume::Volume result(volume.frame());
    volume::PutOptions options;
    options.allActive = true; // the domain stays what it is
    for (const smooth::Item& item :
         smooth::run(bench.device, smooth::makePlan(volume, params), stats, {})) {
        options.background = item.background;
        result.put(item.grid, volume.domain(), item.values, options);
    }
    return result;
}

scene::Files sceneWith(volume::Volume volume) {
    std::vector<volume::Volume> volumes;
    volumes.push_back(std::move(volume));
    return scene::Files(std::move(volumes));
}

view::Camera cameraAt(const Ball& ball, int pixels, double height) {
    view::Camera camera;
    const dvec3 direction = glm::normalize(dvec3(0.1, 0.05, 1));
    camera.eye = ball.centre - 2 * kBox * direction;
    camera.target = ball.centre;
    camera.parallel = true;
    camera.height = height;
    camera.width = camera.rows = pixels;
    return camera;
}

double deflectionError(const Ball& ball, const std::vector<judge::Ray>& rays, const Ends& ends,
                       double from, double to) {
    double squares = 0;
    int count = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const dvec3 d = glm::normalize(rays[i].direction), x = rays[i].x - ball.centre;
        const dvec3 across = x - glm::dot(x, d) * d;
        const double impact = glm::length(across) / ball.radius;
        if (impact < from || impact > to) continue;
        const double angle = judge::ballDeflection(ball.index, impact);
        const dvec3 wanted = std::cos(angle) * d - std::sin(angle) * glm::normalize(across);
        // By its tangent: the cosine of a small angle says nothing.
        const double error = std::atan2(glm::length(glm::cross(wanted, ends.direction[i])),
                                        glm::dot(wanted, ends.direction[i]));
        squares += error * error;
        ++count;
    }
    return std::sqrt(squares / count) * 180 / std::numbers::pi;
}

} // namespace accuracy
