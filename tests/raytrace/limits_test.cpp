// What is no scene to trace, or hardly one: holes, nothing in view, grazing rays.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "camera/irradiance.h"
#include "image/lat_long.h"
#include "raytrace/scenes.h"
#include "raytrace/surface.h"

#include <gtest/gtest.h>

namespace eikonal::raytrace {
namespace {

using glm::dvec3;

TEST(Limits, AHoleIsSeenThrough) {
    mesh::TriangleMesh open = mesh::icosphere(1, 3);
    open.triangles.resize(open.triangles.size() / 2);
    Params params = lookingFrom({1, 2, 4}, 48);
    params.background = dvec3(1);
    params.aovs = allAovs();
    Stats stats;
    const image::Image picture = render(params, {glass(smooth(open))}, std::nullopt, stats, {});
    image::checkFinite(picture, "picture");
    EXPECT_GT(stats.counter("light_lost_by_holes"), 0.01);
    for (size_t i = 0; i < picture.area(); ++i) EXPECT_NEAR(colourAt(picture, i).x, 1, 1e-6);
    // Closed, nothing is lost.
    Stats closed;
    render(params, {glass(smooth(mesh::icosphere(1, 3)))}, std::nullopt, closed, {});
    EXPECT_EQ(closed.counter("light_lost_by_holes"), 0);
}

TEST(Limits, NothingInViewIsTheBackground) {
    Params params = lookingFrom({0, 0, 4}, 8);
    params.camera.target = {0, 0, 8};
    params.background = {1, 2, 3};
    const image::Image picture = rendered(params, {glass(mesh::icosphere(1, 1))});
    for (size_t i = 0; i < picture.area(); ++i) {
        EXPECT_EQ(colourAt(picture, i), dvec3(1, 2, 3));
        EXPECT_EQ(picture.plane(3)[i], 0);
    }
    EXPECT_EQ(rendered(params, {}).pixels, picture.pixels);
}

TEST(Limits, WrongParamsAreNamed) {
    const std::vector<Body> none;
    Params params = lookingFrom({0, 0, 4}, 8);
    params.aovs = {"steps"};
    EXPECT_THROW(rendered(params, none), UsageError);
    params = lookingFrom({0, 0, 4}, 8);
    params.samples = 0;
    EXPECT_THROW(rendered(params, none), UsageError);
    params = lookingFrom({0, 0, 4}, 8);
    params.maxDepth = 0;
    EXPECT_THROW(rendered(params, none), UsageError);
    params = lookingFrom({0, 0, 4}, 8);
    const std::vector<Body> many(kMostClearBodies + 1, glass(mesh::icosphere(1, 0)));
    EXPECT_THROW(rendered(params, many), UsageError);
}

TEST(Limits, ASmoothNormalIsTurnedTowardsARayThatItLooksAwayFrom) {
    const dvec3 face(0, 0, 1), along = glm::normalize(dvec3(1, 0, -0.05));
    const dvec3 smooth = glm::normalize(dvec3(0.3, 0, 1)); // looks away by 14°
    ASSERT_GT(glm::dot(smooth, along), 0);
    const dvec3 turned = facingNormal(smooth, face, along);
    EXPECT_LT(glm::dot(turned, along), 0);
    EXPECT_NEAR(glm::dot(turned, along), 0, 1e-8);
    EXPECT_NEAR(glm::length(turned), 1, 1e-12);
    // One that faces the ray stays, on the ray's side.
    EXPECT_EQ(facingNormal(-face, face, along), face);
}

TEST(Limits, APathWithinABodyStaysWithin) {
    const dvec3 inward(0, 0, -1), out = glm::normalize(dvec3(1, 0, 0.1));
    const dvec3 kept = keptWithin(out, inward);
    EXPECT_GT(glm::dot(kept, inward), 0);
    EXPECT_NEAR(degreesBetween(kept, {1, 0, 0}), 0, 0.06);
    EXPECT_EQ(keptWithin(inward, inward), inward);
}

// A map that is bright above: E(n) = π (a + 2/3 b n_y) of L = a + b y, exactly.
TEST(Limits, AMapLightsMattSurfacesByTheirNormals) {
    image::Image map(64, 32);
    std::vector<float> pixels;
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 64; ++column) {
            const double y = image::directionOf({(column + 0.5) / 64, (row + 0.5) / 32}).y;
            for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<float>(2 + (c + 1) * 0.5 * y));
        }
    map.addChannels({"R", "G", "B"}, pixels, 3);
    const camera::Irradiance irradiance = camera::irradianceFrom({}, map);
    const double kPi = std::acos(-1.0);
    for (const dvec3& n : {dvec3(0, 1, 0), dvec3(0, -1, 0), glm::normalize(dvec3(1, 2, -3))}) {
        const dvec3 expected = kPi * (2.0 + 2.0 / 3 * dvec3(0.5, 1, 1.5) * n.y);
        // The grid's cells are h = 0.1: their sums are right to h² / 24.
        EXPECT_LT(glm::distance(camera::irradianceOn(irradiance, n), expected), 0.01);
    }
    const camera::Background blue{{0, 0, 3}, 0, false};
    EXPECT_NEAR(camera::irradianceOn(camera::irradianceFrom(blue, std::nullopt), {0, 0, 1}).z,
                3 * kPi, 1e-12);
}

} // namespace
} // namespace eikonal::raytrace
