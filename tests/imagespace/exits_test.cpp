// Where rays leave, and along which direction, beside what Snell's law says on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/pictures.h"

using namespace eikonal;
using namespace eikonal::imagespace;
using glm::dvec3;

namespace {

dvec3 refracted(const dvec3& d, const dvec3& normal, double n, double beyond) {
    const double across = glm::dot(d, normal), ratio = n / beyond;
    const dvec3 along = ratio * (d - across * normal);
    return along + (across < 0 ? -1.0 : 1.0) *
                       std::sqrt(std::max(1 - glm::dot(along, along), 0.0)) * normal;
}

/// Through a ball of radius 1 about the origin.
struct ThroughBall {
    bool hits = false;
    double impact = 0; ///< nearest distance of the ray's line to the middle
    dvec3 exit{0}, direction{0};
    double extent = 0; ///< of the chord
};
ThroughBall throughBall(const EyeRay& ray, double ior) {
    const double b = glm::dot(ray.start, ray.direction);
    const double square = b * b - glm::dot(ray.start, ray.start) + 1;
    if (square <= 0) return {};
    const dvec3 enter = ray.start + (-b - std::sqrt(square)) * ray.direction;
    const dvec3 within = refracted(ray.direction, enter, 1, ior);
    const double chord = -2 * glm::dot(enter, within);
    const dvec3 leave = enter + chord * within;
    return {true, std::sqrt(1 - square), leave, refracted(within, leave, ior, 1), chord};
}

/// Worst and mean angle off the exact direction [degree], of rays that pass the middle nearer than
/// `reach`.
struct Errors {
    double worst = 0, mean = 0, place = 0;
    int rays = 0;
};
Errors ballErrors(const Params& params, double reach) {
    const image::Image picture = pictureOf(params, {smooth(mesh::icosphere(1, 5)), {}});
    Errors errors;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const ThroughBall ball = throughBall(eyeRay(params.camera, x, y), params.ior);
            if (!ball.hits || ball.impact > reach) continue;
            const double off =
                degreesBetween(valueAt(picture, "exit_direction", x, y), ball.direction);
            errors.worst = std::max(errors.worst, off);
            errors.mean += off;
            errors.place = std::max(
                errors.place, glm::length(valueAt(picture, "exit_position", x, y) - ball.exit));
            ++errors.rays;
        }
    errors.mean /= errors.rays;
    return errors;
}

class BallExits : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Cameras, BallExits, testing::Bool(),
                         [](const auto& one) { return one.param ? "Parallel" : "Perspective"; });

// With a search to its end the way is exact but for the texels of the maps: at 160 pixels over 2.5
// radii a texel is 1/64, along the surface at 0.7 of the radius 1/45 or 1.3 degrees of normal, of
// which depths may be off by half.
TEST_P(BallExits, AreThoseOfTwoInterfaces) {
    Params params = paramsFor(160, GetParam());
    params.ior = 1.2;
    params.searchSteps = 20;
    const Errors errors = ballErrors(params, 0.7);
    EXPECT_GT(errors.rays, 4000);
    EXPECT_LT(errors.mean, 0.02);
    EXPECT_LT(errors.worst, 0.15);
    EXPECT_LT(errors.place, 0.02);
}

// The source's error bound: each step halves what is left of the range, until texels limit it.
TEST_P(BallExits, ComeNearerWithEachStep) {
    Params params = paramsFor(160, GetParam());
    params.ior = 1.2;
    double before = 1e9;
    for (const int steps : {1, 3, 5, 8}) {
        params.searchSteps = steps;
        const Errors errors = ballErrors(params, 0.7);
        EXPECT_LT(errors.mean, 0.75 * before) << steps;
        before = errors.mean;
    }
}

// Wyman's guess is exact through the middle and where the distances agree, as of a ball along the
// normal and no refraction; the search must not be worse than it.
TEST_P(BallExits, OfASearchAreNoWorseThanGuesses) {
    Params params = paramsFor(160, GetParam());
    params.ior = 1.5;
    params.searchSteps = 8;
    const Errors searched = ballErrors(params, 0.7);
    params.method = Method::isr;
    Body body{smooth(mesh::icosphere(1, 5)), {}};
    body.distances.assign(body.mesh.points.size(), 2.0f);
    const image::Image picture = pictureOf(params, body);
    double mean = 0;
    int rays = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const ThroughBall ball = throughBall(eyeRay(params.camera, x, y), params.ior);
            if (!ball.hits || ball.impact > 0.7) continue;
            mean += degreesBetween(valueAt(picture, "exit_direction", x, y), ball.direction);
            ++rays;
        }
    EXPECT_LT(searched.mean, mean / rays);
}

TEST(OneInterface, IsSnellsLaw) {
    Params params = paramsFor(64, false);
    params.method = Method::sir;
    params.ior = 1.33;
    const image::Image picture = pictureOf(params, {smooth(mesh::icosphere(1, 5)), {}});
    for (int x = 24; x < 40; ++x) {
        const EyeRay ray = eyeRay(params.camera, x, 30);
        const double b = glm::dot(ray.start, ray.direction);
        const dvec3 enter =
            ray.start +
            (-b - std::sqrt(b * b - glm::dot(ray.start, ray.start) + 1)) * ray.direction;
        // Of facets 2 degrees wide the interpolated normals are within a tenth of one.
        EXPECT_LT(degreesBetween(valueAt(picture, "exit_direction", x, 30),
                                 refracted(ray.direction, enter, 1, 1.33)),
                  0.1);
    }
}

// A plate with parallel faces turns no ray, and shifts it as on paper.
TEST(SlabExits, AreParallelToTheRaysThatEnter) {
    for (const bool parallel : {false, true}) {
        Params params = paramsFor(64, parallel);
        params.camera.eye = {1.5, 1, 3.5};
        params.searchSteps = 24;
        const Body slab{mesh::boxShape({-4, -4, -0.5}, {4, 4, 0.5}), {}};
        const image::Image picture = pictureOf(params, slab);
        for (int y = 4; y < 60; y += 5)
            for (int x = 4; x < 60; x += 5) {
                const EyeRay ray = eyeRay(params.camera, x, y);
                EXPECT_LT(degreesBetween(valueAt(picture, "exit_direction", x, y), ray.direction),
                          0.01);
                const dvec3 within = refracted(ray.direction, {0, 0, 1}, 1, 1.5);
                const dvec3 enter =
                    ray.start + ray.direction * ((0.5 - ray.start.z) / ray.direction.z);
                const dvec3 exit = enter - within / within.z;
                // Half a texel of depths on a face that is seen at up to 45 degrees.
                EXPECT_LT(glm::length(valueAt(picture, "exit_position", x, y) - exit), 0.06);
            }
    }
}

// All depths of its back are one: there is nothing to search between.
TEST(SlabExits, HoldWhereAllDepthsAreEqual) {
    Params params = paramsFor(32, true);
    const image::Image picture =
        pictureOf(params, {mesh::boxShape({-4, -4, -0.5}, {4, 4, 0.5}), {}});
    for (int x = 0; x < 32; ++x) {
        EXPECT_LT(degreesBetween(valueAt(picture, "exit_direction", x, 16), {0, 0, -1}), 1e-3);
        EXPECT_NEAR(valueAt(picture, "exit_position", x, 16).z, -0.5, 1e-4);
    }
}

} // namespace

TEST(Exits, DeflectionIsTheExitsAnglesInThePicturesAxes) {
    Params params = paramsFor(24, true); // along -Z, X to the right, Y up
    params.ior = 1.2;
    const image::Image picture = pictureOf(params, {smooth(mesh::icosphere(1, 5)), {}});
    double most = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const dvec3 exit = valueAt(picture, "exit_direction", x, y);
            const double right = std::atan2(exit.x, -exit.z), up = std::atan2(exit.y, -exit.z);
            const size_t at = static_cast<size_t>(y * picture.width + x);
            EXPECT_NEAR(picture.plane(*picture.find("deflection.X"))[at], right, 1e-6);
            EXPECT_NEAR(picture.plane(*picture.find("deflection.Y"))[at], up, 1e-6);
            most = std::max(most, right);
        }
    EXPECT_GT(most, 0.1);
}
