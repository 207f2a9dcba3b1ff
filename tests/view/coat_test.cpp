// Matt objects under a coat as viewing rays meet them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"
#include "support/look.h"
#include "support/shader_lib.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

constexpr double kPi = 3.141592653589793;

/// A ball under a coat, lit all over.
volume::Volume ball(double index, double albedo, double irradiance) {
    TestVolume scene(ivec3(24));
    scene.add("sdf", [](dvec3 p) { return glm::length(p - 12.0) - 9; });
    scene.constant("ior", index);
    scene.constant("opacity", 1);
    scene.constantVector("albedo", dvec3(albedo));
    volume::Volume volume = scene.take();
    volume::FineGrid light;
    light.detail = 1;
    for (int z = 0; z < 24; ++z)
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                light.voxels.emplace_back(x, y, z);
                light.values.emplace_back(static_cast<float>(irradiance));
            }
    volume.putFine("irradiance", volume.domain(), light);
    return volume;
}

Params inARoom(double radiance) {
    Params params = sharp::sharply(parallel({12, 12, 80}, dvec3(12), 20, {20, 20}));
    params.background = dvec3(radiance);
    return params;
}

double fresnel(double cosine, double m) {
    const shader_lib::vec3 w(std::sqrt(1 - cosine * cosine), 0, -cosine);
    return shader_lib::dielectricAt(w, {0, 0, 1}, 1, m).reflectance;
}

} // namespace

TEST(CoatView, AWhiteBallIsLostInAWhiteRoom) {
    // What comes through the coat of even light π L is π L (1 − R), R that of even light.
    const double through = kPi * (1 - shader_lib::evenReflectance(1.5));
    const Look look(ball(1.5, 1, through), inARoom(1));
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) EXPECT_NEAR(look.at("R", x, y), 1, 1e-4);
}

TEST(CoatView, ItMirrorsAsGlassAndHidesAsMuchOfItsBase) {
    // Black room: the base alone; dark base: the room's mirror image alone.
    const Look base(ball(1.5, 0.5, 2), inARoom(0)), mirror(ball(1.5, 0, 2), inARoom(1));
    for (int y = 2; y < 18; ++y)
        for (int x = 2; x < 18; ++x) {
            const double square = std::pow(x + 0.5 - 10, 2) + std::pow(y + 0.5 - 10, 2);
            if (square > 75) continue;
            const double R = fresnel(std::sqrt(1 - square / 81), 1.5);
            const double under = shader_lib::albedoUnderCoat(dvec3(0.5), 1.5).x;
            EXPECT_NEAR(base.at("R", x, y), (1 - R) * 2 * under / kPi / 2.25, 1e-4);
            EXPECT_NEAR(mirror.at("R", x, y), R, 1e-4);
            // The first path ends on the base.
            EXPECT_NEAR(glm::length(base.position(x, y) - 12.0), 9, 1e-2);
        }
}

TEST(CoatView, AnIndexThatIsNotAboveMakesNone) {
    for (const double index : {1.0, 0.8}) {
        const Look look(ball(index, 0.5, 2), inARoom(1));
        EXPECT_EQ(look.plan.scene.firstCoated(), nullptr);
        EXPECT_NEAR(look.at("R", 10, 10), 0.5 * 2 / kPi, 1e-5);
    }
}
