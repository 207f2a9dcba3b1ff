// Hard cases of dynamic range: light of any power, in any colour, all of it through one voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"

using namespace eikonal;
using namespace eikonal::hard;
using glm::dvec3;
using glm::ivec3;
using lightsim::beam;
using lightsim::lamp;
using lightsim::Light;
using lightsim::Lit;
using lightsim::paramsOf;

namespace {

/// A blurred ball that dims in colours.
TestVolume sceneVolume(int size = 16) {
    TestVolume out = ballIn(size, 0.35 * size, 1.4, 1);
    out.constantVector("absorption", {0.02, 0.03, 0.04});
    out.constantVector("scattering", {0.01, 0.02, 0.015});
    out.constant("anisotropy", 0.5);
    return out;
}

/// What an eye sees of the scene under the light of a run.
image::Image pictureOf(const Lit& lit) {
    TestVolume out = sceneVolume();
    volume::Volume volume = out.take();
    volume.put("fluence", volume.domain(), lit.result.fluence, {});
    volume.put("light_direction", volume.domain(), lit.result.direction, {});
    return view::Look(std::move(volume), view::perspective({30, 20, 40}, dvec3(8), 25, {12, 8}))
        .picture;
}

/// Samples of the colour channels.
std::vector<float> colours(const image::Image& picture) {
    std::vector<float> out;
    for (const char* channel : {"R", "G", "B"}) {
        const auto plane = picture.plane(*picture.find(channel));
        out.insert(out.end(), plane.begin(), plane.end());
    }
    return out;
}

std::vector<Light> times(std::vector<Light> lights, double factor) {
    for (Light& light : lights) light.rgb *= factor;
    return lights;
}

const std::vector<Light> kLights = {beam({1, -2, 0.5}, {1, 2, 3}), lamp({-5, 9, 30}, {90, 80, 70})};

} // namespace

TEST(HardRange, APowerOfTwoOfLightIsThatPowerOfEverythingBitForBit) {
    const Lit reference(sceneVolume().volume(), paramsOf(kLights, 1 << 12));
    const auto seen = colours(pictureOf(reference));
    for (const int exponent : {-60, -26, -1, 1, 26, 60}) {
        const double factor = std::exp2(exponent);
        const auto scale = static_cast<float>(factor);
        const Lit lit(sceneVolume().volume(), paramsOf(times(kLights, factor), 1 << 12));
        for (size_t i = 0; i < reference.result.fluence.values.size(); ++i)
            ASSERT_EQ(lit.result.fluence.values[i], reference.result.fluence.values[i] * scale);
        ASSERT_EQ(lit.result.direction.values, reference.result.direction.values);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_EQ(lit.stats.energy.absorbed[c], reference.stats.energy.absorbed[c] * factor);
        const auto scaled = colours(pictureOf(lit));
        for (size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(scaled[i], seen[i] * scale);
    }
}

RC_GTEST_PROP(HardRange, LightTimesAFactorIsEverythingTimesTheFactor, ()) {
    const double factor = drawnByMagnitude(1e-8, 1e8);
    const Lit reference(sceneVolume().volume(), paramsOf(kLights, 1 << 10));
    const Lit lit(sceneVolume().volume(), paramsOf(times(kLights, factor), 1 << 10));
    // Each light's factor is rounded to float, times an integer, and added to the other's: four
    // roundings of 6e-8; the picture's path adds as many.
    for (size_t i = 0; i < reference.result.fluence.values.size(); ++i) {
        const double wanted = factor * reference.result.fluence.values[i];
        RC_ASSERT(std::abs(lit.result.fluence.values[i] - wanted) <= 1e-6 * wanted);
    }
    const auto seen = colours(pictureOf(reference)), scaled = colours(pictureOf(lit));
    for (size_t i = 0; i < seen.size(); ++i)
        RC_ASSERT(std::abs(scaled[i] - factor * seen[i]) <= 2e-6 * factor * seen[i]);
}

RC_GTEST_PROP(HardRange, TwoLightsGiveTheSumOfEachAlone, ()) {
    const Light a = beam(drawnDirection(), dvec3(drawnByMagnitude(1e-3, 1e3), 1, 2));
    const Light b =
        lamp(8.0 + drawn(2, 40) * drawnDirection(), dvec3(1, drawnByMagnitude(1e-3, 1e3), 3));
    const Lit first(sceneVolume().volume(), paramsOf({a}, 1 << 10));
    const Lit second(sceneVolume().volume(), paramsOf({b}, 1 << 10));
    const Lit both(sceneVolume().volume(), paramsOf({a, b}, 1 << 10));
    for (size_t i = 0; i < both.result.fluence.values.size(); ++i) {
        const double sum =
            static_cast<double>(first.result.fluence.values[i]) + second.result.fluence.values[i];
        RC_ASSERT(std::abs(both.result.fluence.values[i] - sum) <= 1e-6 * sum); // one addition
    }
    for (size_t c = 0; c < 3; ++c) {
        const double sum = first.stats.energy.absorbed[c] + second.stats.energy.absorbed[c];
        RC_ASSERT(std::abs(both.stats.energy.absorbed[c] - sum) <= 1e-12 * sum); // doubles
    }
}

TEST(HardRange, AMillionPhotonsThroughOneVoxelAddUp) {
    // Down a column of one voxel's width, and onto the one voxel of a ball's focus.
    TestVolume column({1, 1, 12});
    column.constantVector("scattering", {0.01, 0.02, 0.03});
    const Lit lit(column.volume(), paramsOf({beam({0, 0, 1}, {1, 1e3, 1e-3})}, 1 << 20));
    for (int z = 0; z < 12; ++z)
        for (int c = 0; c < 3; ++c) {
            const double sigma = 0.01 * (c + 1);
            const double mean = std::exp(-sigma * z) * -std::expm1(-sigma) / sigma;
            const double power = lit.stats.energy.entered[static_cast<size_t>(c)];
            // Fixed point of 2^11 and more a photon and voxel, dithered: 2^20 photons average it.
            EXPECT_NEAR(lit.fluence({0, 0, z}, c), power * mean, 1e-4 * power * mean);
        }
    TestVolume focus(ivec3(14)); // Luneburg's
    focus.index([](dvec3 p) {
        const double r = glm::length(p - 7.0) / 6;
        return std::sqrt(2 - std::min(r * r, 1.0));
    });
    const Lit gathered(focus.volume(), paramsOf({beam({0, 0, 1})}, 1 << 18));
    // Every photon's way lies in the box, and is that long or, bent, a little longer.
    const double ways = gathered.total() / gathered.stats.energy.entered[0];
    EXPECT_GT(ways, 14 * (1 - 1e-3));
    EXPECT_LT(ways, 16);
    double most = 0;
    forEachVoxel(ivec3(14), [&](ivec3 p) { most = std::max(most, gathered.fluence(p)); });
    EXPECT_GT(most, 30); // of 113 voxels² of light
}

TEST(HardRange, ColoursFarApartKeepTheirRatios) {
    const dvec3 rgb(1e6, 1, 1e-6);
    for (const bool colour : {false, true}) {
        TestVolume out = ballIn(16, 6, 1.4, 1);
        out.constantVector("scattering", colour ? dvec3(0.01, 0.02, 0.03) : dvec3(0.02));
        const Lit even(out.volume(), paramsOf({beam({1, 2, 3})}));
        const Lit lit(out.volume(), paramsOf({beam({1, 2, 3}, rgb)}));
        forEachVoxel(ivec3(16), [&](ivec3 p) {
            for (int c = 0; c < 3; ++c)
                // Each channel has a sum and a factor of its own: two roundings.
                ASSERT_NEAR(lit.fluence(p, c) / rgb[c], even.fluence(p, c),
                            2e-7 * even.fluence(p, c));
        });
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(lit.stats.energy.entered[c] / rgb[static_cast<int>(c)],
                        even.stats.energy.entered[c], 1e-12 * even.stats.energy.entered[c]);
    }
    // And through the eye.
    TestVolume lit(ivec3(8));
    lit.constantVector("scattering", {0.01, 0.02, 0.03});
    lit.constantVector("fluence", rgb);
    const view::Look look(lit.take(), view::parallel({4, 4, 40}, dvec3(4), 1));
    for (int c = 0; c < 3; ++c) {
        const double wanted = rgb[c] / (4 * kPi) * -std::expm1(-0.08 * (c + 1));
        EXPECT_NEAR(look.colour()[c], wanted, 1e-5 * wanted); // eight steps in floats
    }
}
