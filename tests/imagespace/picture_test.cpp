// Pictures in image space: light, absorption, what is not met, and that nothing is ever no number.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "imagespace/pictures.h"

using namespace eikonal;
using namespace eikonal::imagespace;
using glm::dvec3;

namespace {

Body ball() {
    return {smooth(mesh::icosphere(1, 4)), std::vector<float>(2562, 2.0f)};
}

// What is reflected and what is refracted are all of the light: glass in even light is not seen.
TEST(MeshPicture, OfClearGlassInAWhiteRoomIsWhite) {
    for (const Method method : {Method::dir, Method::isr, Method::sir})
        for (const double ior : {0.7, 1.0, 1.5, 2.4}) {
            Params params = paramsFor(48, false);
            params.background = dvec3(1);
            params.method = method;
            params.ior = ior;
            const image::Image picture = pictureOf(params, ball());
            for (int c = 0; c < 3; ++c)
                for (const float value : picture.plane(static_cast<size_t>(c)))
                    EXPECT_NEAR(value, 1, 1e-5);
        }
}

// Beer and Lambert, on the way that is found: through the middle it is the diameter.
TEST(MeshPicture, DimsByTheLengthOfTheWay) {
    Params params = paramsFor(33, true);
    params.background = dvec3(1);
    params.absorption = {0.1, 0.5, 2};
    params.searchSteps = 16;
    const image::Image picture = pictureOf(params, ball());
    const double once = std::pow((1.5 - 1) / (1.5 + 1), 2);
    const dvec3 seen = valueAt(picture, "", 16, 16, "RGB");
    const dvec3 through = valueAt(picture, "transmittance", 16, 16, "RGB");
    for (int c = 0; c < 3; ++c) {
        const double kept = std::exp(-2 * params.absorption[c]);
        EXPECT_NEAR(seen[c], once + (1 - once) * kept, 2e-3);
        EXPECT_NEAR(through[c], (1 - once) * (1 - once) * kept, 2e-3);
    }
    EXPECT_TRUE(picture.find("AG"));
}

TEST(MeshPicture, OfNothingInViewIsWhatSurroundsIt) {
    Params params = paramsFor(16, false);
    params.camera.target = {0, 0, 8}; // the ball is behind the eye
    params.background = {1, 2, 3};
    for (const Method method : {Method::dir, Method::isr, Method::sir}) {
        params.method = method;
        const image::Image picture = pictureOf(params, ball());
        for (int x = 0; x < 16; ++x) {
            EXPECT_EQ(valueAt(picture, "", x, 7, "RGB"), dvec3(1, 2, 3));
            EXPECT_EQ(valueAt(picture, "exit_position", x, 7), params.camera.eye);
        }
        for (const float alpha : picture.plane(3)) EXPECT_EQ(alpha, 0);
    }
}

// Extreme indices, a camera that touches, a wide angle, a tiny and a huge ball.
TEST(MeshPicture, HoldsNothingButNumbers) {
    for (const Method method : {Method::dir, Method::isr, Method::sir})
        for (const double ior : {0.1, 0.9, 1.0, 1.000001, 10.0})
            for (const double near : {1.0001, 1.2, 50.0}) {
                Params params = paramsFor(24, false);
                params.camera.eye = {0, 0, near};
                params.camera.fov = 150;
                params.method = method;
                params.ior = ior;
                params.background = dvec3(1);
                params.absorption = {0, 1, 1000};
                params.samples = 2;
                EXPECT_NO_THROW(checkFinite(pictureOf(params, ball()), "picture"));
            }
}

TEST(MeshPicture, IsTheSameEachTime) {
    Params params = paramsFor(64, false);
    params.background = {0.2, 0.5, 1};
    params.samples = 3;
    const image::Image one = pictureOf(params, ball()), two = pictureOf(params, ball());
    EXPECT_EQ(one.pixels, two.pixels);
}

// A renderer that has drawn something else makes the same picture as a new one.
TEST(MeshPicture, DoesNotDependOnTheFrameBefore) {
    Params params = paramsFor(64, false);
    params.background = dvec3(1);
    params.absorption = dvec3(1);
    Stats stats;
    Renderer renderer(device(), params, std::nullopt, stats);
    renderer.setScene({mesh::boxShape({-1, -1, -1}, {1, 1, 1}), {}}, {});
    renderer.render({});
    renderer.setScene(ball(), {});
    EXPECT_EQ(renderer.render({}).pixels, pictureOf(params, ball()).pixels);
    EXPECT_EQ(stats.counter("frames"), 2);
}

// The mean of a pixel's rays is that of finer pixels' rays, where four fall on the same places.
TEST(MeshPicture, SamplesCoverEdges) {
    Params params = paramsFor(32, true);
    params.background = dvec3(1);
    params.absorption = dvec3(3);
    params.samples = 16;
    const image::Image picture = pictureOf(params, ball());
    double covered = 0;
    for (const float alpha : picture.plane(3)) covered += static_cast<double>(alpha);
    const double pixel = 2.5 / 32;
    // The area of a disc of radius 1; an icosphere's outline is 0.1 % within it, and 16 samples
    // leave less than 1 % of error over all of the edge.
    EXPECT_NEAR(covered * pixel * pixel, 3.14159, 0.02);
}

TEST(MeshPicture, RefusesWhatIsOpenOrLooksInward) {
    mesh::TriangleMesh open = mesh::icosphere(1, 2);
    open.triangles.pop_back();
    EXPECT_THROW(requireClosed(open, "open.obj"), DataError);
    EXPECT_THROW(requireClosed(mesh::turnedInsideOut(mesh::icosphere(1, 2)), "in.obj"), DataError);
    EXPECT_NO_THROW(requireClosed(mesh::icosphere(1, 2), "ball.obj"));
}

TEST(MeshPicture, KnowsWhetherTheEyeIsWithin) {
    const mesh::TriangleMesh ball = mesh::icosphere(1, 2);
    EXPECT_TRUE(isWithin(ball, {0.1, 0.2, 0.3}));
    EXPECT_FALSE(isWithin(ball, {0.9, 0.9, 0.9})); // in the box, outside the ball
    EXPECT_FALSE(isWithin(ball, {2, 0, 0}));
}

} // namespace
