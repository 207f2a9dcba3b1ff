// Crystals that vary in space, against Hamilton's equations in long doubles, closed forms of liquid
// crystals and stressed plates, and crystals that do not vary.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "judge/varying_crystal.h"
#include "support/crystal_volume.h"
#include "support/glass_volume.h"
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = 3.141592653589793;
const ivec3 kSize(40, 36, 40);
const dvec3 kLow(4, 6, 4), kHigh(36, 30, 36);

using Part = std::function<dvec3(dvec3)>;

/// A box whose crystal is given by grids; those that are left out are not there.
volume::Volume boxOf(const Part& axis, const Part& ordinary, const Part& extraordinary,
                     const Part& absorption = {}, const Part& absorptionE = {}) {
    volume::Volume volume = crystalVolume(
        kSize, {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, 1.5, {}}});
    if (axis) putField(volume, "axis.box", kSize, 3, axis);
    if (ordinary) putField(volume, "ior.box", kSize, 1, ordinary);
    if (extraordinary) putField(volume, "ior_extraordinary.box", kSize, 1, extraordinary);
    if (absorption) putField(volume, "absorption.box", kSize, 3, absorption);
    if (absorptionE) putField(volume, "absorption_extraordinary.box", kSize, 3, absorptionE);
    return volume;
}

Part one(double value) {
    return [=](dvec3) { return dvec3(value); };
}

Params down(double x = 20, double z = 20, double slant = 0) {
    const dvec3 along(slant, -1, 0.7 * slant);
    Params params = sharp::sharply(sharp::oneRay({dvec3(x, 34, z), glm::normalize(along)}));
    params.cutoff = 1e-6;
    return params;
}

/// Parallel polarised light down on the middle of the box, from a bright surrounding.
Params crossed(double first, double second) {
    Params params = sharp::sharply(parallel({20, 100, 20}, {20, 0, 20}, 2, {1, 1}, {0, 0, 1}));
    params.background = dvec3(1);
    params.cutoff = 1e-6;
    params.polarizer = first;
    params.backPolarizer = second;
    params.wavelengths.count = 1;
    return params;
}

/// A medium whose indices vary and whose axis turns.
judge::Tensor turning(const dvec3& x, bool bends) {
    const dvec3 p = (x - dvec3(20, 18, 20)) / 20.0;
    const double o = bends ? 1.62 + 0.05 * p.x - 0.04 * p.y * p.z : 1.62;
    return {o, 1.50 + 0.03 * p.z + 0.02 * p.x * p.y,
            glm::normalize(dvec3(1 + 0.4 * p.y, 0.8 + 0.5 * p.x, 0.3 - 0.9 * p.z + 0.4 * p.y))};
}

} // namespace

TEST(VaryingCrystal, RaysTurnAsHamiltonSays) {
    for (const bool bends : {true, false}) {
        const auto at = [=](const dvec3& x) { return turning(x, bends); };
        const volume::Volume volume =
            boxOf([&](dvec3 x) { return (int(x.x) % 2 == 0 ? 1.0 : -1.0) * at(x).axis; }, // of either sign
                  [&](dvec3 x) { return dvec3(at(x).o); }, [&](dvec3 x) { return dvec3(at(x).e); });
        for (const char mode : {'o', 'e'})
            for (const double slant : {0.0, 0.35}) {
                Params params = down(19.3, 20.6, slant);
                const judge::Ray ray{params.camera.eye,
                                     glm::normalize(params.camera.target - params.camera.eye)};
                const dvec3 entry = ray.x + (kHigh.y - ray.x.y) / ray.direction.y * ray.direction;
                // Light that is polarised as the wave is goes there first.
                judge::LightWave inside;
                dvec3 best(1, 0, 0);
                double most = 0;
                const dvec3 right = glm::normalize(glm::cross(ray.direction, params.camera.up));
                const dvec3 up = glm::cross(right, ray.direction);
                for (int degrees = 0; degrees < 180; degrees += 5) {
                    const double a = degrees * kPi / 180;
                    const dvec3 field = std::cos(a) * right + std::sin(a) * up;
                    for (const judge::LightWave& w :
                         judge::scattered(judge::isotropicWave(1, ray.direction, field),
                                          {0, -1, 0}, {}, at(entry)))
                        if (w.mode == mode && w.power > most) {
                            most = w.power;
                            inside = w;
                            params.polarizer = degrees;
                        }
                }
                const judge::CrystalRay end =
                    judge::throughCrystal(at, mode, entry, inside.k,
                                          [](const dvec3& x) { return kLow.y - x.y; });
                EXPECT_LT(end.drift, 1e-9);
                judge::LightWave arrives = judge::crystalWave(at(end.x), mode, glm::normalize(end.k));
                dvec3 left(0);
                for (const judge::LightWave& w : judge::scattered(arrives, {0, -1, 0}, at(end.x), {}))
                    if (w.beyond) left = w.ray;
                const dvec3 out = end.x + end.x.y / -left.y * left;
                const Look look(scene::Files(volume), params);
                EXPECT_LT(glm::length(look.place() - out), 1e-3) << mode << slant << bends;
                EXPECT_LT(glm::length(look.direction() - left), 1e-4) << mode << slant << bends;
                std::printf("%c %g %d: off %.2e voxel, %.2e rad\n", mode, slant, bends,
                            glm::length(look.place() - out), glm::length(look.direction() - left));
            }
    }
}
