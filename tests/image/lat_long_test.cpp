// Directions of lat-long maps, and what they show there.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/lat_long.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace eikonal::image;
using glm::dvec2;
using glm::dvec3;

namespace {

void expectNear(const dvec3& found, const dvec3& wanted) {
    EXPECT_LT(glm::distance(found, wanted), 1e-6) << found.x << " " << found.y << " " << found.z;
}

/// Four by two pixels, whose red counts them.
Image counting(Envmap envmap) {
    Image map(4, 2);
    std::vector<float> samples;
    for (int i = 0; i < 8; ++i) samples.insert(samples.end(), {static_cast<float>(i), 1, 2});
    map.addChannels({"R", "G", "B"}, samples, 3);
    map.envmap = envmap;
    return map;
}

} // namespace

TEST(LatLong, DirectionsAreOpenExrs) {
    // ImfEnvmap.h: the middle is +Z, row 0 +Y, longitude +π/2, which lies left of it, +X.
    expectNear(directionOf({0.5, 0.5}), {0, 0, 1});
    expectNear(directionOf({0.25, 0.5}), {1, 0, 0});
    expectNear(directionOf({0.75, 0.5}), {-1, 0, 0});
    expectNear(directionOf({0, 0.5}), {0, 0, -1});
    expectNear(directionOf({0.3, 0}), {0, 1, 0});
    expectNear(directionOf({0.5, 0.75}), {0, -std::sqrt(0.5), std::sqrt(0.5)});
}

TEST(LatLong, MapsAreTurnedAndStoodUp) {
    expectNear(mapFromWorld(90, false) * dvec3(0, 0, 1), {1, 0, 0}); // what was at +X is at +Z
    expectNear(mapFromWorld(90, false) * dvec3(0, 1, 0), {0, 1, 0});
    expectNear(mapFromWorld(0, true) * dvec3(0, 0, 1), {0, 1, 0});
    expectNear(mapFromWorld(0, true) * dvec3(1, 0, 0), {1, 0, 0});
}

TEST(LatLong, RadianceIsBilinearAndGoesRoundTheSeam) {
    const Image centres = counting(Envmap::none);
    EXPECT_NEAR(radianceAt(centres, {0.125, 0.25}).x, 0, 1e-12); // the middle of the first pixel
    EXPECT_NEAR(radianceAt(centres, {0.25, 0.25}).x, 0.5, 1e-12);
    EXPECT_NEAR(radianceAt(centres, {0.125, 0.5}).x, 2, 1e-12);
    EXPECT_NEAR(radianceAt(centres, {0, 0.25}).x, 1.5,
                1e-12); // half of the last, half of the first
    EXPECT_NEAR(radianceAt(centres, {0.999999, 0.25}).x, 1.5, 1e-4);
    EXPECT_NEAR(radianceAt(centres, {0.125, 0}).x, 0, 1e-12); // clamped at the pole
    const Image edges = counting(Envmap::latLong);
    EXPECT_NEAR(radianceAt(edges, {0, 0}).x, 0, 1e-12);
    EXPECT_NEAR(radianceAt(edges, {1.0 / 3, 1}).x, 5, 1e-12);
    EXPECT_NEAR(radianceAt(edges, {0.5, 0}).x, 1.5, 1e-12);
    EXPECT_NEAR(radianceAt(edges, {0.5, 0}).z, 2, 1e-12);
}
