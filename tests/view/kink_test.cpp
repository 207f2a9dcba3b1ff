// Linear look-ups where the index has a kink: a Luneburg lens with its rim.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

/// n² = 2 − (r/R)² within the rim, 1 beyond it: the slope of n jumps there.
volume::Volume rimLens(int size, double radius, const dvec3& centre) {
    TestVolume scene{ivec3(size)};
    scene.index([=](dvec3 p) {
        const double r = glm::length(p - centre) / radius;
        return r < 1 ? std::sqrt(2 - r * r) : 1.0;
    });
    return scene.take();
}

/// How far rays of several directions are off the point of the rim in which all meet, across their
/// way out: rms over those that meet the lens within `within` of its radius [voxel].
double focusError(int size, double within, bool plainSamples) {
    const double radius = 0.4 * size;
    const dvec3 centre = dvec3(0.5 * size) + dvec3(0.13, 0.09, 0.04); // on no sample
    const volume::Volume scene = rimLens(size, radius, centre);
    double sum = 0;
    int rays = 0;
    for (const dvec3& towards : {dvec3(0, 0, -1), dvec3(0.3, -0.2, 1), dvec3(1, 1, 1)}) {
        const dvec3 direction = glm::normalize(towards), up(0.1, 0.9, -0.3);
        const int pixels = 40;
        Params params = parallel(centre - 4.0 * size * direction, centre, 2 * within * radius,
                                 {pixels, pixels}, up);
        params.plainSamples = plainSamples;
        const scene::Files files(scene);
        const Plan plan = makePlan(files, params, false);
        Stats stats;
        const image::Image picture = render(device(), plan, params, {}, stats, {});
        const camera::CameraAxes axes = axesOf(params.camera);
        const dvec3 focus = centre + radius * direction;
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x) {
                const double step = 2 * within * radius / pixels;
                const dvec3 offset = step * ((x + 0.5 - 0.5 * pixels) * axes.right +
                                             (0.5 * pixels - y - 0.5) * axes.up);
                if (glm::length(offset) > within * radius) continue;
                const auto pixel = static_cast<size_t>(y) * pixels + x;
                const auto at = [&](const std::string& name) {
                    return static_cast<double>(picture.plane(*picture.find(name))[pixel]);
                };
                const dvec3 exit(at("exit_position.X"), at("exit_position.Y"),
                                 at("exit_position.Z"));
                // The ray leaves the focus along minus the radius that it came in by.
                const dvec3 out = glm::normalize(
                    std::sqrt(radius * radius - glm::dot(offset, offset)) * direction - offset);
                const dvec3 off = exit - focus;
                const dvec3 across = off - glm::dot(off, out) * out;
                sum += glm::dot(across, across);
                ++rays;
            }
    }
    return std::sqrt(sum / rays);
}

} // namespace

// Making samples unbiased takes off differences that tell nothing at a kink: there they stay plain.
TEST(ViewKink, UnbiasedSamplesAreNoWorseThanPlainOnes) {
    for (const int size : {64, 96, 128})
        for (const double within : {0.9, 0.99}) {
            const double unbiased = focusError(size, within, false);
            EXPECT_LT(unbiased, focusError(size, within, true))
                << size << " voxels, within " << within << " of the radius";
        }
}
