// Media within media from meshes to the picture: every stage in its turn, as the executables do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stage.h"

#include "smooth/smooth.h"
#include "support/lit.h"
#include "support/shapes.h"
#include "voxelize/curve.h"
#include "voxelize/voxelize.h"

namespace eikonal::embedded {

voxelize::Object boxOf(const std::string& name, const dvec3& low, const dvec3& high,
                       const voxelize::Material& material, int priority) {
    return {name, material, priority, mesh::boxShape(low, high)};
}

voxelize::Object ballOf(const std::string& name, const dvec3& centre, double radius,
                        const voxelize::Material& material, int priority) {
    return {name, material, priority, mesh::moved(mesh::icosphere(radius, 3), centre)};
}

voxelize::Material mattOf(const dvec3& albedo, double ior) {
    voxelize::Material material;
    material.ior = ior;
    material.opacity = 1;
    material.albedo = albedo;
    return material;
}

lightsim::Light sunAlong(const dvec3& direction, const dvec3& rgb) {
    return lightsim::beam(direction, rgb);
}

volume::Volume Stage::make(Boundary boundary, const std::vector<lightsim::Light>& lights) const {
    voxelize::Params params;
    params.objects = objects;
    params.medium = medium;
    params.voxelSize = kVoxel;
    params.bounds = bounds;
    params.sharp = boundary == Boundary::sharp;
    params.check();
    Stats stats;
    EXPECT_TRUE(voxelize::curveObjects(params, stats).empty());
    voxelize::Result made = voxelize::voxelize(device(), params, voxelize::makePlan(params), stats);
    for (const std::string& warning : made.warnings) ADD_FAILURE() << warning;
    volume::Volume volume = std::move(made.volume);
    if (boundary == Boundary::blurred)
        for (const smooth::Item& item :
             smooth::run(device(), smooth::makePlan(volume, {}), stats, {})) {
            volume::PutOptions options;
            options.background = item.background;
            options.keepActive = true;
            volume.put(item.grid, volume.domain(), item.values, options);
        }
    if (!lights.empty()) light(volume, boundary, lights);
    return volume;
}

void light(volume::Volume& volume, Boundary boundary, const std::vector<lightsim::Light>& lights) {
    lightsim::Params params;
    params.lights = lights;
    params.surfaceDetail = 2;
    params.tracing.boundary = boundary;
    const lightsim::Lit lit(volume, params);
    const volume::IndexBox box = volume.domain();
    if (lit.plan.wants(lightsim::Output::fluence))
        volume.put("fluence", box, lit.result.fluence, {});
    if (lit.plan.wants(lightsim::Output::direction))
        volume.put("light_direction", box, lit.result.direction, {});
    if (!lit.result.irradiance.empty()) volume.putFine("irradiance", box, lit.result.irradiance);
}

view::Params viewAlong(Boundary boundary, const dvec3& direction, const dvec3& target,
                       double height, const glm::ivec2& size) {
    const dvec3 d = glm::normalize(direction);
    const dvec3 up = std::abs(d.y) > 0.9 ? dvec3(0, 0, -1) : dvec3(0, 1, 0);
    view::Params params = view::parallel(target - 4.0 * d, target, height, size, up);
    params.boundary = boundary;
    return params;
}

void forEachPixel(const view::Params& params, const std::function<void(int x, int y)>& visit) {
    for (int y = 0; y < params.camera.rows; ++y)
        for (int x = 0; x < params.camera.width; ++x) visit(x, y);
}

dvec3 originOf(const view::Params& params, int x, int y) {
    const view::Camera& camera = params.camera;
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    const double pixel = camera.height / camera.rows;
    return camera.eye + pixel * (x + 0.5 - 0.5 * camera.width) * right +
           pixel * (0.5 * camera.rows - y - 0.5) * up;
}

void expectColour(const view::Look& look, int x, int y, const dvec3& wanted, const dvec3& share) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(look.colour(x, y)[c], wanted[c], share[c] * wanted[c])
            << "RGB"[c] << " of pixel " << x << ", " << y;
}

std::string nameOf(const testing::TestParamInfo<Boundary>& info) {
    return info.param == Boundary::sharp ? "Sharp" : "Blurred";
}

} // namespace eikonal::embedded
