// Light in volumes: what wavefronts and photons cost and how near they come to many photons.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.h"
#include "lightsim/lightsim.h"
#include "support/test_volume.h"

#include <cmath>

namespace bench {

using namespace eikonal;
using glm::dvec3;
using glm::ivec3;

namespace {

/// A lens of n² = 2 − r² in a box some voxels wider.
volume::Volume luneburgLens(int voxels) {
    TestVolume scene{ivec3(voxels)};
    const double middle = 0.5 * voxels, radius = middle - 8;
    scene.index([=](dvec3 p) {
        const double r2 = glm::dot(p - middle, p - middle) / (radius * radius);
        return std::sqrt(2 - std::min(r2, 1.0));
    });
    return scene.take();
}

volume::Volume sharpBall(int voxels) {
    TestVolume scene{ivec3(voxels)};
    const double middle = 0.5 * voxels, radius = 0.3 * voxels;
    scene.add(
        "sdf", [=](dvec3 p) { return glm::length(p - middle) - radius; }, 1e3);
    scene.index([](dvec3) { return 1.5; }, 1);
    return scene.take();
}

struct Run {
    volume::BrickGrid fluence;
    double milliseconds = 0, deviceMb = 0;
};

Run run(gpu::Device& device, const volume::Volume& scene, lightsim::Method method,
        std::int64_t photons) {
    lightsim::Params params;
    params.method = method;
    params.lights.push_back(lightsim::parseLight("directional:0.3,-1,0.2"));
    params.photons = photons;
    params.automaticOutputs = false;
    params.outputs = lightsim::Output::fluence;
    const lightsim::Plan plan = lightsim::makePlan(scene, params);
    Stats stats;
    Run made;
    made.fluence = lightsim::simulate(device, plan, params, stats, {}).fluence;
    for (const auto& pass : stats.passes) made.milliseconds += pass.cpuMs;
    made.deviceMb = static_cast<double>(stats.gpuPeakBytes) / 1e6;
    return made;
}

/// Root mean squares of the difference: over √(φ² + (0.1 mean φ)²), and over the mean of voxels up
/// to twice the whole mean, and of those above.
struct Errors {
    double relative = 0, away = 0, over = 0;
};

Errors errorsOf(const Run& found, const Run& wanted) {
    const ivec3 size = wanted.fluence.size;
    const double voxels = static_cast<double>(size.x) * size.y * size.z;
    const auto visit = [&](const auto& tell) {
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    tell(double{found.fluence.at({x, y, z})}, double{wanted.fluence.at({x, y, z})});
    };
    double sum = 0;
    visit([&](double, double exact) { sum += exact; });
    const double mean = sum / voxels;
    double relative = 0, squares[2] = {}, sums[2] = {}, counts[2] = {};
    visit([&](double its, double exact) {
        const double square = (its - exact) * (its - exact);
        relative += square / (exact * exact + 0.01 * mean * mean);
        const int over = exact > 2 * mean;
        squares[over] += square;
        sums[over] += exact;
        counts[over] += 1;
    });
    const auto rms = [&](int k) { return std::sqrt(squares[k] * counts[k]) / sums[k]; };
    return {std::sqrt(relative / voxels), rms(0), rms(1)};
}

} // namespace

Json measureFronts(const Settings& settings) {
    gpu::Device device(gpu::parseDeviceChoice(settings.device));
    Json rows = Json::array();
    const auto measure = [&](const std::string& name, const volume::Volume& scene) {
        const Run wanted = run(device, scene, lightsim::Method::photons, 1 << 24);
        run(device, scene, lightsim::Method::wavefront, 1 << 12); // warms up
        const auto row = [&](const std::string& method, const Run& found) {
            const Errors off = errorsOf(found, wanted);
            rows.push_back({{"scene", name},
                            {"method", method},
                            {"passes_ms", found.milliseconds},
                            {"relative_percent", 100 * off.relative},
                            {"away_percent", 100 * off.away},
                            {"over_percent", 100 * off.over},
                            {"device_mb", found.deviceMb}});
        };
        row("wavefront", run(device, scene, lightsim::Method::wavefront, 0));
        for (const int power : {14, 16, 17, 18})
            row("photons 2^" + std::to_string(power),
                run(device, scene, lightsim::Method::photons, std::int64_t{1} << power));
        row("photons auto", run(device, scene, lightsim::Method::photons, 0));
    };
    measure("Luneburg lens 128", luneburgLens(128));
    measure("blurred ball 128", ballVolume(128, false));
    measure("sharp ball 64", sharpBall(64));
    return rows;
}

} // namespace bench
