// Directions against OpenEXR's own lat-long functions, and the corners of the convention.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/latlong.h"

#include <OpenEXR/ImfEnvmap.h>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace eikonal::image;

namespace {

std::vector<glm::dvec3> directions() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> all;
    for (int i = 0; i < 2000; ++i)
        all.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    return all;
}

void expectNear(glm::dvec2 found, glm::dvec2 wanted, double tolerance) {
    EXPECT_NEAR(found.x, wanted.x, tolerance);
    EXPECT_NEAR(found.y, wanted.y, tolerance);
}

} // namespace

TEST(LatLong, AxesLieWhereTheContractSays) {
    // 1e-15: a few roundings of numbers below 1.
    expectNear(latLongFromDirection({0, 0, 1}), {0.5, 0.5}, 1e-15);
    expectNear(latLongFromDirection({1, 0, 0}), {0.25, 0.5}, 1e-15); // longitude +π/2
    expectNear(latLongFromDirection({-1, 0, 0}), {0.75, 0.5}, 1e-15);
    expectNear(latLongFromDirection({0, 1, 0}), {0.5, 0}, 1e-15);
    expectNear(latLongFromDirection({0, -1, 0}), {0.5, 1}, 1e-15);
    expectNear(latLongFromDirection({0, 0, 0}), {0.5, 0.5}, 1e-15);
    // -Z is the seam; the sign of a zero x chooses the side.
    expectNear(latLongFromDirection({0.0, 0, -1}), {0, 0.5}, 1e-15);
    expectNear(latLongFromDirection({-0.0, 0, -1}), {1, 0.5}, 1e-15);
}

TEST(LatLong, AgreesWithOpenExrPixelForPixel) {
    const Imath::Box2i window({0, 0}, {511, 255});
    for (const glm::dvec3& d : directions()) {
        const Imath::V3f asFloat(static_cast<float>(d.x), static_cast<float>(d.y),
                                 static_cast<float>(d.z));
        const Imath::V2f theirs = Imf::LatLongMap::pixelPosition(window, asFloat);
        const glm::dvec2 ours = pixelFromLatLong(latLongFromDirection(d), {512, 256}, true);
        // Theirs is float: an angle has an error of about 3e-7 (of its rounding and that of the
        // direction, whose longitude is worse by 1 / cos(latitude)), times 511 / 2π pixels.
        const double horizontal = std::hypot(d.x, d.z);
        EXPECT_NEAR(theirs.x, ours.x, 1e-4 / std::max(horizontal, 1e-3));
        EXPECT_NEAR(theirs.y, ours.y, 1e-4);
        const Imath::V3f back = Imf::LatLongMap::direction(window, theirs);
        // 3e-6: a few float roundings of angles up to π.
        EXPECT_NEAR(back.x, d.x, 3e-6);
        EXPECT_NEAR(back.y, d.y, 3e-6);
        EXPECT_NEAR(back.z, d.z, 3e-6);
    }
}

TEST(LatLong, DirectionIsTheInverse) {
    for (const glm::dvec3& d : directions()) {
        // 1e-14: double roundings of angles up to π, far below any error of the formula.
        const glm::dvec3 back = directionFromLatLong(latLongFromDirection(3.0 * d));
        EXPECT_LT(glm::length(back - d), 1e-14);
    }
}

TEST(LatLong, PixelsLieOnTheEdgesOrWithinThem) {
    // Exact: small integers and halves.
    EXPECT_EQ(pixelFromLatLong({0, 0}, {8, 4}, true), glm::dvec2(0, 0));
    EXPECT_EQ(pixelFromLatLong({1, 1}, {8, 4}, true), glm::dvec2(7, 3));
    EXPECT_EQ(pixelFromLatLong({0, 0}, {8, 4}, false), glm::dvec2(-0.5, -0.5));
    EXPECT_EQ(pixelFromLatLong({1, 1}, {8, 4}, false), glm::dvec2(7.5, 3.5));
    EXPECT_EQ(pixelFromLatLong({0.5, 0.5}, {8, 4}, false), glm::dvec2(3.5, 1.5));
}
