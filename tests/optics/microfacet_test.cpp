// Rough interfaces and metals, in double, against integrals and figures from elsewhere.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/materials.h"
#include "support/shader_lib.h"

#include <gtest/gtest.h>

using namespace eikonal::shader_lib;

namespace {

constexpr double kPi = 3.141592653589793;

/// Evenly in the unit square, by the plastic number.
vec2 placeOf(int i) {
    return glm::fract(vec2(0.5) +
                      static_cast<double>(i) * vec2(0.7548776662466927, 0.5698402909980532));
}

/// A ray that comes down at that angle to the interface's normal, |w| = n.
vec3 arriving(double degrees, double n) {
    const double angle = degrees * kPi / 180;
    return n * vec3(std::sin(angle), 0, -std::cos(angle));
}

/// GGX's density of normals, by the cosine with z (Walter et al. 2007, eq. 33).
double densityOf(double cosine, double alpha) {
    const double c2 = cosine * cosine, t = c2 * (alpha * alpha - 1) + 1;
    return alpha * alpha / (kPi * t * t);
}

/// The share of light from `towards` that one facet alone sends back, by the integral over facets:
/// with Smith's joint shadowing 1 / (1 + Λi + Λo) (Heitz 2014, eq. 99).
double singlyReflected(vec3 towards, double n, double beyond, double alpha) {
    const int rings = 400, spokes = 400;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < spokes; ++j) {
            // Facets by equal steps of the angle: ring weights sin θ.
            const double theta = 0.5 * kPi * (i + 0.5) / rings, phi = 2 * kPi * (j + 0.5) / spokes;
            const vec3 m(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
            const double faces = glm::dot(towards, m);
            const vec3 back = 2 * faces * m - towards;
            if (faces <= 0 || back.z <= 0) continue;
            const double shadow = 1 / (1 + smithLambda(towards, alpha) + smithLambda(back, alpha));
            const double R = dielectricAt(-n * towards, m, n, beyond).reflectance;
            sum += R * densityOf(m.z, alpha) * shadow * faces / towards.z * std::sin(theta) *
                   (0.5 * kPi / rings) * (2 * kPi / spokes);
        }
    return sum;
}

} // namespace

TEST(Microfacet, SmithsLambdaShadowsAsMuchAsFacetsFaceAway) {
    // Facets seen from a direction cover as much of the view as the plane does: ∫ D ⟨m·o⟩ dm G1 =
    // cos θ.
    for (const double alpha : {0.1, 0.5, 1.0})
        for (const double degrees : {0.0, 40.0, 80.0}) {
            const vec3 towards = -arriving(degrees, 1);
            double sum = 0;
            const int rings = 600, spokes = 600;
            for (int i = 0; i < rings; ++i)
                for (int j = 0; j < spokes; ++j) {
                    const double theta = 0.5 * kPi * (i + 0.5) / rings;
                    const double phi = 2 * kPi * (j + 0.5) / spokes;
                    const vec3 m(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta));
                    sum += densityOf(m.z, alpha) * std::max(glm::dot(towards, m), 0.0) *
                           std::sin(theta) * (0.5 * kPi / rings) * (2 * kPi / spokes);
                }
            // Midpoints of the narrowest distribution: some 1e-4.
            EXPECT_NEAR(sum / (1 + smithLambda(towards, alpha)), towards.z, 1e-3) << alpha;
        }
}

TEST(Microfacet, FacetsAreSeenAsOftenAsTheyShow) {
    // The mean of the cosine of facets that are seen from 60°, from the integral.
    const double alpha = 0.4;
    const vec3 towards = -arriving(60, 1);
    double shown = 0, wanted = 0;
    for (int i = 0; i < 800; ++i)
        for (int j = 0; j < 800; ++j) {
            const double theta = 0.5 * kPi * (i + 0.5) / 800, phi = 2 * kPi * (j + 0.5) / 800;
            const vec3 m(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
            const double share =
                densityOf(m.z, alpha) * std::max(glm::dot(towards, m), 0.0) * std::sin(theta);
            shown += share;
            wanted += share * m.z;
        }
    double found = 0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const vec3 m = visibleNormal(towards, alpha, placeOf(i));
        EXPECT_NEAR(glm::length(m), 1, 1e-12);
        EXPECT_GE(glm::dot(m, towards), -1e-9);
        found += m.z / count;
    }
    EXPECT_NEAR(found, wanted / shown, 1e-3);
}

TEST(Microfacet, WhatOneFacetSendsBackIsTheIntegrals) {
    // What leaves after a single facet, of glass from both sides; that which meets more is not in
    // it.
    for (const double alpha : {0.2, 0.5})
        for (const double degrees : {10.0, 70.0})
            for (const auto& [n, beyond] : {std::pair(1.0, 1.5), std::pair(1.5, 1.0)}) {
                const vec3 w = arriving(degrees, n);
                double found = 0;
                const int count = 40000;
                for (int i = 0; i < count; ++i) {
                    const vec3 facet = firstFacet(w, alpha, placeOf(i));
                    const Dielectric made = dielectricAt(w, facet, n, beyond);
                    const Facing back =
                        facingFrom(w, made.reflected, false, alpha, pcgHash(uint(i)));
                    const bool alone = nextHeight(normalize(back.w), back.height, alpha,
                                                  numberAfter(back.seed, 1)) < 0;
                    found += alone ? made.reflectance / count : 0;
                }
                const double wanted = singlyReflected(-w / n, n, beyond, alpha);
                // Chance: √(R/count), 0.002 for a share of 0.2.
                EXPECT_NEAR(found, wanted, 0.004) << alpha << " " << degrees << " " << n;
            }
}

TEST(Microfacet, AllLeaveOnTheirSideWithItsIndex) {
    for (const double alpha : {0.05, 0.5, 1.0})
        for (const double degrees : {0.0, 45.0, 85.0})
            for (int i = 0; i < 3000; ++i) {
                const vec3 w = arriving(degrees, 1.5);
                const Dielectric made = dielectricAt(w, firstFacet(w, alpha, placeOf(i)), 1.5, 1.2);
                for (const bool on : {false, true}) {
                    if (on && made.reflectance == 1) continue;
                    const Facing ray =
                        amongFacets(facingFrom(w, on ? made.refracted : made.reflected, on, alpha,
                                               pcgHash(uint(i))),
                                    1.5, 1.2, alpha);
                    EXPECT_GT(ray.beyond ? -ray.w.z : ray.w.z, 0);
                    EXPECT_NEAR(glm::length(ray.w), ray.beyond ? 1.2 : 1.5, 1e-3);
                }
            }
}

TEST(Microfacet, LightGoesBothWaysAlike) {
    // Of even light on either side as much must go through from one as from the other, per n² (L/n²
    // is what is conserved): the share through, over directions by their cosine, is n²-fold from
    // the thinner side.
    const double alpha = 0.5;
    const auto through = [&](double n, double beyond) {
        double sum = 0;
        const int count = 60000;
        for (int i = 0; i < count; ++i) {
            const double sine = std::sqrt((i + 0.5) / count); // by the cosine
            const vec3 w = n * vec3(sine, 0, -std::sqrt(1 - sine * sine));
            const vec2 place = placeOf(i);
            const Dielectric made = dielectricAt(w, firstFacet(w, alpha, place), n, beyond);
            for (const bool on : {false, true}) {
                if (on && made.reflectance == 1) continue;
                const Facing ray = amongFacets(facingFrom(w, on ? made.refracted : made.reflected,
                                                          on, alpha, pcgHash(uint(i))),
                                               n, beyond, alpha);
                if (ray.beyond) sum += (on ? 1 - made.reflectance : made.reflectance) / count;
            }
        }
        return sum;
    };
    const double in = through(1, 1.5), out = through(1.5, 1);
    // Chance: 0.002. The shares are 0.9 and 0.4.
    EXPECT_NEAR(in, 2.25 * out, 0.01);
}

TEST(Metal, ReflectsAsItsFiguresSay) {
    // n and k by hand at normal incidence: ((n − 1)² + k²) / ((n + 1)² + k²).
    const vec3 n(0.2, 1.5, 2.9), k(3.4, 0, 3.0);
    const vec3 ahead = conductorReflectance(1, n, k);
    for (int c = 0; c < 3; ++c) {
        const double less = (n[c] - 1) * (n[c] - 1) + k[c] * k[c];
        const double more = (n[c] + 1) * (n[c] + 1) + k[c] * k[c];
        EXPECT_NEAR(ahead[c], less / more, 1e-12);
    }
    // Without k it is glass, at any angle.
    for (const double cosine : {0.9, 0.5, 0.1}) {
        const vec3 w(std::sqrt(1 - cosine * cosine), 0, -cosine);
        EXPECT_NEAR(conductorReflectance(cosine, n, k).y,
                    dielectricAt(w, vec3(0, 0, 1), 1, 1.5).reflectance, 1e-12);
    }
    EXPECT_NEAR(conductorReflectance(0, n, k).x, 1, 1e-12);
}

TEST(Metal, GoldIsYellowAndSilverNearlyWhite) {
    using eikonal::optics::findMetal;
    const auto ahead = [](const char* name) {
        const auto* metal = findMetal(name);
        return conductorReflectance(1, metal->index, metal->extinction);
    };
    for (const char* yellow : {"gold", "copper"}) {
        const vec3 found = ahead(yellow);
        EXPECT_GT(found.x, found.y + 0.1) << yellow;
        EXPECT_GT(found.y, found.z + 0.03) << yellow;
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(ahead("Silver")[c], 0.95);
        EXPECT_NEAR(ahead("aluminum")[c], 0.92, 0.02);
        EXPECT_NEAR(ahead("iron")[c], 0.51, 0.03);
    }
    EXPECT_EQ(findMetal("cheese"), nullptr);
}

TEST(Coat, EvenLightIsReflectedAsTheIntegralSays) {
    for (const double m : {1.05, 1.33, 1.5, 2.4}) {
        double sum = 0;
        const int count = 20000;
        for (int i = 0; i < count; ++i) { // by the cosine
            const double sine = std::sqrt((i + 0.5) / count);
            const vec3 w(sine, 0, -std::sqrt(1 - sine * sine));
            sum += dielectricAt(w, vec3(0, 0, 1), 1, m).reflectance / count;
        }
        EXPECT_NEAR(evenReflectance(m), sum, 2e-4) << m; // the last ring grazes
    }
}

TEST(Coat, AWhiteBaseSendsAllOfItOut) {
    for (const double m : {1.2, 1.5, 2.0}) {
        EXPECT_NEAR(albedoOfCoated(vec3(1), m).x, 1, 1e-12);
        EXPECT_EQ(albedoOfCoated(vec3(0), m).x, 0);
        // A grey one less than it would bare: what comes down again is absorbed more often.
        EXPECT_LT(albedoOfCoated(vec3(0.5), m).x, 0.5);
    }
}
