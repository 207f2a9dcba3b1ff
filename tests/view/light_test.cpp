// What a straight viewing ray gathers: emission, absorption, scattering, surfaces, and L/n².
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;
const dvec3 kColour(0.05, 0.1, 0.4);

double henyeyGreenstein(double g, double cosine) {
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// A box of 16 × 16 × 16 voxels of half a unit, seen askew.
struct Box {
    TestVolume scene{ivec3(16), 0.5};
    Params params = perspective({9, 13, 20}, dvec3(4), 25, {4, 3});
};

/// Calls `check` with every pixel that meets the box and its chord there [unit].
template<typename Check> void forEachChord(const Look& look, const Check& check) {
    for (int y = 0; y < look.picture.height; ++y)
        for (int x = 0; x < look.picture.width; ++x) {
            const dvec3 eye(9, 13, 20), d = look.direction(x, y);
            double enter = 0, leave = 1e9;
            for (int c = 0; c < 3; ++c) {
                const double a = (0 - eye[c]) / d[c], b = (8 - eye[c]) / d[c];
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            if (enter < leave) check(x, y, leave - enter);
        }
}

} // namespace

TEST(ViewLight, EmissionAddsUpAlongTheChord) {
    for (const bool colour : {false, true}) {
        Box box;
        const dvec3 epsilon = colour ? kColour : dvec3(0.3);
        box.scene.constantVector("emission", epsilon);
        const Look look(box.scene.take(), box.params);
        int met = 0;
        forEachChord(look, [&](int x, int y, double chord) {
            // Some twenty steps in floats.
            expectNear(look.colour(x, y) / epsilon, dvec3(chord), 1e-5 * 14);
            EXPECT_NEAR(look.at("path_length.V", x, y), chord, 1e-4);
            EXPECT_NEAR(look.at("optical_path_length.V", x, y), chord, 1e-4);
            EXPECT_EQ(look.at("A", x, y), 1);
            ++met;
        });
        EXPECT_GT(met, 6);
    }
}

TEST(ViewLight, AbsorptionFollowsBeerAndLambert) {
    for (const bool colour : {false, true}) {
        Box box;
        const dvec3 sigma = colour ? kColour : dvec3(0.3);
        box.scene.constantVector("absorption", sigma);
        box.params.background = {3, 2, 1};
        const Look look(box.scene.take(), box.params);
        forEachChord(look, [&](int x, int y, double chord) {
            const dvec3 through = glm::exp(-sigma * chord);
            expectNear(look.colour(x, y), dvec3(3, 2, 1) * through, 3e-5); // floats, as above
            const dvec3 aov(look.at("transmittance.R", x, y), look.at("transmittance.G", x, y),
                            look.at("transmittance.B", x, y));
            expectNear(aov, through, 1e-5);
            EXPECT_EQ(look.at("A", x, y), 1);
            if (colour) {
                const dvec3 opacity(look.at("AR", x, y), look.at("AG", x, y), look.at("AB", x, y));
                expectNear(opacity, 1.0 - through, 1e-5);
            }
        });
        EXPECT_EQ(look.picture.find("AR").has_value(), colour);
    }
}

TEST(ViewLight, SingleScatteringOfEvenLight) {
    for (const bool colour : {false, true}) {
        Box box;
        const dvec3 a = colour ? dvec3(0.1, 0.05, 0) : dvec3(0.1),
                    s = colour ? kColour : dvec3(0.2);
        const dvec3 phi = colour ? dvec3(5, 6, 7) : dvec3(5);
        box.scene.constantVector("absorption", a);
        box.scene.constantVector("scattering", s);
        box.scene.constantVector("fluence", phi);
        const Look look(box.scene.take(), box.params);
        forEachChord(look, [&](int x, int y, double chord) {
            const dvec3 wanted = s * phi / (4 * kPi) * (1.0 - glm::exp(-(a + s) * chord)) / (a + s);
            expectNear(look.colour(x, y) / wanted, dvec3(1), 2e-5); // floats, as above
        });
    }
}

TEST(ViewLight, ScatteringPrefersTheLightsDirection) {
    // From six sides and askew; the light travels along +z with a mean direction of length m.
    const double g = 0.7;
    for (const double m : {1.0, 0.5}) {
        const auto scene = [&](bool emits) {
            TestVolume out(ivec3(8));
            out.constantVector("scattering", dvec3(0.1));
            out.constantVector("fluence", dvec3(2));
            out.constant("anisotropy", g);
            out.constantVector("light_direction", {0, 0, m});
            if (emits) out.constantVector("emission", dvec3(0.05));
            return out.take();
        };
        for (const dvec3& from : {dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0, -1, 0),
                                  dvec3(1, 0, 1), dvec3(0, 1, -1)})
            for (const bool emits : {false, true}) {
                const dvec3 d = glm::normalize(from);
                const dvec3 up = d.y == 0 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
                const Look look(scene(emits), parallel(4.0 + 30.0 * d, dvec3(4), 1, {1, 1}, up));
                const double chord = look.at("path_length.V");
                EXPECT_NEAR(chord, 8 / std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}),
                            1e-4); // floats
                const double depth = 0.1 * chord;
                const double phase = henyeyGreenstein(g * m, d.z); // travelling on to the eye: +d
                const double source = 0.1 * 2 * phase + (emits ? 0.05 : 0);
                const double wanted = source * (1 - std::exp(-depth)) / 0.1;
                EXPECT_NEAR(look.at("R"), wanted, 2e-5 * wanted) << d.x << " " << d.y << " " << d.z;
            }
    }
}

TEST(ViewLight, RadianceOverIndexSquaredIsConserved) {
    const auto scene = [] {
        TestVolume out(ivec3(16));
        out.constant("ior", 1.5);
        out.constantVector("emission", dvec3(0.1));
        return out.take();
    };
    // From outside, where the index is 1: what the glass emits arrives thinned by n².
    Params params = parallel({8, 8, 40}, dvec3(8), 1);
    params.background = dvec3(4);
    const Look outside(scene(), params);
    EXPECT_NEAR(outside.at("R"), 1.6 / 2.25 + 4, 1e-5);               // floats
    EXPECT_NEAR(outside.at("optical_path_length.V"), 1.5 * 16, 1e-4); // as above
    EXPECT_NEAR(outside.at("path_length.V"), 16, 1e-4);               // as above
    // From inside it, the glass as it is and the sky brighter by n².
    params.camera.eye = {8, 8, 12};
    const Look inside(scene(), params);
    EXPECT_NEAR(inside.at("R"), 1.2 + 4 * 2.25, 1e-5); // floats
}

namespace {

/// Light on the plane z = 6 [voxel] in a box of 16³, in the fine voxels on either side of it.
volume::FineGrid lightOnPlane(int detail, const std::function<dvec3(double x, double y)>& value) {
    volume::FineGrid light;
    light.detail = detail;
    for (int z = 6 * detail - 1; z <= 6 * detail; ++z)
        for (int y = 0; y < 16 * detail; ++y)
            for (int x = 0; x < 16 * detail; ++x) {
                light.voxels.emplace_back(x, y, z);
                light.values.emplace_back(value((x + 0.5) / detail, (y + 0.5) / detail));
            }
    return light;
}

/// What is opaque below that plane, lit so.
volume::Volume slab(const dvec3& albedo, bool everywhere, const volume::FineGrid& light) {
    TestVolume scene(ivec3(16));
    scene.add("opacity", [](dvec3 p) { return p.z < 6 ? 1 : 0; });
    // The contract keeps the albedo of empty voxels at 0; the surface must not be dimmed.
    scene.addVector("albedo", [&](dvec3 p) { return everywhere || p.z < 6 ? albedo : dvec3(0); });
    volume::Volume volume = scene.take();
    if (!light.empty()) volume.putFine("irradiance", volume.domain(), light);
    return volume;
}

} // namespace

TEST(ViewLight, AnOpaqueSlabIsALambertianReflector) {
    const dvec3 albedo(0.2, 0.5, 0.8), irradiance(1, 2, 3);
    for (const bool everywhere : {true, false})
        for (const int detail : {1, 3}) {
            const auto light = lightOnPlane(detail, [&](double, double) { return irradiance; });
            Params params = parallel({8, 8, 40}, {8, 8, 8}, 8, {2, 2});
            params.background = dvec3(9);
            const Look look(slab(albedo, everywhere, light), params);
            expectNear(look.colour(1, 1), albedo / kPi * irradiance, 1e-5); // floats
            EXPECT_NEAR(look.at("Z", 1, 1), 40 - 6, 2e-3); // twelve halvings of a step
            EXPECT_EQ(look.at("A", 0, 1), 1);
            EXPECT_EQ(look.at("transmittance.G"), 0);
        }
}

TEST(ViewLight, LightOnASurfaceIsInterpolatedBetweenFineVoxels) {
    const auto ramp = [](double x, double y) { return dvec3(1 + x, 1 + 2 * y, 1); };
    const Params params = parallel({8, 8, 40}, {8, 8, 8}, 8, {16, 16});
    const Look look(slab(dvec3(0.5), true, lightOnPlane(2, ramp)), params);
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
            const double x = 4 + (i + 0.5) / 2, y = 12 - (j + 0.5) / 2;
            expectNear(look.colour(i, j), 0.5 / kPi * ramp(x, y), 1e-5);
        }
}

TEST(ViewLight, SeveralFilesAddTheirLightOnSurfacesWhateverItsDetail) {
    const auto even = [](double value) {
        return [=](double, double) { return dvec3(value); };
    };
    std::vector<volume::Volume> files;
    files.push_back(slab(dvec3(0.5), true, lightOnPlane(2, even(1))));
    files.push_back(slab(dvec3(0.5), true, lightOnPlane(3, even(2))));
    const Look look(std::move(files), parallel({8, 8, 40}, {8, 8, 8}, 8, {2, 2}));
    EXPECT_NEAR(look.at("R"), 0.5 / kPi * 3, 1e-5);
}

TEST(ViewLight, WhatIsOpaqueIsBlackWithoutLightAndIsToldOf) {
    const Look look(slab(dvec3(0.5), true, {}), parallel({8, 8, 40}, {8, 8, 8}, 8, {2, 2}));
    EXPECT_EQ(look.at("R"), 0);
    ASSERT_EQ(look.plan.warnings.size(), 1u);
    EXPECT_NE(look.plan.warnings[0].find("run lightsim first"), std::string::npos);
}

TEST(ViewLight, SeveralFilesAddTheirLight) {
    const dvec3 first(1, 2, 3), second(4, 4, 4);
    const auto material = [](TestVolume& scene) {
        scene.constantVector("scattering", dvec3(0.1));
        scene.constant("anisotropy", 0.5);
    };
    const Params params = parallel({4, 4, 40}, dvec3(4), 1);
    const auto radiance = [&](const dvec3& phi, const dvec3& direction) {
        TestVolume scene(ivec3(8));
        material(scene);
        scene.constantVector("fluence", phi);
        scene.constantVector("light_direction", direction);
        return Look(scene.take(), params).colour();
    };
    TestVolume a(ivec3(8)), b(ivec3(8));
    material(a);
    a.constantVector("fluence", first).constantVector("light_direction", {0, 0, 1});
    b.constantVector("fluence", second).constantVector("light_direction", {0, 0.5, 0});
    std::vector<volume::Volume> files;
    files.push_back(a.take());
    files.push_back(b.take());
    const Look both(std::move(files), params);
    // Weights of the directions: 6 and 12 of power.
    expectNear(both.colour() / radiance(first + second, dvec3(0, 1.0 / 3, 1.0 / 3)), dvec3(1),
               1e-6);
}
