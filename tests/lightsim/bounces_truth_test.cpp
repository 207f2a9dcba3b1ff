// Light that opaque surfaces send on, beside closed forms: form factors, hollow balls and lone
// ones. SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"
#include "support/opaque_volume.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;

Params bouncing(const Light& light, int bounces, int detail = 2, std::int64_t photons = 1 << 16) {
    Params params = paramsOf({light}, photons);
    params.outputs = Output::irradiance;
    params.surfaceDetail = detail;
    params.bounces = bounces;
    return params;
}

/// A surface voxel's middle, and what bounces add there.
struct Added {
    dvec3 x;
    double irradiance;
};

std::vector<Added> addedBy(const TestVolume& scene, const Params& with) {
    Params without = with;
    without.bounces = 0;
    const Lit lit(scene.volume(), with), direct(scene.volume(), without);
    const volume::FineGrid& all = lit.result.irradiance;
    std::vector<Added> found;
    for (size_t i = 0; i < all.voxels.size(); ++i)
        found.push_back(
            {(dvec3(all.voxels[i]) + 0.5) / static_cast<double>(all.detail),
             static_cast<double>(all.values[i].x - direct.result.irradiance.values[i].x)});
    return found;
}

/// Of those that `wanted` tells by their middles: how many, mean, least, most, root mean square off
/// the mean.
struct Spread {
    int count = 0;
    double mean = 0, least = 1e300, most = -1e300, rms = 0;
};

Spread spreadOf(const std::vector<Added>& added, const std::function<bool(dvec3)>& wanted) {
    Spread spread;
    double squares = 0;
    for (const Added& one : added) {
        if (!wanted(one.x)) continue;
        ++spread.count;
        spread.mean += one.irradiance;
        squares += one.irradiance * one.irradiance;
        spread.least = std::min(spread.least, one.irradiance);
        spread.most = std::max(spread.most, one.irradiance);
    }
    EXPECT_GT(spread.count, 0);
    spread.mean /= spread.count;
    spread.rms = std::sqrt(std::max(squares / spread.count - spread.mean * spread.mean, 0.0));
    return spread;
}

bool anywhere(dvec3) {
    return true;
}

const dvec3 kMiddle(12.1, 11.8, 12);
constexpr double kRadius = 8.3;

double hollowBall(dvec3 p) {
    return kRadius - glm::distance(p, kMiddle);
}

bool isInWall(dvec3 x) { // and not on the domain's faces, which cut it open
    return std::abs(hollowBall(x)) < 1;
}

// ---- A floor and a wall at right angles, a small spot of light on the floor.
constexpr double kFloor = 4.3, kWall = 4.2, kSpot = 12;

double corner(dvec3 p) {
    return std::min(p.y - kFloor, p.x - kWall);
}

/// By what the wall gets more, in the mean over some of it, than by the form factor.
double wallOverExact(std::int64_t photons, const std::function<bool(dvec3)>& wanted) {
    const TestVolume scene = opaqueVolume(ivec3(32), corner, dvec3(0.8), Edge::sharp);
    const Light light = parseLight("spot:12,6,16:0,-1,0:12:12:1000");
    double found = 0, exact = 0;
    for (const Added& one : addedBy(scene, bouncing(light, 1, 2, photons))) {
        if (std::abs(one.x.x - kWall) > 0.3 || !wanted(one.x)) continue;
        const double h = one.x.y - kFloor, across = kSpot - kWall, aside = one.x.z - 16;
        const double square = h * h + across * across + aside * aside;
        exact += 0.8 * powerOf(light).x * h * across / (kPi * square * square);
        found += one.irradiance;
    }
    EXPECT_GT(exact, 0);
    return found / exact - 1;
}

} // namespace

TEST(BouncesTruth, AHollowBallIsLitEvenly) {
    // Every point of its wall sees every other one by the same form factor. Were one bounce's
    // direction to follow from the last one's, the second would draw patterns.
    for (const Edge edge : {Edge::sharp, Edge::blurred}) {
        SCOPED_TRACE(edge == Edge::sharp ? "sharp" : "blurred");
        const TestVolume scene = opaqueVolume(ivec3(24), hollowBall, dvec3(0.5), edge);
        // Blurred, walls are cut into voxels that photons stop at.
        const double off = edge == Edge::sharp ? 0.002 : 0.04;
        for (const int bounces : {1, 2}) {
            const Spread spread =
                spreadOf(addedBy(scene, bouncing(lamp(kMiddle), bounces)), isInWall);
            const double exact = (1 - std::pow(0.5, bounces)) / (kRadius * kRadius);
            EXPECT_NEAR(spread.mean, exact, off * exact);
            EXPECT_LT(spread.rms, 0.02 * exact);
            EXPECT_GT(spread.least, 0.94 * exact);
            EXPECT_LT(spread.most, 1.1 * exact);
        }
    }
}

TEST(BouncesTruth, PointsGetWhatTheWallGets) {
    const TestVolume scene = opaqueVolume(ivec3(24), hollowBall, dvec3(0.5), Edge::sharp);
    Params params = bouncing(lamp(kMiddle), 2);
    params.points.width = 3;
    for (const dvec3& towards : {dvec3(1, 0, 0), dvec3(-1, 2, 1), dvec3(1, 1, -3)}) {
        const dvec3 outward = glm::normalize(towards);
        params.points.places.push_back(kMiddle + kRadius * outward);
        params.points.normals.emplace_back(-outward);
    }
    const Plan plan = makePlan(scene.volume(), params);
    Stats stats;
    const Result result = simulate(device(), plan, params, stats, {});
    const double exact = 1.75 / (kRadius * kRadius);
    ASSERT_EQ(result.points.size(), 1u);
    for (const LightAtPoint& light : result.points[0])
        EXPECT_NEAR(light.irradiance.x, exact, 0.03 * exact);
}

TEST(BouncesTruth, ALoneBallSendsNothingToItself) {
    for (const double radius : {3.2, 8.3}) {
        const auto ball = [&](dvec3 p) { return glm::distance(p, kMiddle) - radius; };
        const auto most = [&](Edge edge) {
            const TestVolume scene = opaqueVolume(ivec3(24), ball, dvec3(0.9), edge);
            return spreadOf(addedBy(scene, bouncing(beam({0.3, -1, 0.2}), 3)), anywhere).most;
        };
        EXPECT_EQ(most(Edge::sharp), 0);
        // Rays that leave nearly along the surface meet the corners of its voxels.
        EXPECT_LT(most(Edge::blurred), 2e-3);
    }
}

bool isFarUp(dvec3 x) {
    return x.y > 9;
}

TEST(BouncesTruth, AWallGetsItsFormFactor) {
    EXPECT_NEAR(wallOverExact(1 << 18, isFarUp), 0, 0.02);
    const auto some = [](dvec3 x) { return std::abs(x.y - 18) < 1 && std::abs(x.z - 16) < 3; };
    EXPECT_NEAR(wallOverExact(1 << 18, some), 0, 0.02);
}

TEST(BouncesTruth, MorePhotonsShareLessOfTheirLight) {
    // Near the corner, where the wall's light bends most, it is too dim by its being shared out.
    const auto near = [](dvec3 x) { return std::abs(x.y - 10) < 1 && std::abs(x.z - 16) < 3; };
    EXPECT_LT(wallOverExact(1 << 16, near), -0.05);
    EXPECT_NEAR(wallOverExact(1 << 20, near), 0, 0.025);
    EXPECT_NEAR(wallOverExact(1 << 20, isFarUp), 0, 0.01);
}

TEST(BouncesTruth, AWallOfOneVoxelLetsNoneThrough) {
    for (const Edge edge : {Edge::sharp, Edge::blurred})
        for (const double at : {12.25, 12.5}) {
            SCOPED_TRACE(at);
            const auto distance = [=](dvec3 p) {
                return std::min(7.7 - std::abs(p.y - 12), std::abs(p.x - at) - 0.5);
            };
            const TestVolume scene = opaqueVolume(ivec3(24), distance, dvec3(0.9), edge);
            const std::vector<Added> added =
                addedBy(scene, bouncing(lamp({8, 12, 12}), 2, 4, 1 << 14));
            const auto beside = [&](double from, double to) {
                return spreadOf(added, [=](dvec3 x) {
                    return x.x - at > from && x.x - at < to && std::abs(x.y - 12) < 8.2 &&
                           std::abs(x.z - 12) < 6;
                });
            };
            EXPECT_GT(beside(-3, -0.2).least, 0);
            EXPECT_EQ(beside(0.2, 3).most, 0); // nor through the floor at its foot
        }
}

TEST(BouncesTruth, WhatVoxelsBoundGetsWhatDistancesBound) {
    // Opacity that is 0 or 1 ends between two voxels' middles.
    const auto plates = [](dvec3 p) { return 8 - std::abs(p.y - 12); };
    TestVolume cut{ivec3(24)};
    cut.constant("ior", 1);
    cut.add("opacity", [&](dvec3 p) { return plates(p) < 0 ? 1.0 : 0.0; });
    cut.constantVector("albedo", dvec3(0.9));
    const Params params = bouncing(parseLight("spot:12,12,12:0,-1,0:30:30:1000"), 1);
    const auto ceiling = [](dvec3 x) {
        return std::abs(x.y - 20) < 1 && glm::distance(x, dvec3(12, x.y, 12)) < 3;
    };
    const double found = spreadOf(addedBy(cut, params), ceiling).mean;
    const double wanted =
        spreadOf(addedBy(opaqueVolume(ivec3(24), plates, dvec3(0.9), Edge::sharp), params), ceiling)
            .mean;
    EXPECT_GT(wanted, 0.5);
    EXPECT_NEAR(found, wanted, 0.02 * wanted);
}

TEST(BouncesTruth, AThinPoleHasNoDarkSpecks) {
    const auto pole = [](dvec3 p) {
        return std::min(p.y - kFloor, std::hypot(p.x - 12.2, p.z - 12) - 0.8);
    };
    const TestVolume scene = opaqueVolume(ivec3(24), pole, dvec3(0.9), Edge::sharp);
    const std::vector<Added> added = addedBy(scene, bouncing(beam({0, -1, 0}), 1, 4));
    const auto isPole = [](dvec3 x) { return x.y > 6 && x.y < 18; };
    const Spread spread = spreadOf(added, isPole);
    EXPECT_GT(spread.least, 0.2 * spread.mean);
}
