// The shaders' pure functions, in double, against cases solved on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/octree.h"
#include "support/shader_lib.h"

#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace eikonal::shader_lib;

namespace {

constexpr double kPi = 3.141592653589793;

/// ∫ f(c) dω over the sphere, for a phase function that peaks at c = sign: with 1 − sign c = 2 s⁴
/// the peak, however sharp, is spread over many of Simpson's intervals.
double overSphere(double sign, const std::function<double(double)>& f) {
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        const double c = sign * (1 - 2 * s * s * s * s);
        sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * 8 * s * s * s * f(c);
    }
    return 2 * kPi * sum / (3.0 * n);
}

} // namespace

TEST(Phase, HenyeyGreensteinHoldsAllLightAndItsMeanCosine) {
    for (const double g : {-0.999, -0.9, -0.3, 0.0, 0.2, 0.76, 0.99, 0.999}) {
        const double sign = g < 0 ? -1 : 1;
        const auto p = [g](double c) { return henyeyGreenstein(g, c); };
        // Simpson over 20000 intervals: 1e-9 at the sharpest, where the peak is 0.02 of s wide.
        EXPECT_NEAR(overSphere(sign, p), 1, 1e-8) << g;
        EXPECT_NEAR(overSphere(sign, [&](double c) { return c * p(c); }), g, 1e-8) << g;
    }
}

TEST(Phase, HenyeyGreensteinByHand) {
    // g = 0 is 1/(4π); forward it is (1 + g)/(4π (1 − g)²), backward (1 − g)/(4π (1 + g)²).
    EXPECT_DOUBLE_EQ(henyeyGreenstein(0, 0.3), 1 / (4 * kPi));
    for (const double g : {0.5, -0.5, 0.999, -0.999}) {
        const double forward = (1 + g) / (4 * kPi * (1 - g) * (1 - g));
        const double backward = (1 - g) / (4 * kPi * (1 + g) * (1 + g));
        // Relative: 1 − g of a g of three decimals is a few roundings of 1, over 1e-3.
        EXPECT_NEAR(henyeyGreenstein(g, 1) / forward, 1, 1e-12) << g;
        EXPECT_NEAR(henyeyGreenstein(g, -1) / backward, 1, 1e-12) << g;
    }
}

TEST(Phase, HenyeyGreensteinIsFiniteForCosinesRoundedPastOne) {
    for (const double g : {0.999999, -0.999999})
        for (const double c : {1 + 1e-7, -1 - 1e-7}) {
            EXPECT_TRUE(std::isfinite(henyeyGreenstein(g, c))) << g << " " << c;
            EXPECT_GT(henyeyGreenstein(g, c), 0) << g << " " << c;
        }
}

TEST(Attenuation, AgreesWithTheExponential) {
    for (double x = 1e-9; x <= 100; x *= 1.07) {
        const Attenuation a = attenuationOf(x);
        // The text promises 3e-7 to x = 4 and 6e-4 at x = 10; in between the series' last term
        // left out, y⁸/9!, grows with its power.
        const double relative = x <= 4 ? 3e-7 : x <= 10 ? 6e-4 : 0;
        const double mean = -std::expm1(-x) / x, through = std::exp(-x);
        if (x <= 10) {
            EXPECT_NEAR(a.through / through, 1, relative) << x;
            EXPECT_NEAR(a.mean / mean, 1, relative) << x;
        } else {
            // Past that, absolute: what is left is at most e^−10, of which 1e-2 may be wrong.
            EXPECT_NEAR(a.through, through, 5e-7) << x;
            EXPECT_NEAR(a.mean * x, 1 - through, 5e-7) << x;
        }
        EXPECT_GE(a.through, 0) << x;
        EXPECT_LE(a.mean, 1) << x;
    }
    EXPECT_EQ(attenuationOf(0).through, 1);
    EXPECT_EQ(attenuationOf(0).mean, 1);
}

TEST(Attenuation, WhatIsLeftAndWhatIsAbsorbedAreAll) {
    // e^−x + x mean = 1: energy is not made or lost by the approximation. To float's 6e-8, since
    // two ways to the same number are joined at x = 1.
    for (double x = 1e-6; x < 16; x *= 1.1) {
        const Attenuation a = attenuationOf(x);
        EXPECT_NEAR(a.through + x * a.mean, 1, 6e-8) << x;
    }
}

TEST(Box, SpansByHand) {
    const vec3 low(-1, -2, -3), high(1, 2, 3);
    const auto expectSpan = [&](const vec3& x, const vec3& d, double enter, double leave) {
        const vec2 span = boxSpan(x, d, low, high);
        EXPECT_DOUBLE_EQ(span.x, enter);
        EXPECT_DOUBLE_EQ(span.y, leave);
    };
    const auto expectMiss = [&](const vec3& x, const vec3& d) {
        const vec2 span = boxSpan(x, d, low, high);
        EXPECT_GT(span.x, span.y) << x.x << " " << x.y << " " << x.z;
    };
    expectSpan({-5, 0, 0}, {1, 0, 0}, 4, 6); // along an axis
    expectSpan({5, 0, 0}, {-2, 0, 0}, 2, 3); // d need not be a unit vector
    expectSpan({0, 0, 0}, {0, 0, 1}, -3, 3); // from inside: entered behind
    expectSpan({-3, -4, -5}, {1, 1, 1}, 2, 4);
    expectSpan({-5, 2, 0}, {1, 0, 0}, 4, 6);   // in a face
    expectSpan({-5, 2, 3}, {1, 0, 0}, 4, 6);   // along an edge
    expectSpan({-2, 1, 0}, {1, 1, 0}, 1, 1);   // touching an edge
    expectSpan({-2, -3, -4}, {1, 1, 1}, 1, 3); // into a corner
    expectMiss({-5, 2.001, 0}, {1, 0, 0});
    expectMiss({-5, 0, 0}, {0, 1, 0});
    expectMiss({-2, 1.001, 0}, {1, 1, 0});
    expectMiss({0, 0, 4}, {1, 0, 0});
}

TEST(Box, TimesToLeaveByHand) {
    const vec3 low(-1, -2, -3), high(1, 2, 3);
    const auto time = [&](const vec3& x, const vec3& d) { return timeToLeave(x, d, low, high); };
    EXPECT_DOUBLE_EQ(time({0, 0, 0}, {1, 0, 0}), 1);
    EXPECT_DOUBLE_EQ(time({0, 0, 0}, {0, -0.5, 0}), 4);
    EXPECT_DOUBLE_EQ(time({0, 0, 0}, {1, 1, 1}), 1);
    EXPECT_DOUBLE_EQ(time({0.5, 1.75, 0}, {1, 1, 0}), 0.25);
    EXPECT_EQ(time({1, 0, 0}, {1, 0, 0}), 0);         // on a face, going out
    EXPECT_DOUBLE_EQ(time({1, 0, 0}, {-1, 0, 0}), 2); // and going in
    EXPECT_DOUBLE_EQ(time({1, 0, 0}, {0, 1, 0}), 2);  // and along it
    EXPECT_EQ(time({1, 2, 3}, {1, -1, -1}), 0);       // in a corner
    EXPECT_EQ(time({1.0000001, 0, 0}, {1, 0, 0}), 0); // never before now
}

TEST(LatLong, CardinalDirections) {
    const auto expectAt = [](const vec3& direction, double u, double v) {
        const vec2 found = latLongOf(direction);
        EXPECT_NEAR(found.x, u, 1e-15);
        EXPECT_NEAR(found.y, v, 1e-15);
    };
    expectAt({0, 0, 1}, 0.5, 0.5);   // the centre
    expectAt({1, 0, 0}, 0.25, 0.5);  // longitude +π/2
    expectAt({-1, 0, 0}, 0.75, 0.5); // longitude −π/2
    expectAt({0, 1, 0}, 0.5, 0);     // the top row
    expectAt({0, -1, 0}, 0.5, 1);    // the bottom row
    expectAt({0, std::sqrt(0.5), std::sqrt(0.5)}, 0.5, 0.25);
    EXPECT_NEAR(std::abs(latLongOf({1e-12, 0, -1}).x - 0.5), 0.5, 1e-12); // behind: at the seam
    EXPECT_EQ(latLongOf({0, 1.0000001, 0}).y, 0); // rounded past a unit vector, still on the map
}

TEST(Octree, LeavesAreReadAsTheyWerePacked) {
    using eikonal::lightsim::packLeaf;
    for (const int level : {0, 1, 9, 31})
        for (const float limit : {0.0f, 0.0625f, 1.0f, 7.9375f, 8.0f, 1.0e6f}) {
            const uint leaf = packLeaf(level, limit);
            EXPECT_EQ(leafLevel(leaf), static_cast<uint>(level));
            EXPECT_EQ(leafLimit(leaf), static_cast<double>(limit));
        }
    EXPECT_EQ(leafLimit(packLeaf(3, 0.99f)), 0.9375); // cut to sixteenths, never longer
    EXPECT_EQ(leafLimit(packLeaf(3, 1e9f)), 1e6);
    EXPECT_EQ(leafLimit(packLeaf(3, -1)), 0);
}

TEST(Octree, DistancesToALeafsFaceByHand) {
    // Voxels i reach from i − ½ to i + ½, so leaves of level 2 from 4 k − ½ to 4 k + 3½.
    const auto distance = [](const vec3& x, const vec3& d, uint level) {
        vec3 signs, inverses;
        for (int i = 0; i < 3; ++i) {
            signs[i] = d[i] < 0 ? -1 : 1;
            inverses[i] = 1 / std::max(std::abs(d[i]), 1e-12);
        }
        return distanceToLeafFace(x, signs, inverses, level);
    };
    // The function looks a ten-thousandth of a voxel ahead, but measures from x itself: only
    // double's rounding is left.
    const double kRounding = 1e-12;
    EXPECT_NEAR(distance({1, 1, 1}, {1, 0, 0}, 0), 0.5, kRounding);
    EXPECT_NEAR(distance({1, 1, 1}, {-1, 0, 0}, 0), 0.5, kRounding);
    EXPECT_NEAR(distance({1, 1, 1}, {1, 0, 0}, 2), 2.5, kRounding);
    EXPECT_NEAR(distance({1, 1, 1}, {0, -1, 0}, 2), 1.5, kRounding);
    EXPECT_NEAR(distance({5, 6, 7}, {0, 0.6, 0.8}, 2), 0.5 / 0.8, kRounding);
    EXPECT_NEAR(distance({1, 1, 1}, {0.5, 0.5, std::sqrt(0.5)}, 1), 0.5 / std::sqrt(0.5),
                kRounding);
    // On a face, either way: the whole leaf ahead.
    EXPECT_NEAR(distance({3.5, 1, 1}, {1, 0, 0}, 2), 4, kRounding);
    EXPECT_NEAR(distance({3.5, 1, 1}, {-1, 0, 0}, 2), 4, kRounding);
    EXPECT_NEAR(distance({-0.5, 1, 1}, {-1, 0, 0}, 0), 1, kRounding);
    // In a corner the nearest face ahead counts.
    EXPECT_NEAR(distance({3.5, 3.5, 3.5}, {0.8, 0.6, 0}, 2), 4 / 0.8, kRounding);
}

TEST(Random, PcgHashIsThePublishedOne) {
    // The published recipe (Jarzynski and Olano 2020, listing of pcg), in 64 bits and reduced by
    // hand, so that it shares no operator with the shader's.
    const auto published = [](std::uint64_t v) {
        const std::uint64_t kTwo32 = 4294967296u;
        const std::uint64_t state = (v * 747796405u % kTwo32 + 2891336453u) % kTwo32;
        const std::uint64_t shifted = state / (std::uint64_t{1} << (state / 268435456u + 4));
        const std::uint64_t word = (shifted ^ state) * 277803737u % kTwo32;
        return static_cast<std::uint32_t>(word / 4194304u ^ word);
    };
    for (std::uint64_t v : {0u, 1u, 2u, 12345u, 4294967295u})
        EXPECT_EQ(pcgHash(static_cast<uint>(v)), published(v)) << v;
    // Worked by hand for 0: the state is the increment, 2891336453.
    EXPECT_EQ(pcgHash(0), 129708002u);
}

TEST(Random, NumbersAreUniform) {
    // Sixteen bins of 2^16 hashes: a bin's standard deviation is √(n p (1 − p)) = 62; 5 of them are
    // passed once in two million.
    std::array<int, 16> bins{};
    double sum = 0;
    for (uint i = 0; i < 1 << 16; ++i) {
        const double u = uniformOf(pcgHash(i));
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        ++bins[static_cast<size_t>(u * 16)];
        sum += u;
    }
    for (const int count : bins) EXPECT_NEAR(count, 4096, 310);
    // The mean's standard deviation is √(1/12/n) = 0.0011.
    EXPECT_NEAR(sum / 65536, 0.5, 0.0056);
    EXPECT_EQ(uniformOf(0xffffffffu), 1 - std::ldexp(1, -24));
}

TEST(Fresnel, NormalIncidenceByHand) {
    // ((n − 1)/(n + 1))²: 4 % of glass's light comes back, from either side.
    for (const double n : {1.000001, 1.33, 1.5, 2.42}) {
        const Dielectric in = dielectricAt({0, 0, 1}, {0, 0, -1}, 1, n);
        const double r = (n - 1) / (n + 1);
        // 1e-15 of 1, where the difference of two indices is all that is left.
        EXPECT_NEAR(in.reflectance, r * r, 1e-15);
        EXPECT_NEAR(in.refracted.z, n, 1e-14);
        EXPECT_EQ(in.reflected.z, -1);
        const Dielectric out = dielectricAt({0, 0, n}, {0, 0, 1}, n, 1);
        EXPECT_NEAR(out.reflectance, r * r, 1e-15);
        EXPECT_NEAR(out.refracted.z, 1, 1e-14);
    }
}

TEST(Fresnel, BrewstersAngleReflectsHalfOfOnePolarisation) {
    // tanθ = n: r_p = 0, and refracted and reflected are at right angles; r_s = −cos 2θ.
    const double n = 1.5, angle = std::atan(n);
    const vec3 w(std::sin(angle), -std::cos(angle), 0);
    const Dielectric made = dielectricAt(w, {0, 1, 0}, 1, n);
    EXPECT_NEAR(made.reflectance, 0.5 * std::pow(std::cos(2 * angle), 2), 1e-15);
    EXPECT_NEAR(glm::dot(made.refracted, made.reflected), 0, 1e-15);
}

TEST(Fresnel, SnellsLawAndItsWayBack) {
    for (const double n1 : {1.0, 1.5})
        for (const double n2 : {1.0, 1.34, 2.42})
            for (double angle = 0.05; angle < 1.57; angle += 0.1) {
                const vec3 w = n1 * vec3(std::sin(angle), -std::cos(angle), 0);
                const Dielectric made =
                    dielectricAt(w, {0, -1, 0}, n1, n2); // the normal on the far side
                const double sine = n1 * std::sin(angle) / n2;
                if (sine > 1) {
                    EXPECT_EQ(made.reflectance, 1);
                    continue;
                }
                EXPECT_NEAR(glm::length(made.refracted), n2, 1e-14);
                EXPECT_NEAR(glm::length(made.reflected), n1, 1e-14);
                EXPECT_NEAR(made.refracted.x / n2, sine, 1e-14);
                EXPECT_LE(made.refracted.y, 0);
                // Light on its way back sees the same boundary.
                const Dielectric back = dielectricAt(-made.refracted, {0, 1, 0}, n2, n1);
                EXPECT_NEAR(back.reflectance, made.reflectance, 1e-12);
                EXPECT_NEAR(glm::distance(back.refracted, -w), 0, 1e-12);
            }
}

TEST(Fresnel, OneIndexOnBothSidesIsNoBoundary) {
    const vec3 w(0.6, -0.8, 0);
    const Dielectric made = dielectricAt(w, {0, 1, 0}, 1, 1);
    EXPECT_NEAR(made.reflectance, 0, 1e-30);
    EXPECT_NEAR(glm::distance(made.refracted, w), 0, 1e-15);
}

TEST(Dip, FindsAParabolasLeastValue) {
    // f = (t − 0.3)² − 0.01 is positive at both ends and below 0 in between.
    const vec2 dip = dipOf(0.08, -0.6, 0.48, 1.4);
    EXPECT_NEAR(dip.x, 0.3, 1e-14);
    EXPECT_NEAR(dip.y, -0.01, 1e-14);
}

TEST(Dip, IsNoneWhereTheCubicOnlyFallsOrRises) {
    EXPECT_EQ(dipOf(1, -1, 0, -1).x, 0);  // a line
    EXPECT_EQ(dipOf(0, 1, 1, 1).x, 0);    // a line
    EXPECT_EQ(dipOf(0, 1, 0.1, -1).x, 0); // a hill
}

TEST(Spline, BendsAreTheSlopesDerivative) {
    const double e = 1e-6; // central differences of a quadratic are exact but for rounding, 1e-10
    for (double t = 0.1; t < 1; t += 0.2)
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(splineBends(t)[i],
                        (splineSlopes(t + e)[i] - splineSlopes(t - e)[i]) / (2 * e), 1e-9);
}
