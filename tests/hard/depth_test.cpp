// Hard cases of media: optical depths from 1e-8 to 1e3 a voxel, none at all, sharp phase functions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"
#include "support/shader_lib.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr int kSize = 16;

volume::Volume fog(const dvec3& absorption, const dvec3& scattering = dvec3(0), double g = 0) {
    TestVolume scene(ivec3(kSize), 0.5);
    scene.constantVector("absorption", absorption);
    scene.constantVector("scattering", scattering);
    scene.constant("anisotropy", g);
    return scene.take();
}

/// Along −z through the middle; 8 units of way.
Params through(double background = 1) {
    Params params = parallel({4, 4, 40}, dvec3(4), 1);
    params.background = dvec3(background);
    return params;
}

dvec3 transmittance(const Look& look) {
    return {look.at("transmittance.R"), look.at("transmittance.G"), look.at("transmittance.B")};
}

/// One direction's light in a medium that scatters it once.
Look lobe(double g, const dvec3& towards) {
    TestVolume scene(ivec3(8));
    scene.constantVector("scattering", dvec3(0.001));
    scene.constantVector("fluence", dvec3(2));
    scene.constantVector("light_direction", {0, 0, 1});
    scene.constant("anisotropy", g);
    const dvec3 d = glm::normalize(towards); // of travel, to the eye
    return {scene.take(), parallel(4.0 + 30.0 * d, dvec3(4), 1, {1, 1}, across(d))};
}

} // namespace

TEST(HardDepth, TransmittanceFollowsTheExponentialFromThinToBlack) {
    // Sixteen steps of a float each: 1 − T to 1e-6, and T to 1e-4 of itself even where it is 1e-30.
    // In grey and, three at a time, in colour.
    const double depths[] = {0, 1e-8, 1e-4, 1e-2, 0.1, 1, 4, 12, 40, 60};
    for (const double depth : depths)
        for (const bool colour : {false, true}) {
            const dvec3 wanted = colour ? dvec3(depth, 0.5 * depth, 0.1 * depth) : dvec3(depth);
            const Look look(fog(wanted / 8.0), through());
            for (int c = 0; c < 3; ++c) {
                const double t = std::exp(-wanted[c]), found = transmittance(look)[c];
                EXPECT_NEAR(found, t, std::min(1e-6, 1e-4 * t)) << depth << " " << c;
                // What a float holds of 1 − T to 1e-3: from an optical depth of 1e-3 on.
                if (wanted[c] >= 1e-3) {
                    EXPECT_NEAR(1 - found, 1 - t, 1e-3 * (1 - t)) << depth;
                }
                EXPECT_NEAR(look.colour()[c], t, std::min(1e-6, 1e-4 * t)) << depth;
            }
        }
}

TEST(HardDepth, AThousandPerVoxelIsBlackAndTakesAllAtOnce) {
    for (const double perVoxel : {30.0, 1e3, 1e6}) {
        const Look look(fog(dvec3(2 * perVoxel)), through());
        EXPECT_LT(look.at("R"), 1e-30) << perVoxel; // the shortest series stops at 1e-7 a voxel
        const lightsim::Lit lit(fog(dvec3(2 * perVoxel)),
                                lightsim::paramsOf({lightsim::beam({0, 0, -1})}));
        const Energy& energy = lit.stats.energy;
        // A photon is dropped at 1e-5 of its power, and what is left of it booked as lost.
        EXPECT_NEAR(energy.absorbed[0], energy.entered[0], 2e-5 * energy.entered[0]) << perVoxel;
        EXPECT_LE(energy.escaped[0], 1e-7 * energy.entered[0]);
        // In the first voxel ∫ exp(−σ s) ds / h = 1 / depth; fixed point of 2^16 per photon and
        // voxel holds that to 1 in 65 at a depth of 1e3, and no more beyond 65,536.
        if (perVoxel <= 1e3) {
            EXPECT_NEAR(lit.fluence({8, 8, 15}), 1 / perVoxel, 0.02 / perVoxel);
        }
        EXPECT_LE(lit.fluence({8, 8, 13}), 1e-5);
    }
}

TEST(HardDepth, WhatAThinMediumTakesIsNotLostInRounding) {
    // 1 − exp(−x) to 1e-3 of itself, from x = 1e-8 over the whole way: photons book what they leave
    // behind apart from what they have left.
    for (const double depth : {1e-8, 1e-6, 1e-3, 0.5, 3.0})
        for (const bool colour : {false, true}) {
            const dvec3 sigma = dvec3(depth, colour ? 0.3 * depth : depth, depth) / 8.0;
            const lightsim::Lit lit(fog(sigma), lightsim::paramsOf({lightsim::beam({0, 0, 1})}));
            for (size_t c = 0; c < 3; ++c) {
                const double wanted = -std::expm1(-8 * sigma[static_cast<int>(c)]);
                EXPECT_NEAR(lit.stats.energy.absorbed[c] / lit.stats.energy.entered[c], wanted,
                            1e-3 * wanted)
                    << depth << " " << c;
            }
        }
}

TEST(HardDepth, AMediumOfNothingDoesNothing) {
    const Look look(fog(dvec3(0)), through(3));
    EXPECT_EQ(look.colour(), dvec3(3));
    EXPECT_EQ(transmittance(look), dvec3(1));
    EXPECT_EQ(look.at("A"), 0);
    const lightsim::Lit lit(fog(dvec3(0)), lightsim::paramsOf({lightsim::beam({0, 1, 0})}));
    EXPECT_EQ(lit.stats.energy.absorbed[0] + lit.stats.energy.scattered[0], 0);
    forEachVoxel(ivec3(kSize),
                 [&](ivec3 p) { ASSERT_NEAR(lit.fluence(p), 1, 1e-5); }); // fixed point
}

TEST(HardDepth, AlbedoNoneAndOneTakeTheSameAndBookItApart) {
    for (const double sigma : {1e-6, 0.1, 10.0}) {
        const auto run = [&](double albedo) {
            return lightsim::Lit(fog(dvec3(sigma * (1 - albedo)), dvec3(sigma * albedo)),
                                 lightsim::paramsOf({lightsim::beam({1, 2, 3})}));
        };
        const lightsim::Lit black = run(0), white = run(1), half = run(0.5);
        const Energy &a = black.stats.energy, &b = white.stats.energy, &c = half.stats.energy;
        EXPECT_EQ(a.scattered[0], 0);
        EXPECT_EQ(b.absorbed[0], 0);
        // The same sums times the same coefficient, halves of it being exact.
        EXPECT_DOUBLE_EQ(a.absorbed[0], b.scattered[0]);
        EXPECT_NEAR(c.absorbed[0], 0.5 * a.absorbed[0], 1e-6 * a.absorbed[0]);
        EXPECT_DOUBLE_EQ(c.absorbed[0], c.scattered[0]);
        EXPECT_EQ(black.result.fluence.values, white.result.fluence.values);
        // Single scattering: a medium that scatters all is as dark behind as one that absorbs all.
        EXPECT_EQ(Look(fog(dvec3(sigma)), through()).at("R"),
                  Look(fog(dvec3(0), dvec3(sigma)), through()).at("R"));
    }
}

TEST(HardDepth, SharpLobesKeepTheirHeightInFloat) {
    for (const double g : {0.999, -0.999, 0.9999, 0.0})
        for (const dvec3& way : {dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0.01, 0, 1),
                                 dvec3(0, 1, -1)}) {
            const Look look = lobe(g, way);
            // The lobe of the float that the file holds.
            const double held = static_cast<float>(g), cosine = glm::normalize(way).z;
            const double phase = (1 - held * held) / (4 * kPi) /
                                 std::pow((1 - held) * (1 - held) + 2 * held * (1 - cosine), 1.5);
            const double depth = 0.001 * look.at("path_length.V");
            const double wanted = 2 * phase * -std::expm1(-depth);
            // 1 − g is held to 6e-8/1e-4, and counts thrice; a cosine near 1 is held to 6e-8, of a
            // lobe 1 − g² wide: at 0.01 to the side 1e-3 of 5e-5.
            EXPECT_NEAR(look.at("R"), wanted, 4e-3 * wanted) << g << " " << way.x << " " << way.z;
        }
}

TEST(HardDepth, EveryLobeScattersWhatItTakesAndNoMore) {
    // ∫ p dω = 1, ∫ p cosθ dω = g: by the tangent of half the angle, even in whose logarithm a lobe
    // of 1e-3 is wide.
    for (const double g : {0.999, 0.5, 0.0, -0.7, -0.999}) {
        double all = 0, forward = 0;
        const int kParts = 20000;
        for (int i = 0; i < kParts; ++i) {
            const double u = -16 + 32 * (i + 0.5) / kParts, t = std::exp(u);
            const double cosine = (1 - t * t) / (1 + t * t);
            const double area = 2 * kPi * 4 * t * t / ((1 + t * t) * (1 + t * t)) * 32 / kParts;
            const double p = shader_lib::henyeyGreenstein(g, cosine);
            all += p * area;
            forward += p * cosine * area;
        }
        EXPECT_NEAR(all, 1, 1e-6) << g; // midpoints of a smooth integrand
        EXPECT_NEAR(forward, g, 1e-6) << g;
    }
}
