// Path lengths where they are known to the last digit that a float holds.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kIndex = 1.3371; // no short binary fraction
const ivec3 kSize(48, 40, 56);

/// The same index all over but within some voxels of one corner, so that rays are stepped as
/// through a varying one; with an object of glass in that corner, sharp boundaries are looked for.
volume::Volume constantBut(bool varies, bool sharp) {
    const dvec3 corner(46, 38, 54);
    TestVolume scene(kSize);
    scene.index(
        [=](dvec3 p) {
            const double r2 = glm::dot(p - corner, p - corner);
            return kIndex + (varies ? 0.05 * std::max(0.0, 1 - r2 / 36) : 0);
        },
        1);
    if (sharp) {
        volume::DenseGrid distances{kSize, 1, {}};
        forEachVoxel(kSize, [&](ivec3 p) {
            distances.values.push_back(
                static_cast<float>(glm::length(dvec3(p) + 0.5 - (corner - 3.0)) - 3));
        });
        volume::Volume volume = scene.take();
        volume.putLevelSet({"", "sdf", 0, 0}, {ivec3(0), kSize - 1}, distances, 4);
        volume.putConstant("ior.medium", glm::vec3(static_cast<float>(kIndex)));
        return volume;
    }
    return scene.take();
}

/// Where a line from outside enters the domain.
dvec3 entryOf(const dvec3& eye, const dvec3& direction) {
    double enter = 0;
    for (int i = 0; i < 3; ++i)
        enter =
            std::max(enter, std::min(-eye[i] / direction[i], (kSize[i] - eye[i]) / direction[i]));
    return eye + enter * direction;
}

struct Mode {
    const char* name;
    Integrator integrator;
    Interpolation interpolation;
    bool varies, sharp;
};

/// The largest relative error of the optical path length over rays of many directions.
double worstOf(const Mode& mode) {
    const volume::Volume scene = constantBut(mode.varies, mode.sharp);
    const double n = static_cast<double>(static_cast<float>(kIndex)); // as the file holds it
    double worst = 0;
    // Not far from an axis each: what a ray's place is off by then counts for little in its length.
    for (const dvec3& eye : {dvec3(-31, 11, 15), dvec3(14, -37, 18), dvec3(15, 13, -40)}) {
        Params params = perspective(eye, dvec3(16, 14, 18), 20, {8, 8}, {0.3, 0.5, 0.4});
        params.integrator = mode.integrator;
        params.interpolation = mode.interpolation;
        params.aovs = {"optical_path_length", "exit_position"};
        const scene::Files files(scene);
        const Plan plan = makePlan(files, params, false);
        Stats stats;
        const image::Image picture = render(device(), plan, params, {}, stats, {});
        const auto channel = [&](const std::string& name, size_t i) {
            return static_cast<double>(picture.plane(*picture.find(name))[i]);
        };
        const camera::CameraAxes axes = axesOf(params.camera);
        const double half = std::tan(glm::radians(0.5 * params.camera.fov));
        for (size_t i = 0; i < 64; ++i) {
            const double sx = static_cast<double>(i % 8) / 4 - 0.875;
            const double sy = 0.875 - static_cast<double>(i / 8) / 4;
            const dvec3 direction =
                glm::normalize(axes.forward + half * (sx * axes.right + sy * axes.up));
            const dvec3 exit(channel("exit_position.X", i), channel("exit_position.Y", i),
                             channel("exit_position.Z", i));
            const double wanted = n * glm::distance(exit, entryOf(eye, direction));
            worst = std::max(worst, std::abs(channel("optical_path_length.V", i) / wanted - 1));
        }
    }
    return worst;
}

} // namespace

// From where the ray enters to where it was found to leave. A float's rounding is 6e-8 at most:
// that of what is stored; the index is that of the file to its last digit.
TEST(ViewLengths, OpticalPathLengthOfAConstantMediumInEveryMode) {
    using enum Integrator;
    constexpr Interpolation kLinear = Interpolation::linear, kCubic = Interpolation::cubic;
    for (const Mode& mode :
         {Mode{"straight", verlet, kLinear, false, false},
          Mode{"euler", euler, kLinear, true, false}, Mode{"verlet", verlet, kLinear, true, false},
          Mode{"verlet cubic", verlet, kCubic, true, false},
          Mode{"sharma", sharma, kCubic, true, false}, Mode{"rk4", rk4, kCubic, true, false},
          Mode{"adaptive", adaptive, kCubic, true, false},
          Mode{"sharp", verlet, kLinear, false, true}}) {
        const double worst = worstOf(mode);
        EXPECT_LT(worst, 1e-7) << mode.name;
    }
}
