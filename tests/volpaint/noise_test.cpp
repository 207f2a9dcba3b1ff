// The noise that volpaint multiplies by.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint/noise.h"

#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <random>

namespace eikonal {

using paint::fractalNoise;
using paint::gradientNoise;

TEST(Noise, IsZeroAtLatticePointsAndWithinItsRange) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-50, 50);
    double sum = 0, squares = 0;
    const int count = 200000;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 x(place(random), place(random), place(random));
        EXPECT_EQ(gradientNoise(glm::floor(x), 3), 0);
        const double value = fractalNoise(x, 4, 3);
        EXPECT_LE(std::abs(value), 1);
        sum += value;
        squares += value * value;
    }
    // Values of places more than a spacing apart are independent: 1e6 cells, deviation 0.16.
    EXPECT_NEAR(sum / count, 0, 2e-3);
    EXPECT_GT(std::sqrt(squares / count), 0.1);
}

TEST(Noise, HasNoKinkAtLatticePlanes) {
    const double h = 1e-4;
    for (int k = 0; k < 200; ++k) {
        const glm::dvec3 x(k % 7, 0.37 + k * 0.61, 0.11 - k * 0.73), d(h, 0, 0);
        const double before = (gradientNoise(x, 0) - gradientNoise(x - d, 0)) / h;
        const double behind = (gradientNoise(x + d, 0) - gradientNoise(x, 0)) / h;
        EXPECT_NEAR(before, behind, 10 * h);
    }
}

TEST(Noise, IsAFunctionOfPlaceAndSeed) {
    double apart = 0, along = 0;
    for (int k = 0; k < 100; ++k) {
        const glm::dvec3 x = 0.37 * glm::dvec3(k, 2 * k + 1, 3 - k);
        EXPECT_EQ(fractalNoise(x, 3, 5), fractalNoise(x, 3, 5));
        apart += std::abs(fractalNoise(x, 3, 5) - fractalNoise(x, 3, 6));
        along += std::abs(fractalNoise(x, 3, 5) - fractalNoise(x + 256.0, 3, 5)); // no period
    }
    EXPECT_GT(apart, 5);
    EXPECT_GT(along, 5);
}

} // namespace eikonal
