// Light by wavefronts: patches that advance in equal steps of time.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

#include "base/error.h"

#include <array>
#include <map>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

Params frontsOf(const std::vector<Light>& lights) {
    Params params = paramsOf(lights);
    params.method = Method::wavefront;
    params.photons = 0;
    return params;
}

Params smooth(Params params) {
    params.smoothing = 1;
    return params;
}

/// Glass of index 1.5 with an edge blurred to an error function of σ = 1.5 voxels.
TestVolume blurredBall(const ivec3& size, const dvec3& centre, double radius) {
    TestVolume scene(size);
    scene.index([=](dvec3 p) {
        const double depth = radius - glm::length(p - centre);
        return 1 + 0.25 * std::erfc(-depth / (1.5 * std::sqrt(2.0)));
    });
    return scene;
}

/// An object of index n in a medium of index 1.
TestVolume sharpScene(const ivec3& size, const TestVolume::Scalar& sdf, double n) {
    TestVolume scene(size);
    scene.add("sdf", sdf, 1e3);
    scene.index([=](dvec3) { return n; }, 1);
    return scene;
}

TestVolume sharpBall(const ivec3& size, const dvec3& centre, double radius) {
    return sharpScene(
        size, [=](dvec3 p) { return glm::length(p - centre) - radius; }, 1.5);
}

/// Root mean square of the difference over the voxels that `counts` chooses, over their mean.
struct Difference {
    double away = 0, over = 0; ///< where the light is up to twice the mean, and where it is more
};

Difference difference(const Lit& found, const Lit& wanted) {
    const ivec3 size = wanted.plan.scene.size();
    const double voxels = double(size.x) * size.y * size.z, mean = wanted.total() / voxels;
    double squares[2] = {}, sums[2] = {}, counts[2] = {};
    forEachVoxel(size, [&](ivec3 p) {
        const int k = wanted.fluence(p) > 2 * mean;
        squares[k] += std::pow(found.fluence(p) - wanted.fluence(p), 2);
        sums[k] += wanted.fluence(p);
        counts[k] += 1;
    });
    const auto rms = [&](int k) { return std::sqrt(squares[k] * counts[k]) / sums[k]; };
    return {rms(0), rms(1)};
}

double closedTo(const Energy& energy) {
    const double sum =
        energy.absorbed[0] + energy.scattered[0] + energy.escaped[0] + energy.lost[0];
    return std::abs(sum / energy.entered[0] - 1);
}

} // namespace

TEST(LightFronts, VacuumHasTheIrradianceEverywhere) {
    TestVolume scene({12, 10, 14}, 0.5);
    scene.constant("ior", 1);
    for (const dvec3& along : {dvec3(0, 0, 1), dvec3(-1, 0, 0), dvec3(1, -2, 0.7)}) {
        const Lit lit(scene.volume(), smooth(frontsOf({beam(along, {3, 2, 1})})));
        const bool straight = std::abs(along.x + along.z) == 1;
        double worst = 0, squares = 0, turned = 0;
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            for (int c = 0; c < 3; ++c) {
                const double off = lit.fluence(p, c) / (3 - c) - 1;
                worst = std::max(worst, std::abs(off));
                squares += off * off / (3 * 12 * 10 * 14);
            }
            turned = std::max(turned, glm::length(lit.direction(p) - glm::normalize(along)));
        });
        // Along an axis rays fill voxels evenly; askew nine of them a voxel, a third apart, do so
        // to some percent, and at the domain's outline patches of an eighth of a voxel count.
        EXPECT_LT(worst, straight ? 1e-5 : 0.06);
        EXPECT_LT(std::sqrt(squares), straight ? 1e-5 : 0.015);
        EXPECT_LT(turned, 1e-4); // fixed point
        EXPECT_NEAR(lit.stats.energy.escaped[1], lit.stats.energy.entered[1], 1e-6);
    }
}

TEST(LightFronts, APointLightFallsOffWithTheSquareOfTheDistance) {
    TestVolume scene(ivec3(24));
    scene.constant("ior", 1);
    for (const dvec3& place : {dvec3(12.2, 11.7, 12.4), dvec3(-9, 12, 12), dvec3(-5, -7, 30)}) {
        const Lit lit(scene.volume(), smooth(frontsOf({lamp(place)})));
        double squares = 0, sum = 0, count = 0;
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            const dvec3 away = dvec3(p) + 0.5 - place;
            if (glm::length(away) < 6) return; // voxels are too large to tell, there
            const double off = lit.fluence(p) * glm::dot(away, away) - 1;
            squares += off * off;
            sum += off;
            count += 1;
        });
        EXPECT_LT(std::sqrt(squares / count), 0.03) << place.x;
        // A voxel's mean and smoothing raise 1/r² by 2/r² (1/24 + 1/4) or so of it: 0.5 % here.
        EXPECT_NEAR(sum / count, 0, 0.006) << place.x;
    }
    // All round: 4π, or the solid angle of a face for a light before its middle, 9 voxels off.
    const Lit inside(scene.volume(), frontsOf({lamp({12.2, 11.7, 12.4})}));
    EXPECT_NEAR(inside.stats.energy.entered[0], 4 * 3.14159265358979, 1e-5);
    const Lit outside(scene.volume(), frontsOf({lamp({-9, 12, 12})}));
    const double half = std::atan2(12.0 * 12, 9 * std::sqrt(9.0 * 9 + 2 * 12 * 12));
    EXPECT_NEAR(outside.stats.energy.entered[0], 4 * half, 2e-3 * 4 * half);
}

TEST(LightFronts, AbsorptionFollowsBeerAndLambert) {
    const dvec3 sigma(0.1, 0.5, 2); // [1/unit], half a unit a voxel
    for (const bool colour : {false, true}) {
        TestVolume scene({16, 8, 8}, 0.5);
        scene.constantVector("absorption", colour ? sigma : dvec3(sigma.y));
        const Lit lit(scene.volume(), frontsOf({beam({1, 0, 0}, {3, 2, 1})}));
        for (int c = 0; c < 3; ++c) {
            const double s = colour ? sigma[c] : sigma.y, e = 3 - c, a = 0.25 * s;
            for (int x = 0; x < 10; ++x) {
                const double mean = e * std::exp(-s * 0.5 * (x + 0.5)) * std::sinh(a) / a;
                EXPECT_NEAR(lit.fluence({x, 3, 5}, c), mean, 1e-3 * mean + 1e-5 * e)
                    << x << " " << c;
            }
            const auto i = static_cast<size_t>(c);
            EXPECT_NEAR(lit.stats.energy.absorbed[i] / lit.stats.energy.entered[i],
                        1 - std::exp(-8 * s), 1e-4);
        }
    }
}

TEST(LightFronts, WhatLeavesAtTheSidesIsNotAbsorbed) {
    TestVolume scene(ivec3(16));
    scene.constantVector("absorption", dvec3(0.02));
    const Light light = beam({0.3, -1, 0.2});
    const Lit fronts(scene.volume(), frontsOf({light}));
    const Lit photons(scene.volume(), paramsOf({light}, 1 << 15));
    const auto absorbed = [](const Lit& lit) {
        return lit.stats.energy.absorbed[0] / lit.stats.energy.entered[0];
    };
    // The outline is cut to eighths of a voxel, and patches leave as a whole.
    EXPECT_NEAR(absorbed(fronts), absorbed(photons), 0.01 * absorbed(photons));
    EXPECT_NEAR(0.02 * fronts.total(), fronts.stats.energy.absorbed[0],
                1e-3 * fronts.stats.energy.absorbed[0]);
}

TEST(LightFronts, AnOpaqueBlockTakesWhatHitsItAndThrowsAShadow) {
    TestVolume scene({16, 16, 16});
    scene.add("opacity", [](dvec3 p) {
        const dvec3 d = glm::abs(p - 8.0);
        return std::max({d.x, d.y, d.z}) < 3 ? 1 : 0;
    });
    Params params = frontsOf({beam({0, -1, 0})});
    params.outputs = Output::fluence;
    const Lit lit(scene.volume(), params);
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        const bool under = p.x >= 5 && p.x < 11 && p.z >= 5 && p.z < 11 && p.y < 11;
        ASSERT_NEAR(lit.fluence(p), under ? 0 : 1, 0.3) << p.x << " " << p.y << " " << p.z;
    });
    EXPECT_NEAR(lit.stats.energy.absorbed[0], 36, 1.5);
    EXPECT_LT(closedTo(lit.stats.energy), 1e-5);
}

/// A scene's light beside that of so many photons, away from the caustic and over it.
void expectThatOfPhotons(const TestVolume& scene, std::int64_t photons) {
    const Light light = beam({0.2, -1, 0.3});
    const Lit wanted(scene.volume(), smooth(paramsOf({light}, photons)));
    const Lit found(scene.volume(), smooth(frontsOf({light})));
    const Difference off = difference(found, wanted);
    EXPECT_LT(off.away, 0.05);
    EXPECT_LT(off.over, 0.1);
    EXPECT_LT(closedTo(found.stats.energy), 1e-5);
    // What is lost is what thinning drops.
    EXPECT_LT(found.stats.energy.lost[0], 2e-3 * found.stats.energy.entered[0]);
}

TEST(LightFronts, ABlurredBallsLightIsThatOfPhotons) {
    expectThatOfPhotons(blurredBall(ivec3(32), dvec3(16), 9), 1 << 17);
}

TEST(LightFronts, ASharpBallsLightIsThatOfPhotons) {
    expectThatOfPhotons(sharpBall(ivec3(32), dvec3(16), 9), 1 << 18);
}

TEST(LightFronts, TheSourcesRulesDoNotKeepTheLight) {
    // A rod of n² = n0² − a² r²: parallel rays cross its axis 29 to 31 voxels deep, and go on.
    TestVolume scene({17, 17, 48});
    scene.index([](dvec3 p) {
        const double x = p.x - 8.5, y = p.y - 8.5;
        return std::sqrt(1.6 * 1.6 - 0.08 * 0.08 * (x * x + y * y));
    });
    Params params = frontsOf({beam({0, 0, 1})});
    params.tracing.step =
        0.5; // no patch may leap over a voxel, of which theirs tell by their middles
    double inverted = 0;
    std::map<std::array<int, 3>, double> strongest; // irradiance in each voxel [W/m²]
    params.seeFront = [&](int, const std::vector<FrontQuad>& front) {
        double down = 0, all = 0;
        for (const FrontQuad& quad : front) {
            const dvec3 normal = 0.5 * glm::cross(quad.corners[2] - quad.corners[0],
                                                  quad.corners[3] - quad.corners[1]);
            const dvec3 middle =
                0.25 * (quad.corners[0] + quad.corners[1] + quad.corners[2] + quad.corners[3]);
            if (middle.z > 48) continue;
            all += quad.power.x;
            if (normal.z > 0) { // right × up points back at the light
                down += quad.power.x;
                continue;
            }
            double& voxel = strongest[{int(middle.x), int(middle.y), int(middle.z)}];
            voxel = std::max(voxel, quad.power.x / glm::length(normal));
        }
        if (all > 0.9 * 17 * 17) inverted = std::max(inverted, down / all);
    };
    const Lit lit(scene.volume(), params);
    const auto theirs = [&](int z) {
        double sum = 0;
        for (const auto& [place, irradiance] : strongest) sum += place[2] == z ? irradiance : 0;
        return sum / (17 * 17);
    };
    // At one time three fifths of the light are in patches that are upside down, which they discard
    // for good. The strongest patch of a voxel tells its light before the focus; at it, where
    // patches are as small as can be, it is hundreds of times too much.
    EXPECT_GT(inverted, 0.5);
    EXPECT_LT(inverted, 0.7);
    EXPECT_NEAR(theirs(1), 1, 0.03);
    EXPECT_GT(theirs(30), 100);
    // Ours loses none: each layer of voxels has all of it, but for what has left at the sides.
    for (const int z : {2, 24, 30, 36, 45}) {
        double layer = 0;
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 17; ++x)
                layer += lit.fluence({x, y, z}) * lit.direction({x, y, z}).z;
        EXPECT_NEAR(layer, 17 * 17, 0.01 * 17 * 17) << z;
    }
    EXPECT_LT(closedTo(lit.stats.energy), 1e-6);
}

TEST(LightFronts, ASecondRunGivesTheSameBytes) {
    const TestVolume scene = sharpBall(ivec3(20), dvec3(10), 6);
    const Params params = frontsOf({beam({0.2, -1, 0.3}, {3, 2, 1}), lamp({-3, 25, 12})});
    const Lit first(scene.volume(), params), second(scene.volume(), params);
    EXPECT_EQ(first.result.fluence.values, second.result.fluence.values);
    EXPECT_EQ(first.result.direction.values, second.result.direction.values);
}

TEST(LightFronts, AFrontIsTheSurfaceOfEqualTime) {
    TestVolume scene(ivec3(16), 0.5);
    scene.constant("ior", 1);
    Params params = frontsOf({lamp({-3, 4, 4})});
    double first = 0, off = 0;
    int fronts = 0;
    params.seeFront = [&](int step, const std::vector<FrontQuad>& front) {
        if (front.empty()) return;
        ++fronts;
        for (const FrontQuad& quad : front)
            for (const dvec3& corner : quad.corners) {
                const double radius =
                    glm::length(corner - dvec3(-3, 4, 4)) - 2 * step; // 4 voxels each
                if (first == 0) first = radius;
                off = std::max(off, std::abs(radius - first));
            }
    };
    const Lit lit(scene.volume(), params);
    EXPECT_GE(fronts, 4);
    EXPECT_NEAR(first, 3, 0.02); // the near face is there
    EXPECT_LT(off, 0.02);        // a clock may be so much of a voxel late
}

TEST(LightFronts, WhatDoesNotGoTogetherIsRefused) {
    EXPECT_EQ(parseMethod("wavefront"), Method::wavefront);
    try {
        parseMethod("wavefronts");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("beams or wavefront"), std::string::npos);
    }
    Params params = frontsOf({beam({0, 0, 1})});
    params.proxy = {dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0)};
    EXPECT_THROW(params.check(), UsageError);
    params = paramsOf({beam({0, 0, 1})});
    params.seeFront = [](int, const std::vector<FrontQuad>&) {};
    EXPECT_THROW(params.check(), UsageError);
    params.method = Method::wavefront;
    EXPECT_NO_THROW(params.check());
}

TEST(LightFronts, SurfacesHaveTheirLightByBeams) {
    TestVolume scene(ivec3(12));
    scene.add("opacity", [](dvec3 p) { return p.y < 3 ? 1 : 0; });
    scene.constantVector("scattering", dvec3(0.01));
    scene.constantVector("albedo", dvec3(0.5));
    Params params = frontsOf({beam({0, -1, 0})});
    params.automaticOutputs = true;
    const Lit lit(scene.volume(), params);
    EXPECT_TRUE(lit.plan.beams);
    EXPECT_TRUE(lit.plan.wavefront);
    EXPECT_FALSE(lit.plan.photons);
    EXPECT_FALSE(lit.result.irradiance.empty());
    EXPECT_NEAR(lit.fluence({6, 7, 6}), std::exp(-0.01 * 4.5), 2e-3);
    for (const Effect& effect : lit.plan.effects)
        if (effect.name == "wavefront" || effect.name == "photons") {
            EXPECT_EQ(effect.on, effect.name == "wavefront");
        }
}
