// Rough boundaries and metal as viewing rays meet them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/boundary.h"
#include "support/glass_volume.h"
#include "support/look.h"
#include "support/shader_lib.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

constexpr double kRadius = 9;

volume::Volume ball(float roughness, const char* metal = nullptr) {
    TestVolume scene(ivec3(24));
    scene.add("sdf", [](dvec3 p) { return glm::length(p - 12.0) - kRadius; });
    scene.constant("ior", metal ? 1 : 1.5);
    volume::Volume volume = scene.take();
    setBoundary(volume, "sdf", roughness, metal);
    return volume;
}

Params furnace(const ivec2& size, int samples) {
    Params params = sharp::sharply(parallel({12, 12, 80}, dvec3(12), 20, size));
    params.background = dvec3(1);
    params.samples = samples;
    params.maxDepth = 64;
    params.aovs = {"exit_direction"};
    return params;
}

} // namespace

TEST(RoughView, NoLightIsLostInAWhiteRoom) {
    for (const float roughness : {0.1f, 0.5f}) {
        const ivec2 size(24, 24);
        const Look look(ball(roughness), furnace(size, 1));
        double sum = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                EXPECT_NEAR(look.at("R", x, y), 1, 0.01) << roughness;
                sum += look.at("R", x, y) / (size.x * size.y);
            }
        EXPECT_NEAR(sum, 1, 1e-3) << roughness;
        EXPECT_LT(look.counter("light_dropped_by_depth"), 1e-3);
    }
}

TEST(RoughView, ALittleRoughnessLooksLikeNone) {
    const ivec2 size(16, 16);
    const Look smooth(ball(0), furnace(size, 1)), rough(ball(1e-4f), furnace(size, 1));
    for (int y = 4; y < 12; ++y)
        for (int x = 4; x < 12; ++x)
            // Facets lean by 1e-4, times what a ball makes of it.
            EXPECT_LT(glm::length(rough.direction(x, y) - smooth.direction(x, y)), 3e-3);
}

TEST(RoughView, SamplesSpreadAndTheSameOnesRepeat) {
    // A hemisphere that shines: behind a rough ball its edge is soft.
    const image::Image sky = sharp::mapOf([](dvec3 d) { return dvec3(d.y > 0 ? 1 : 0); });
    const ivec2 size(12, 12);
    const auto seen = [&](float roughness, int samples) {
        Params params = furnace(size, samples);
        return Look(ball(roughness), params, sky);
    };
    const Look few = seen(0.3f, 4), again = seen(0.3f, 4), many = seen(0.3f, 64),
               more = seen(0.3f, 256), smooth = seen(0, 64);
    EXPECT_EQ(few.picture.pixels, again.picture.pixels);
    const auto offBetween = [&](const Look& a, const Look& b) {
        double sum = 0;
        for (int y = 2; y < 10; ++y)
            for (int x = 2; x < 10; ++x) {
                const double off = a.at("R", x, y) - b.at("R", x, y);
                sum += off * off / 64;
            }
        return std::sqrt(sum);
    };
    // Of 64 samples by chance the mean is off by up to 0.5/8; evenly laid it is less.
    EXPECT_LT(offBetween(many, more), 0.03);
    EXPECT_LT(offBetween(many, more), 0.5 * offBetween(few, more));
    EXPECT_GT(offBetween(smooth, more), 0.1);
}

TEST(MetalView, AMirrorBallSendsEachRayWhereItMust) {
    const ivec2 size(16, 16);
    const Look look(ball(0, "gold"), furnace(size, 1));
    const optics::NamedMetal& gold = *optics::findMetal("gold");
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const double right = (x + 0.5 - 8) * 20 / 16, up = -(y + 0.5 - 8) * 20 / 16;
            const double square = right * right + up * up;
            if (square > 0.95 * 0.95 * kRadius * kRadius) continue;
            const dvec3 normal = dvec3(right, up, std::sqrt(kRadius * kRadius - square)) / kRadius;
            const dvec3 in(0, 0, -1), wanted = in - 2 * glm::dot(in, normal) * normal;
            EXPECT_LT(sharp::degreesBetween(look.direction(x, y), wanted), 0.02);
            expectNear(look.colour(x, y),
                       shader_lib::conductorReflectance(normal.z, gold.index, gold.extinction),
                       2e-5);
            EXPECT_EQ(look.at("A", x, y), 1);
        }
}

TEST(MetalView, RoughMetalTakesOnlyWhatItAbsorbs) {
    // Of silver nearly nothing, though light meets several facets.
    const ivec2 size(16, 16);
    const Look look(ball(0.5f, "silver"), furnace(size, 4));
    for (int y = 4; y < 12; ++y)
        for (int x = 4; x < 12; ++x) {
            EXPECT_LT(look.at("R", x, y), 1);
            EXPECT_GT(look.at("R", x, y), 0.95);
        }
}

TEST(MetalView, ItNeedsNoIndexAndNoLight) {
    const Look look(ball(0, "iron"), furnace({4, 4}, 1));
    EXPECT_TRUE(look.plan.warnings.empty());
    for (const Effect& effect : look.plan.effects) EXPECT_TRUE(effect.on || effect.name != "metal");
}
