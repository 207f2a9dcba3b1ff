// Rays among layers beside rays traced exactly: total reflection, more than two interfaces, plates.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/pictures.h"
#include "raytrace/raytrace.h"

using namespace eikonal;
using namespace eikonal::imagespace;
using glm::dvec3;

namespace {

image::Image exactly(const Params& params, const Body& body,
                     const std::vector<Plate>& plates = {}) {
    raytrace::Params exact;
    static_cast<camera::Background&>(exact) = params;
    exact.camera = params.camera;
    exact.aovs = {"exit_direction", "position", "normal", "transmittance"};
    std::vector<raytrace::Body> bodies{
        {"body", body.mesh, params.ior, params.absorption, false, dvec3(0)}};
    for (const Plate& plate : plates)
        bodies.push_back({"plate", plate.mesh, 1, dvec3(0), true, plate.albedo});
    Stats stats;
    return raytrace::render(exact, bodies, std::nullopt, stats, {});
}

/// The share of the pixels on the body whose exit direction is within a degree of the exact one.
double shareRight(const Params& params, const Body& body) {
    const image::Image picture = pictureOf(params, body), truth = exactly(params, body);
    int right = 0, all = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if (picture.plane(3)[static_cast<size_t>(y * picture.width + x)] == 0) continue;
            ++all;
            right += degreesBetween(valueAt(picture, "exit_direction", x, y),
                                    valueAt(truth, "exit_direction", x, y)) < 1;
        }
    EXPECT_GT(all, 500);
    return static_cast<double>(right) / all;
}

Params obliquely(int pixels) {
    Params params = paramsFor(pixels, false);
    params.camera.eye = {2.5, 2, 4};
    params.camera.fov = 32;
    params.background = dvec3(1);
    return params;
}

/// A ring about the y axis.
mesh::TriangleMesh ring() {
    std::vector<glm::dvec2> profile;
    for (int k = 0; k < 48; ++k) {
        const double turn = 2 * std::numbers::pi * k / 48;
        profile.emplace_back(0.8 + 0.3 * std::cos(turn), 0.3 * std::sin(turn));
    }
    return mesh::turned(profile, 96, true);
}

// Every ray that enters a cube of glass obliquely is totally reflected somewhere: the two-interface
// methods have nearly none right, layers nearly all. What they miss are edges between texels.
TEST(Layers, FollowTotalReflection) {
    Params params = obliquely(96);
    const Body cube{mesh::boxShape({-1, -1, -1}, {1, 1, 1}), {}};
    const double before = shareRight(params, cube);
    params.layers = 2;
    const double after = shareRight(params, cube);
    EXPECT_GT(after, 0.93);
    EXPECT_GT(after, before + 0.1);
}

TEST(Layers, FollowRaysThroughMoreThanTwoInterfaces) {
    Params params = obliquely(128);
    params.ior = 1.2;
    const Body body{smooth(ring()), {}};
    const double before = shareRight(params, body);
    params.layers = 4;
    const double after = shareRight(params, body);
    EXPECT_GT(after, 0.9);
    EXPECT_GT(after, before + 0.1);
}

TEST(Layers, OfAConvexBodyAreTwo) {
    Params params = paramsFor(64, false);
    params.layers = 8;
    Stats stats;
    Renderer renderer(device(), params, std::nullopt, stats);
    renderer.setScene({smooth(mesh::icosphere(1, 4)), {}}, {});
    renderer.render({});
    EXPECT_EQ(stats.counter("layers_used"), 2);
}

TEST(Layers, LeaveAWhiteRoomWhite) {
    Params params = obliquely(48);
    params.layers = 2;
    for (const double ior : {0.7, 1.0, 1.5, 2.4}) {
        params.ior = ior;
        const image::Image picture =
            pictureOf(params, {mesh::boxShape({-1, -1, -1}, {1, 1, 1}), {}});
        for (int c = 0; c < 3; ++c)
            for (const float value : picture.plane(static_cast<size_t>(c)))
                EXPECT_NEAR(value, 1, 1e-4);
    }
}

// Straight through a slab, with all that its faces mirror to and fro, in a white room.
TEST(Layers, AbsorbAlongTheWay) {
    Params params = paramsFor(16, true);
    params.layers = 2;
    params.background = dvec3(1);
    params.absorption = {0.1, 0.5, 2};
    params.cutoff = 1e-6;
    const image::Image picture =
        pictureOf(params, {mesh::boxShape({-0.7, -0.7, -0.3}, {0.7, 0.7, 0.3}), {}});
    const double mirrored = 0.04; // ((n - 1) / (n + 1))², n 1.5
    for (int c = 0; c < 3; ++c) {
        const double kept = std::exp(-0.6 * params.absorption[c]);
        const double once = (1 - mirrored) * (1 - mirrored) * kept;
        const double orders = 1 / (1 - mirrored * mirrored * kept * kept);
        EXPECT_NEAR(valueAt(picture, "transmittance", 8, 8, "RGB")[c], once, 1e-5);
        EXPECT_NEAR(valueAt(picture, "", 8, 8, "RGB")[c],
                    once * orders + mirrored + once * kept * mirrored * orders, 1e-4);
    }
}

// Beside and through a slab: where, which way it looks, and how bright it is by its albedo.
TEST(Layers, ShowAPlateDirectlyAndRefracted) {
    Params params = paramsFor(64, false);
    params.camera.eye = {0.8, 0.4, 4};
    params.layers = 2;
    params.background = {1, 2, 4};
    const Body slab{mesh::boxShape({-0.7, -0.7, -0.3}, {0.7, 0.7, 0.3}), {}};
    mesh::TriangleMesh sheet;
    sheet.points = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<Plate> plates{{sheet, {0.5, 0.25, 0.1}}};
    const image::Image picture = pictureOf(params, slab, plates);
    const image::Image truth = exactly(params, slab, plates);
    int same = 0, all = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const dvec3 there = valueAt(truth, "normal", x, y);
            if (there == dvec3(0)) continue;
            ++all;
            // A texel is 1/25 here, and edges of the slab and the sheet may fall to either side.
            same +=
                glm::length(valueAt(picture, "position", x, y) - valueAt(truth, "position", x, y)) <
                    0.02 &&
                glm::length(valueAt(picture, "normal", x, y) - there) < 1e-3 &&
                glm::length(valueAt(picture, "", x, y, "RGB") - valueAt(truth, "", x, y, "RGB")) <
                    5e-3;
        }
    EXPECT_GT(all, 1500);
    EXPECT_GT(same, 0.95 * all);
}

TEST(Layers, HoldNothingButNumbers) {
    for (const double ior : {0.1, 1.0, 1.000001, 10.0})
        for (const double near : {1.0001, 1.2, 50.0})
            for (const bool parallel : {false, true}) {
                Params params = paramsFor(16, parallel);
                params.camera.eye = {0, 0, near};
                params.camera.fov = 150;
                params.layers = 3;
                params.ior = ior;
                params.background = dvec3(1);
                params.absorption = {0, 1, 1000};
                EXPECT_NO_THROW(checkFinite(pictureOf(params, {smooth(ring()), {}}), "picture"));
            }
}

TEST(Layers, MakeTheSamePictureEachTime) {
    Params params = obliquely(64);
    params.layers = 3;
    params.samples = 2;
    const Body body{smooth(ring()), {}};
    EXPECT_EQ(pictureOf(params, body).pixels, pictureOf(params, body).pixels);
}

} // namespace
