// Light at metal and at rough boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "image/lat_long.h"
#include "support/boundary.h"
#include "support/lit.h"
#include "support/shader_lib.h"

#include <numbers>

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr double kPi = std::numbers::pi;

/// Metal aslant by 45° that sends light from above onto a wall at x = 40.
volume::Volume mirrorAndWall(float roughness) {
    TestVolume scene(ivec3(44, 32, 24));
    const auto put = [&](const std::string& name, const TestVolume::Scalar& distance) {
        scene.add("sdf." + name, distance, 1e3);
        scene.constant("ior." + name, 1);
        scene.constant("opacity." + name, 1);
    };
    put("mirror", [](dvec3 p) { return (p.x - 8.3 + p.y - 8.2) / std::sqrt(2.0); });
    put("wall", [](dvec3 p) { return 40 - p.x; });
    volume::Volume volume = scene.take();
    setBoundary(volume, "sdf.mirror", roughness, "gold");
    return volume;
}

Params ontoSurfaces(Method method, std::int64_t photons) {
    Params params = paramsOf({{Light::Kind::directional, {0, -1, 0}, dvec3(1)}}, photons);
    params.outputs = Output::irradiance;
    params.surfaceDetail = 1;
    params.method = method;
    return params;
}

TEST(LightMetal, AMirrorOfGoldSendsItsColourOntoAWall) {
    const optics::NamedMetal& gold = *optics::findMetal("gold");
    const dvec3 R = shader_lib::conductorReflectance(std::sqrt(0.5), gold.index, gold.extinction);
    for (const Method method : {Method::automatic, Method::photons}) {
        const Lit lit(mirrorAndWall(0), ontoSurfaces(method, 1 << 18));
        EXPECT_EQ(lit.plan.beams, method == Method::automatic);
        const volume::FineGrid& grid = lit.result.irradiance;
        dvec3 sum(0);
        int count = 0;
        for (size_t i = 0; i < grid.voxels.size(); ++i) {
            const ivec3 p = grid.voxels[i];
            // Metal shows no light of its own: none is stored on it.
            EXPECT_GT(p.x, 36);
            // From heights that the mirror lies at within the domain.
            if (p.x != 39 && p.x != 40) continue;
            if (p.y < 4 || p.y > 10 || p.z < 6 || p.z > 17) continue;
            sum += dvec3(grid.values[i]);
            ++count;
        }
        ASSERT_GT(count, 50);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / count, R[c], 0.01 * R[c]) << c;
    }
}

TEST(LightMetal, ACylindersMirrorMakesACuspHalfWayToItsAxis) {
    // Parallel rays in a hollow cylinder: their caustic, a nephroid, has its cusp at half the
    // radius.
    const double radius = 24;
    TestVolume scene(ivec3(64, 12, 64));
    const auto put = [&](const std::string& name, const TestVolume::Scalar& distance) {
        scene.add("sdf." + name, distance, 1e3);
        scene.constant("ior." + name, 1);
        scene.constant("opacity." + name, 1);
    };
    // Half a ring, so that light comes in from the other side; aslant onto the floor.
    put("a", [=](dvec3 p) {
        const double from = std::hypot(p.x - 32, p.z - 32);
        return std::max(std::abs(from - radius - 3) - 3, 32.2 - p.x);
    });
    put("floor", [](dvec3 p) { return p.y - 2; });
    volume::Volume volume = scene.take();
    setBoundary(volume, "sdf.a", 0, "silver");
    Params params = ontoSurfaces(Method::automatic, 1 << 20);
    params.surfaceDetail = 2;
    params.lights[0].vector = glm::normalize(dvec3(1, -0.25, 0));
    const Lit lit(volume, params);
    const volume::FineGrid& grid = lit.result.irradiance;
    double most = 0, at = 0;
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const dvec3 x = (dvec3(grid.voxels[i]) + 0.5) / 2.0;
        if (std::abs(x.z - 32) > 0.6 || std::abs(x.y - 2) > 1 || x.x > 32 + radius - 2) continue;
        if (grid.values[i].x > most) {
            most = double{grid.values[i].x};
            at = x.x;
        }
    }
    // Brightest a little behind the cusp, where its two edges are a voxel apart.
    EXPECT_GT(most, 4 * 0.25);
    EXPECT_NEAR(at, 32 + radius / 2, 1.5);
}

TEST(LightRough, PhotonsTakeTheWayOfTheirFacets) {
    // Behind rough gold what comes to the wall is spread, and as much of it is absorbed.
    const Lit smooth(mirrorAndWall(0), ontoSurfaces(Method::photons, 1 << 16));
    const Lit rough(mirrorAndWall(0.4f), ontoSurfaces(Method::automatic, 1 << 16));
    EXPECT_FALSE(rough.plan.beams);
    EXPECT_TRUE(rough.plan.photons);
    const auto absorbed = [](const Lit& lit, size_t c) {
        return lit.stats.energy.escaped[c] / lit.stats.energy.entered[c];
    };
    // Directions now leave the domain by its sides, too.
    EXPECT_GT(absorbed(rough, 0), absorbed(smooth, 0) + 0.05);
}

TEST(LightRough, ARoughBallInAnEvenSkyIsFullOfLight) {
    // Light that is as even within as outside, L/n² alike: a fluence of 4π n² L. A smooth ball has
    // no light on the ways that total reflection would keep in it.
    const auto mean = [](float roughness) {
        TestVolume scene(ivec3(20));
        scene.add(
            "sdf", [](dvec3 p) { return glm::length(p - 10.0) - 8; }, 1e3);
        scene.constant("ior", 1.5);
        volume::Volume volume = scene.take();
        setBoundary(volume, "sdf", roughness);
        Light sky;
        sky.kind = Light::Kind::environment;
        sky.rgb = dvec3(1);
        sky.map = std::make_shared<image::Image>(8, 4);
        sky.map->addChannels({"R", "G", "B"}, std::vector<float>(8 * 4 * 3, 1.0f), 3);
        Params params = paramsOf({sky}, 1 << 18);
        params.outputs = Output::fluence;
        params.maxDepth = 64;
        const Lit lit(volume, params);
        double sum = 0;
        int count = 0;
        for (int z = 0; z < 20; ++z)
            for (int y = 0; y < 20; ++y)
                for (int x = 0; x < 20; ++x) {
                    if (glm::length(dvec3(x, y, z) + 0.5 - 10.0) > 6.5) continue;
                    sum += lit.fluence({x, y, z});
                    ++count;
                }
        return sum / count / (4 * kPi * 2.25);
    };
    EXPECT_NEAR(mean(0.5f), 1, 0.02);
    EXPECT_LT(mean(0), 0.9);
}

TEST(LightCoat, TakesInWhatItDoesNotMirrorOntoAWall) {
    // Light at 60° onto a coated floor: the floor gets what the coat lets in, a wall what it
    // mirrors.
    const double cosine = 0.5, sine = std::sqrt(0.75);
    const double R =
        shader_lib::dielectricAt(dvec3(sine, -cosine, 0), dvec3(0, 1, 0), 1, 1.5).reflectance;
    TestVolume scene(ivec3(40, 24, 16));
    const auto put = [&](const std::string& name, const TestVolume::Scalar& distance,
                         double index) {
        scene.add("sdf." + name, distance, 1e3);
        scene.constant("ior." + name, index);
        scene.constant("opacity." + name, 1);
        scene.addVector("albedo." + name, [](dvec3) { return dvec3(0.5); });
    };
    put(
        "floor", [](dvec3 p) { return p.y - 3.3; }, 1.5);
    put(
        "wall", [](dvec3 p) { return 36.2 - p.x; }, 1);
    const volume::Volume volume = scene.take();
    for (const Method method : {Method::automatic, Method::photons}) {
        Params params = ontoSurfaces(method, 1 << 18);
        params.lights[0].vector = {sine, -cosine, 0};
        const Lit lit(volume, params);
        const volume::FineGrid& grid = lit.result.irradiance;
        double floor = 0, wall = 0;
        int floors = 0, walls = 0;
        for (size_t i = 0; i < grid.voxels.size(); ++i) {
            const ivec3 p = grid.voxels[i];
            if (p.z < 4 || p.z > 11) continue;
            if (p.y == 3 && p.x > 4 && p.x < 30) {
                floor += double{grid.values[i].x};
                ++floors;
            } else if (p.x == 36 && p.y > 6 && p.y < 11) {
                wall += double{grid.values[i].x};
                ++walls;
            }
        }
        ASSERT_GT(floors, 100);
        ASSERT_GT(walls, 20);
        EXPECT_NEAR(floor / floors, (1 - R) * cosine, 0.01 * cosine);
        // The sun itself, and its mirror image, both at 30° to the wall's normal.
        EXPECT_NEAR(wall / walls, (1 + R) * sine, 0.01);
    }
}

TEST(LightCoat, ItsBasesLightGoesOn) {
    // In a closed white box of coated walls light goes round as in a bare one: what it sends out
    // after one bounce is its albedo under the coat of what came in.
    const auto left = [](double index) {
        TestVolume scene(ivec3(20));
        scene.add(
            "sdf",
            [](dvec3 p) {
                const dvec3 q = glm::abs(p - 10.0);
                return 8 - std::max({q.x, q.y, q.z});
            },
            1e3);
        scene.constant("ior", index);
        scene.constant("opacity", 1);
        scene.constantVector("albedo", dvec3(0.5));
        scene.constantVector("scattering", dvec3(0));
        Params params = paramsOf({{Light::Kind::point, dvec3(10), dvec3(1)}}, 1 << 14);
        params.outputs = Output::irradiance;
        params.bounces = 1;
        params.surfaceDetail = 1;
        return Lit(scene.take(), params).counter("light_left_after_bounces");
    };
    // A point's light comes in at many angles, most of it steeply: 0.95 of it gets through, and of
    // what the coat mirrors, most at the next wall.
    const double coated = shader_lib::albedoOfCoated(dvec3(0.5), 1.5).x;
    EXPECT_NEAR(left(1), 0.25, 0.005);
    EXPECT_NEAR(left(1.5), coated * coated, 0.02);
}

TEST(LightRough, BeamsAndFrontsAreRefused) {
    for (const Method method : {Method::beams, Method::wavefront}) {
        Params params = ontoSurfaces(method, 1 << 12);
        EXPECT_THROW(makePlan(mirrorAndWall(0.2f), params), UsageError);
    }
}

} // namespace
} // namespace eikonal::lightsim
