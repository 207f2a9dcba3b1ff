// A plate of glass: what it sets aside, what it reflects and absorbs, what is seen through it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/scenes.h"

#include <gtest/gtest.h>

namespace eikonal::raytrace {
namespace {

using glm::dvec3;

/// From z = -0.5 to 0, wide beyond what is seen.
Body slab(double n, const dvec3& absorption = {}) {
    return glass(mesh::boxShape({-50, -50, -0.5}, {50, 50, 0}), n, absorption);
}

TEST(Slab, SetsRaysAsideAndTurnsNone) {
    const double n = 1.6;
    Params params = lookingFrom({0, 0, 3}, 33,
                                {"exit_direction", "exit_position", "path_length",
                                 "optical_path_length", "Z", "transmittance"});
    params.camera.target = {0.7, 0.4, 0};
    const image::Image picture = rendered(params, {slab(n)});
    const camera::CameraAxes axes = camera::axesOf(params.camera);
    for (size_t i = 0; i < picture.area(); ++i) {
        const dvec3 u = rayOf(params.camera, i);
        const dvec3 enters = params.camera.eye - u * (3 / u.z);
        dvec3 within = u / n;
        within.z = 0;
        within.z = -std::sqrt(1 - glm::dot(within, within));
        const double length = -0.5 / within.z;
        const dvec3 leaves = enters + length * within;
        EXPECT_LT(glm::distance(vectorAt(picture, "exit_direction.", i), u), 1e-6);
        EXPECT_LT(glm::distance(vectorAt(picture, "exit_position.", i), leaves), 1e-6);
        const auto at = [&](const char* name) {
            return static_cast<double>(picture.plane(picture.find(name).value())[i]);
        };
        EXPECT_NEAR(at("path_length.V"), length, 1e-6);
        EXPECT_NEAR(at("optical_path_length.V"), n * length, 1e-6);
        EXPECT_NEAR(at("Z"), glm::dot(leaves - params.camera.eye, axes.forward), 1e-6);
        // Fresnel's equations, twice.
        const double c = -u.z, d = -within.z;
        const double s = (c - n * d) / (c + n * d), p = (n * c - d) / (n * c + d);
        const double through = 1 - 0.5 * (s * s + p * p);
        EXPECT_NEAR(at("transmittance.R"), through * through, 1e-6);
    }
}

/// Straight onto it, all orders, with nothing cut off.
Params straight() {
    Params params = lookingFrom({0, 0, 3}, 3);
    params.camera.parallel = true;
    params.camera.height = 1;
    params.cutoff = 0;
    return params;
}

/// What all orders make of light that comes straight onto the slab: a geometric series.
struct Series {
    double through, back;
};
Series seriesOf(double n, double sigma) {
    const double R = (n - 1) * (n - 1) / ((n + 1) * (n + 1)), a = std::exp(-0.5 * sigma);
    const double orders = 1 / (1 - R * R * a * a);
    return {(1 - R) * (1 - R) * a * orders, R + (1 - R) * (1 - R) * R * a * a * orders};
}

TEST(Slab, AbsorbsByBeersLawInEveryOrder) {
    Params params = straight();
    params.background = dvec3(1);
    const image::Image picture = rendered(params, {slab(1.5, {0, 0.7, 3})});
    const auto expected = [](double sigma) {
        const Series series = seriesOf(1.5, sigma);
        return series.through + series.back;
    };
    for (size_t i = 0; i < picture.area(); ++i)
        EXPECT_LT(glm::distance(colourAt(picture, i), {1, expected(0.7), expected(3)}), 1e-6);
    ASSERT_TRUE(picture.find("AG"));
    const double R = 0.04; // of the first branch alone
    EXPECT_NEAR(picture.plane(*picture.find("AG"))[4], 1 - (1 - R) * (1 - R) * std::exp(-0.35),
                1e-6);
}

TEST(Slab, APlateIsSeenThroughIt) {
    Params params = straight();
    params.background = {1, 2, 4};
    params.aovs = {"position", "normal"};
    const dvec3 albedo(0.5, 0.25, 0);
    // A single sheet, which is opaque from either side; its triangles look away.
    mesh::TriangleMesh sheet;
    sheet.points = {{-40, -40, -2}, {-40, 40, -2}, {40, 40, -2}, {40, -40, -2}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    const image::Image picture = rendered(params, {slab(1.5), plate(sheet, albedo)});
    const Series series = seriesOf(1.5, 0);
    // Even light all round: matt surfaces send back what they see of it.
    const dvec3 expected =
        series.through * albedo * params.background + series.back * params.background;
    for (size_t i = 0; i < picture.area(); ++i) {
        EXPECT_LT(glm::distance(colourAt(picture, i), expected), 1e-5);
        EXPECT_LT(glm::distance(vectorAt(picture, "normal.", i), {0, 0, 1}), 1e-6);
        EXPECT_NEAR(vectorAt(picture, "position.", i).z, -2, 1e-6);
    }
    // Seen askew it is set aside as the slab sets rays aside.
    params.camera.parallel = false;
    params.camera.eye = {2, 0, 3};
    const image::Image askew = rendered(params, {slab(1.5), plate(sheet, albedo)});
    const dvec3 u = rayOf(params.camera, 4);
    const double sine = u.x / 1.5, slope = sine / std::sqrt(1 - sine * sine);
    const double x = 2 + u.x / -u.z * (3 + 1.5) + 0.5 * slope;
    EXPECT_NEAR(vectorAt(askew, "position.", 4).x, x, 1e-5);
}

} // namespace
} // namespace eikonal::raytrace
