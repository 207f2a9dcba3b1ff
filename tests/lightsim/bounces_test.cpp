// Light that opaque surfaces send on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"
#include "support/lit.h"
#include "support/opaque_volume.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = std::numbers::pi;

/// Negative outside a box about the middle of that many voxels, whose half edge that is.
std::function<double(dvec3)> hollow(double middle, double half) {
    return [=](dvec3 p) {
        const dvec3 q = glm::abs(p - middle) - half;
        return -(glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0));
    };
}

/// Floor and ceiling, 15.4 apart.
double plates(dvec3 p) {
    return 7.7 - std::abs(p.y - 12);
}

Params bouncing(const Light& light, int bounces, std::int64_t photons = 1 << 16) {
    Params params = paramsOf({light}, photons);
    params.outputs = Output::irradiance;
    params.surfaceDetail = 1;
    params.bounces = bounces;
    return params;
}

dvec3 sumOf(const Lit& lit) {
    dvec3 sum(0);
    for (const glm::vec3& e : lit.result.irradiance.values) sum += e;
    return sum;
}

/// Mean irradiance of surface voxels that `wanted` tells by their middles.
dvec3 meanWhere(const Lit& lit, const std::function<bool(dvec3)>& wanted) {
    const volume::FineGrid& grid = lit.result.irradiance;
    dvec3 sum(0);
    double count = 0;
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        if (!wanted((dvec3(grid.voxels[i]) + 0.5) / static_cast<double>(grid.detail))) continue;
        sum += grid.values[i];
        ++count;
    }
    EXPECT_GT(count, 0);
    return sum / std::max(count, 1.0);
}

/// A lamp that lights a spot of the floor below the middle, a voxel wide.
Light spotOnFloor() {
    return parseLight("spot:12,6,12:0,-1,0:12:12:1000");
}

/// Mean of what a matt point at the origin with unit power gives a ceiling at height h over
/// [−4, 4]².
double overPoint(double h) {
    double sum = 0;
    for (int i = 0; i < 80; ++i)
        for (int j = 0; j < 80; ++j) {
            const double x = (i + 0.5) / 10 - 4, z = (j + 0.5) / 10 - 4;
            const double off = x * x + z * z + h * h;
            sum += h * h / (kPi * off * off) / 6400;
        }
    return sum;
}

bool isCeilingOverSpot(dvec3 x) {
    return std::abs(x.y - 19.7) < 1 && std::abs(x.x - 12) < 4 && std::abs(x.z - 12) < 4;
}

} // namespace

/// What the walls of a closed box of albedo ½ get in all, by what they get directly.
void expectSeries(Edge edge, int detail, double off) {
    const TestVolume scene = opaqueVolume(ivec3(20), hollow(10, 5.7), dvec3(0.5), edge);
    const auto with = [&](int bounces) {
        Params params = bouncing(parseLight("point:10,10.5,9"), bounces);
        params.surfaceDetail = detail;
        return Lit(scene.volume(), params);
    };
    const double direct = sumOf(with(0)).x;
    for (const int bounces : {1, 2, 12}) {
        SCOPED_TRACE(bounces);
        const Lit lit = with(bounces);
        const double series = 2 - std::pow(0.5, bounces);
        EXPECT_NEAR(sumOf(lit).x, series * direct, off * series * direct);
        EXPECT_NEAR(lit.stats.energy.absorbed[0], 4 * kPi, 1e-3 * 4 * kPi);
        EXPECT_LT(lit.stats.energy.escaped[0], 1e-3);
        // The albedo's share of what the last bounce brings.
        const double left = std::pow(0.5, bounces + 1);
        EXPECT_NEAR(lit.counter("light_left_after_bounces"), left, off * left);
    }
}

TEST(LightBounces, AClosedBoxAddsUpTheSeries) {
    expectSeries(Edge::sharp, 1, 0.01);
}

TEST(LightBounces, ABlurredBoxAddsUpTheSeries) {
    // Its edges are cut off, which are a larger share of its surface voxels than of its walls.
    expectSeries(Edge::voxels, 2, 0.02);
}

TEST(LightBounces, TheFirstIsThatOfAMattPoint) {
    const dvec3 albedo(0.8, 0.4, 0.2);
    const TestVolume scene = opaqueVolume(ivec3(24), plates, albedo);
    const Light light = spotOnFloor();
    const Lit lit(scene.volume(), bouncing(light, 1, 1 << 20)); // so many are not shared out
    const dvec3 power = powerOf(light);
    const dvec3 found = meanWhere(lit, isCeilingOverSpot);
    for (int c = 0; c < 3; ++c) {
        const double exact = albedo[c] * power[c] * overPoint(15.4);
        EXPECT_NEAR(found[c], exact, 0.02 * exact);
    }
    EXPECT_EQ(sumOf(Lit(scene.volume(), bouncing(light, 0))).y,
              sumOf(Lit(scene.volume(), bouncing(light, 0))).x); // grey before
}

TEST(LightBounces, GlassOnItsWayTakesFresnelsShare) {
    const dvec3 up(0, 1, 0);
    sharp::Voxels voxels;
    voxels.size = ivec3(24);
    voxels.halfWidth = 4;
    volume::Volume volume =
        sharp::volumeOf({{judge::glassHull({{up, 4.3}}, 1), judge::glassHull({{-up, -19.7}}, 1),
                          judge::glassHull({{up, 17}, {-up, -13}}, 1.5)}},
                        voxels);
    for (const char* plate : {".S0", ".S1"}) {
        volume.putConstant(std::string("opacity") + plate, glm::vec3(1));
        volume.putConstant(std::string("albedo") + plate, glm::vec3(0.5));
    }
    const Lit lit(volume, bouncing(spotOnFloor(), 1, 1 << 18));
    // To and fro within the slab: 2R/(1 + R) turns back; and it brings the floor nearer by t(1 −
    // 1/n).
    const double through = 1 - 2 * 0.04 / 1.04, near = 15.4 - 4 * (1 - 1 / 1.5);
    const double exact = 0.5 * powerOf(spotOnFloor()).x * through * overPoint(near);
    EXPECT_NEAR(meanWhere(lit, isCeilingOverSpot).x, exact, 0.03 * exact);
}

TEST(LightBounces, AThinWallLetsNoneThrough) {
    // The plates and a wall of two voxels between their halves, light on one side of it.
    const auto distance = [](dvec3 p) { return std::min(plates(p), std::abs(p.x - 15.2) - 1); };
    const TestVolume scene = opaqueVolume(ivec3(24), distance, dvec3(0.9));
    const Lit lit(scene.volume(), bouncing(parseLight("point:8,12,12"), 3));
    const auto beyond = [](dvec3 x) {
        return x.x > 15.7 && std::abs(x.y - 12) < 8.2 && x.x < 23 && x.z > 1 && x.z < 23;
    };
    EXPECT_EQ(meanWhere(lit, beyond).x, 0);
    EXPECT_GT(meanWhere(lit, [](dvec3 x) { return x.x < 14.5 && x.y > 12; }).x, 0);
}

TEST(LightBounces, AddToWhatVolumesScatter) {
    // A haze in a hollow ball with a lamp in its middle: walls of albedo ρ get Φ/4πR²/(1 − ρ), and
    // send 4ρ of that everywhere.
    const auto ball = [](dvec3 p) { return 7.3 - glm::distance(p, dvec3(10)); };
    TestVolume scene = opaqueVolume(ivec3(20), ball, dvec3(0.5));
    scene.constantVector("scattering", dvec3(1e-4));
    Params params = bouncing(parseLight("point:10,10,10"), 0, 1 << 16);
    params.outputs = Output::both | Output::irradiance;
    const Lit direct(scene.volume(), params);
    params.bounces = 12;
    const Lit all(scene.volume(), params);
    double added = 0;
    forEachVoxel(ivec3(4), [&](ivec3 p) {
        added += all.fluence(ivec3(8) + p) - direct.fluence(ivec3(8) + p);
    });
    const double exact = 4 * 0.5 / (7.3 * 7.3) / 0.5;
    EXPECT_NEAR(added / 64, exact, 0.02 * exact);
}

TEST(LightBounces, PointsGetThem) {
    const TestVolume scene = opaqueVolume(ivec3(24), plates, dvec3(0.5));
    Params params = bouncing(spotOnFloor(), 1, 1 << 18);
    params.points.width = 1;
    params.points.places = {dvec3(12, 19.7, 12)};
    params.points.normals = {glm::vec3(0, -1, 0)};
    params.automaticOutputs = true;
    const Plan plan = makePlan(scene.volume(), params);
    Stats stats;
    const Result result = simulate(device(), plan, params, stats, {});
    ASSERT_EQ(result.points.size(), 1u);
    const LightAtPoint& light = result.points[0][0];
    const double exact = 0.5 * powerOf(spotOnFloor()).x / (kPi * 15.4 * 15.4);
    EXPECT_NEAR(light.irradiance.x, exact, 0.05 * exact);
    EXPECT_NEAR(light.flow.y, exact, 0.06 * exact); // it comes from right below
}

TEST(LightBounces, TheSameRunGivesTheSameBytesAndNoneChangesNothing) {
    const TestVolume scene = opaqueVolume(ivec3(20), hollow(10, 5.7), dvec3(0.5));
    const Light lamp = parseLight("point:10,10,9");
    const auto with = [&](int bounces) {
        return Lit(scene.volume(), bouncing(lamp, bounces, 1 << 14)).result.irradiance.values;
    };
    EXPECT_EQ(with(2), with(2));
    // Black walls send nothing on.
    const TestVolume black = opaqueVolume(ivec3(20), hollow(10, 5.7), dvec3(0));
    const Lit none(black.volume(), bouncing(lamp, 5, 1 << 14));
    EXPECT_EQ(none.plan.bounces, 0);
    EXPECT_EQ(none.result.irradiance.values, with(0));
}
