// A picture behind the scene, and how far the scene turns what is seen of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/boundary.h"
#include "support/ground_stage.h"
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;

namespace {

/// So many pixels, by their place from the upper left corner.
image::Image pictureOf(int width, int rows, const std::function<dvec3(int x, int y)>& colour) {
    image::Image picture(width, rows);
    std::vector<float> samples;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) samples.push_back(static_cast<float>(colour(x, y)[c]));
    picture.addChannels({"R", "G", "B"}, samples, 3);
    return picture;
}

dvec3 mixed(int x, int y) {
    return {x + 1, y + 1, (7 * x + 11 * y) % 5};
}

/// Air without anything in it.
volume::Volume nothing(const glm::ivec3& size = glm::ivec3(8)) {
    return TestVolume(size).constant("ior", 1).take();
}

/// An index that rises along x: light along z is bent to +x.
volume::Volume slope(double rise) {
    return TestVolume({32, 8, 32})
        .index([=](const dvec3& p) { return 1.2 + rise * (p.x - 16); })
        .take();
}

} // namespace

TEST(Plate, IsSeenPixelForPixelBehindNothing) {
    for (const bool isParallel : {false, true}) {
        Params params = isParallel ? parallel({4, 4, 60}, {4, 4, 0}, 9, {12, 9})
                                   : perspective({4, 4, 60}, {5, 3, 0}, 30, {12, 9});
        params.plate = Plate{pictureOf(12, 9, mixed), 100};
        const Look look(nothing(), params);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 12; ++x) {
                expectNear(look.colour(x, y), mixed(x, y), 1e-4 * mixed(x, y).y + 1e-3);
                EXPECT_EQ(look.at("A", x, y), 0);
            }
    }
}

TEST(Plate, CoversAViewOfAnotherShape) {
    // Its 12 columns are as wide as the view's 4 pixels, or its 4 rows as high as the view's 12.
    Params params = parallel({4, 4, 60}, {4, 4, 0}, 4, {4, 4});
    params.plate = Plate{pictureOf(12, 4, mixed), 100};
    const Look wide(nothing(), params);
    for (int x = 0; x < 4; ++x) expectNear(wide.colour(x, 2), mixed(x + 4, 2), 2e-3);
    params.plate = Plate{pictureOf(4, 12, mixed), 100};
    const Look high(nothing(), params);
    for (int y = 0; y < 4; ++y) expectNear(high.colour(2, y), mixed(2, y + 4), 2e-3);
}

TEST(Plate, EndsOrGoesOn) {
    Params params = parallel({4, 4, 60}, {4, 4, 0}, 8, {8, 8});
    params.background = dvec3(0.25, 0.5, 0.75);
    params.plate = Plate{pictureOf(4, 4, mixed), 100, 4, false};
    const Look ends(nothing(), params);
    expectNear(ends.colour(3, 3), mixed(1, 1), 2e-3);
    for (const glm::ivec2 at : {glm::ivec2(1, 3), {6, 3}, {3, 1}, {3, 6}})
        expectNear(ends.colour(at.x, at.y), params.background, 1e-6);
    params.plate->endless = true;
    const Look goesOn(nothing(), params);
    expectNear(goesOn.colour(0, 3), mixed(0, 1), 2e-3);
    expectNear(goesOn.colour(7, 7), mixed(3, 3), 2e-3);
}

TEST(Plate, IsNotSeenBackwards) {
    // A ball of metal before a plate mirrors what is on the eye's side: nothing.
    TestVolume ball(glm::ivec3(24));
    ball.constant("ior", 1).add(
        "sdf", [](const dvec3& p) { return glm::length(p - 12.0) - 8; }, 4);
    volume::Volume volume = ball.take();
    setBoundary(volume, "sdf", 0, "silver");
    Params params = perspective({12, 12, 90}, {12, 12, 0}, 16, {9, 9});
    params.plate = Plate{pictureOf(2, 2, [](int, int) { return dvec3(1000); }), 200};
    const Look look(std::move(volume), params);
    EXPECT_GT(look.at("A", 4, 4), 0);
    EXPECT_LT(look.colour(4, 4).x, 1e-3);
    EXPECT_GT(look.colour(0, 0).x, 999);
}

TEST(Plate, IsShiftedByWhatBendsLightBeforeIt) {
    // A ramp along x tells where on the plate a ray ends.
    const int width = 200;
    Params params = parallel({16, 4, 60}, {16, 4, 0}, 1, {8, 8});
    params.plate =
        Plate{pictureOf(width, 4, [](int x, int) { return dvec3(x + 0.5, 0, 1); }), 90, 0.5, true};
    const double perUnit = 4 / 0.5; // pixels of the plate
    const Look look(slope(0.004), params);
    double least = 1e9;
    for (int x = 0; x < 8; ++x) {
        const dvec3 at = look.place(x, 4), along = look.direction(x, 4);
        const double plane = 60 - 90;
        const double wanted = at.x + along.x * (plane - at.z) / along.z;
        const double found = 16 + (look.colour(x, 4).x - 0.5 * width) / perUnit;
        EXPECT_NEAR(found, wanted, 1e-3);
        const double straight = 16 + (x - 3.5) / 8;
        least = std::min(least, found - straight);
        EXPECT_EQ(look.at("A", x, 4), 1);
    }
    EXPECT_GT(least, 2);
}

TEST(Plate, HidesTheGroundBehindItAndIsHiddenByWhatIsBefore) {
    GroundStage stage;
    stage.ground = {0, dvec3(0.5), 0};
    const volume::Volume lit = stage.make("directional:0,-1,0:2");
    const auto look = [&](double distance) {
        Params params = perspective({99, 40, 60}, {99, 0, 0}, 20, {8, 8});
        params.plate = Plate{pictureOf(8, 8, [](int, int) { return dvec3(9); }), distance};
        return Look(scene::Files(lit), params);
    };
    expectNear(look(20).colour(4, 1), dvec3(9), 1e-5);
    const dvec3 ground = look(500).colour(4, 1);
    EXPECT_GT(ground.x, 0.1);
    EXPECT_LT(ground.x, 2 / 3.1);
}

TEST(Deflection, IsNoneWhereNothingBends) {
    const Look look(nothing(), perspective({14, 9, 60}, {5, 3, 0}, 30, {16, 16}));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            EXPECT_NEAR(look.at("deflection.X", x, y), 0, 1e-7);
            EXPECT_NEAR(look.at("deflection.Y", x, y), 0, 1e-7);
        }
}

TEST(Deflection, IsTheAnglesInThePicturesAxes) {
    // Snell's law in a layered medium: n sin of the angle with the layers' normal stays. Light that
    // goes along a layer turns to +x; the camera is rolled by 90 degrees at first, then by 180.
    const auto turn = [](const dvec3& up, const char* channel) {
        const Look look(slope(0.01), parallel({16, 4, 60}, {16, 4, 0}, 1, {1, 1}, up));
        const double angle = std::atan2(look.direction().x, -look.direction().z);
        EXPECT_GT(angle, 0.1);
        EXPECT_NEAR(std::abs(look.at(channel)), angle, 1e-6);
        return look.at(channel);
    };
    EXPECT_GT(turn({0, 1, 0}, "deflection.X"), 0);
    EXPECT_LT(turn({0, -1, 0}, "deflection.X"), 0);
    EXPECT_GT(turn({1, 0, 0}, "deflection.Y"), 0);
    EXPECT_LT(turn({-1, 0, 0}, "deflection.Y"), 0);
    const Look look(slope(0.01), parallel({16, 4, 60}, {16, 4, 0}, 1, {1, 1}, {1, 0, 0}));
    EXPECT_NEAR(look.at("deflection.X"), 0, 1e-6);
}
