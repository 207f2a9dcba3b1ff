// Sharp boundaries against blurred ones on the same meshes, pass beside pass in one process.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"

#include "lightsim/lightsim.h"
#include "mesh/read.h"
#include "smooth/smooth.h"
#include "support/shapes.h"
#include "view/view.h"
#include "voxelize/voxelize.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace bench {

using namespace eikonal;

namespace {

constexpr int kPixels = 384, kVoxels = 128;
constexpr std::int64_t kPhotons = 1 << 18;

double passMs(const Stats& stats, const std::string& name) {
    for (const PassTime& pass : stats.passes)
        if (pass.name == name) return pass.gpuMs;
    return 0;
}

/// Glass as mesh2vol makes it of a mesh; blurred, as volsmooth leaves it by default.
volume::Volume glassOf(gpu::Device& device, const mesh::TriangleMesh& mesh, bool sharp) {
    voxelize::Params params;
    voxelize::Object object;
    object.name = "glass";
    object.material.ior = 1.5;
    object.mesh = mesh;
    params.objects.push_back(std::move(object));
    params.resolution = kVoxels;
    params.sharp = sharp;
    params.check();
    Stats stats;
    volume::Volume volume =
        voxelize::voxelize(device, params, voxelize::makePlan(params), stats).volume;
    if (sharp) return volume;
    volume::PutOptions options;
    options.keepActive = true;
    for (const smooth::Item& item :
         smooth::run(device, smooth::makePlan(volume, smooth::Params{}), stats, {})) {
        options.background = item.background;
        volume.put(item.grid, volume.domain(), item.values, options);
    }
    return volume;
}

/// Photons without a medium: fluence is asked for, since nothing would show it.
lightsim::Params lightParams() {
    lightsim::Params params;
    params.lights.push_back(lightsim::parseLight("directional:0.2,-1,0.1"));
    params.photons = kPhotons;
    params.automaticOutputs = false;
    params.outputs = lightsim::Output::fluence;
    return params;
}

/// One volume, ready to be looked into and lit.
class Subject {
public:
    Subject(gpu::Device& device, const mesh::TriangleMesh& mesh, bool sharp)
        : mDevice(device), mLight(glassOf(device, mesh, sharp)),
          mLightPlan(lightsim::makePlan(mLight, lightParams())), mScene(sceneOf(mesh, sharp)),
          mPlan(view::makePlan(mScene, {}, false)) {
        const mesh::Box box = mesh::boundingBox(mesh);
        const glm::dvec3 centre = 0.5 * (box.min + box.max), size = box.max - box.min;
        mCamera.eye = centre + 4 * glm::length(size) * glm::normalize(glm::dvec3(0.1, 0.2, 1));
        mCamera.target = centre;
        mCamera.parallel = true;
        mCamera.height = 1.05 * std::max({size.x, size.y, size.z});
        mCamera.width = mCamera.rows = kPixels;
    }

    /// GPU time of the view pass [ms]. `euler`: as the sources have it, one voxel a step.
    double viewMs(bool euler, int depth) const {
        view::Params params;
        params.camera = mCamera;
        params.maxDepth = depth;
        if (euler) {
            params.integrator = optics::Integrator::euler;
            params.step = 1;
        }
        Stats stats;
        view::render(mDevice, mPlan, params, std::nullopt, stats, {});
        return passMs(stats, "view");
    }

    /// GPU time of the photons' pass [ms].
    double photonsMs() const {
        Stats stats;
        lightsim::simulate(mDevice, mLightPlan, lightParams(), stats, {});
        return passMs(stats, "photons");
    }

private:
    scene::Files sceneOf(const mesh::TriangleMesh& mesh, bool sharp) {
        std::vector<volume::Volume> volumes;
        volumes.push_back(glassOf(mDevice, mesh, sharp));
        return scene::Files(std::move(volumes));
    }

    gpu::Device& mDevice;
    volume::Volume mLight;
    lightsim::Plan mLightPlan;
    scene::Files mScene;
    view::Plan mPlan;
    view::Camera mCamera;
};

Json measure(const Settings& settings, gpu::Device& device, const std::string& name,
             const mesh::TriangleMesh& mesh) {
    const Subject blurred(device, mesh, false), sharp(device, mesh, true);
    std::vector<double> view, sources, through, all, photons, sharpPhotons;
    for (int i = 0; i <= settings.repeats; ++i) {
        const double base = blurred.viewMs(false, 8), light = blurred.photonsMs();
        const double ratios[] = {blurred.viewMs(true, 8) / base, sharp.viewMs(false, 2) / base,
                                 sharp.viewMs(false, 8) / base, sharp.photonsMs() / light};
        if (i == 0) continue; // the first round warms up
        view.push_back(base);
        photons.push_back(light);
        sources.push_back(ratios[0]);
        through.push_back(ratios[1]);
        all.push_back(ratios[2]);
        sharpPhotons.push_back(ratios[3]);
    }
    return {{"scene", name},
            {"blurred_view_ms", median(view)},
            {"sources_scheme_to_blurred", median(sources)},
            {"sharp_depth_2_to_blurred", median(through)},
            {"sharp_depth_8_to_blurred", median(all)},
            {"blurred_photons_ms", median(photons)},
            {"sharp_photons_to_blurred", median(sharpPhotons)}};
}

} // namespace

Json measureSharp(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    Json rows = Json::array();
    rows.push_back(measure(settings, device, "ball", mesh::icosphere(0.5, 5)));
    if (!settings.bunny.empty())
        rows.push_back(measure(settings, device, "bunny", mesh::readMesh(settings.bunny)));
    return rows;
}

} // namespace bench
