// The judge's crystals against paper: the double image of a rhomb, balls, energy.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/crystal.h"
#include "judge/snell.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace judge;

namespace {

constexpr double kO = 1.6584, kE = 1.4864; // calcite at 589 nm

} // namespace

TEST(JudgeCrystal, ARhombDoublesByPaper) {
    // Cleaved calcite: the axis is 45.4° off the face's normal, and the e-ray at normal incidence
    // leaves it by tan δ = (n_o² − n_e²) s c/(n_e² c² + n_o² s²) (physics of any text: 6.22°, 0.109
    // of the thickness).
    for (const double degrees : {45.0, 45.4, 20.0}) {
        const double a = degrees * M_PI / 180;
        const Tensor calcite{kO, kE, {std::sin(a), 0, std::cos(a)}};
        int seen = 0;
        for (const LightWave& w :
             scattered(isotropicWave(1, {0, 0, 1}, {1, 1, 0}), {0, 0, 1}, {}, calcite)) {
            if (w.mode == 'i') continue;
            ++seen;
            if (w.mode == 'o') {
                EXPECT_LT(glm::length(w.ray - dvec3(0, 0, 1)), 1e-12);
                continue;
            }
            const double s = std::sin(a), c = std::cos(a);
            const double tangent =
                (kO * kO - kE * kE) * s * c / (kO * kO * s * s + kE * kE * c * c);
            // Of a negative crystal away from the axis.
            EXPECT_NEAR(w.ray.x / w.ray.z, -tangent, 1e-12);
        }
        EXPECT_EQ(seen, 2);
    }
}

TEST(JudgeCrystal, EnergyCloses) {
    const Tensor a{kO, kE, {0.3, -0.8, 0.52}}, b{2.616, 2.903, {0.7, 0.1, -0.7}};
    for (const char mode : {'o', 'e'})
        for (double tilt = -1.2; tilt < 1.2; tilt += 0.17) {
            const LightWave wave = crystalWave(a, mode, {std::sin(tilt), 0.2, std::cos(tilt)});
            if (wave.ray.z < 0) continue;
            for (const Tensor& beyond : {b, Tensor{}}) {
                double sum = 0;
                for (const LightWave& w : scattered(wave, {0, 0, 1}, a, beyond)) sum += w.power;
                EXPECT_NEAR(sum, 1, 1e-12) << mode << tilt;
            }
        }
}

TEST(JudgeCrystal, ABallOfNearlyOneIndexIsGlass) {
    // Axis across the plane of incidence: modes are s and p, as glass keeps them.
    const double n = 1.6584, off = 0.8;
    const Tensor medium{n, n + 1e-9, {0, 1, 0}};
    double first = 0;
    for (const LeftBall& ray : throughBall(medium, {0, 0, 0}, 1, {off, 0, -5}, {0, 0, 1}, 2)) {
        if (ray.course.size() != 1) continue;
        first += ray.power;
        const double turn = std::atan2(-ray.direction.x, ray.direction.z);
        EXPECT_NEAR(turn, ballDeflection(n, off), 1e-8);
    }
    EXPECT_NEAR(first, ballOrders(n, off)[1], 1e-8);
    EXPECT_NEAR(first, 0.8383, 5e-5);
}

TEST(JudgeCrystal, AnAskewAxisCostsCoherence) {
    // The figure that modes without their coherence give, where glass gives 0.8383.
    const double n = 1.6584;
    double first = 0;
    for (const LeftBall& ray :
         throughBall({n, n + 1e-7, {1, 1, 0}}, {0, 0, 0}, 1, {0.8, 0, -5}, {0, 0, 1}, 2))
        if (ray.course.size() == 1) first += ray.power;
    EXPECT_NEAR(first, 0.8313, 5e-5);
}
