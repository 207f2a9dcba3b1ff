// How a light simulation is run: batches, thinning, seeds, proxies, outputs, the octree.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

#include "base/error.h"
#include "support/shapes.h"

#include <set>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;

namespace {

TestVolume glassBall(int size) {
    TestVolume scene{ivec3(size)};
    scene.index([=](dvec3 p) {
        const double depth = 0.35 * size - glm::length(p - 0.5 * size);
        return 1 + 0.25 * std::erfc(-depth / 2);
    });
    return scene;
}

/// Mean absolute difference of fluence between two runs of one volume.
double difference(const Lit& a, const Lit& b) {
    double sum = 0;
    forEachVoxel(a.plan.scene.size(),
                 [&](ivec3 p) { sum += std::abs(a.fluence(p) - b.fluence(p)); });
    return sum / static_cast<double>(a.plan.voxels());
}

Triangles cornersOf(const mesh::TriangleMesh& mesh) {
    Triangles corners;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i) corners.push_back(mesh.points[triangle[i]]);
    return corners;
}

} // namespace

TEST(LightRun, TwoRunsGiveTheSameBits) {
    TestVolume scene = glassBall(16);
    scene.constantVector("scattering", {0.01, 0.02, 0.03});
    const Params params = paramsOf({beam({1, 2, 3}), lamp({5, 6, 7})}, 1 << 13);
    const Lit a(scene.volume(), params), b(scene.volume(), params);
    EXPECT_EQ(a.result.fluence.values, b.result.fluence.values);
    EXPECT_EQ(a.result.direction.values, b.result.direction.values);
    EXPECT_EQ(a.stats.counters, b.stats.counters);
    EXPECT_EQ(a.stats.energy.absorbed, b.stats.energy.absorbed);
}

TEST(LightRun, SeedsDifferAndAgree) {
    const TestVolume scene = glassBall(16);
    Params params = paramsOf({beam({0.1, 0.3, 1})}, 1 << 14);
    const Lit first(scene.volume(), params);
    params.seed = 1;
    const Lit second(scene.volume(), params);
    EXPECT_NE(first.result.fluence.values, second.result.fluence.values);
    // 64 pixels a voxel shifted by part of one: 5 % of noise, more in the caustic.
    EXPECT_LT(difference(first, second), 0.05);
    EXPECT_NEAR(first.total(), second.total(), 0.01 * first.total()); // the box's outline
}

TEST(LightRun, BatchesChangeThePartitionNotThePhysics) {
    const TestVolume scene = glassBall(6);
    const Lit few(scene.volume(), paramsOf({beam({0.1, 0.3, 1}), lamp({3, 3, 30})}, 1 << 16));
    const Lit many(scene.volume(), paramsOf({beam({0.1, 0.3, 1}), lamp({3, 3, 30})}, 1100000));
    EXPECT_GT(many.counter("photons"), kBatchPixels);
    EXPECT_NEAR(many.stats.energy.entered[0], few.stats.energy.entered[0],
                3e-3 * few.stats.energy.entered[0]); // the box's outline among 2^16 pixels
    EXPECT_NEAR(many.total(), few.total(), 3e-3 * few.total()); // as above
    EXPECT_LT(difference(few, many), 0.02); // 1024 pixels a voxel: 1 % of noise, some caustic
}

TEST(LightRun, ThinningLosesWhatItSaysItLoses) {
    // Askew rays of many lengths, in steps so short that most need several launches.
    TestVolume scene({64, 16, 4});
    scene.index([](dvec3 p) { return 1.3 + 0.02 * std::sin(p.x) * std::sin(p.y); });
    Params params = paramsOf({beam({1, 0.3, 0.02})}, 1 << 12);
    params.stepMin = 0.25;
    params.thinTo = 0;
    const Lit whole(scene.volume(), params);
    EXPECT_EQ(whole.counter("photons_left_by_thinning"), 0);
    EXPECT_NEAR(whole.stats.energy.lost[0], 0, 1e-9);
    params.thinTo = 0.6;
    const Lit thinned(scene.volume(), params);
    const double left = thinned.counter("photons_left_by_thinning");
    ASSERT_GT(left, 0);
    EXPECT_LE(left, 0.6 * thinned.counter("photons"));
    // Every photon has the same weight.
    const Energy& energy = thinned.stats.energy;
    EXPECT_NEAR(energy.lost[0], energy.entered[0] * left / thinned.counter("photons"),
                1e-6 * energy.entered[0]);
    EXPECT_LT(thinned.total(), whole.total());
}

TEST(LightRun, TrappedPhotonsAreCountedAndLost) {
    const TestVolume scene = glassBall(16);
    Params params = paramsOf({beam({0, 0, 1})}, 1 << 12);
    params.maxSteps = 3;
    const Lit lit(scene.volume(), params);
    const double trapped = lit.counter("trapped");
    EXPECT_GT(trapped, 0.5 * lit.counter("photons"));
    EXPECT_NEAR(lit.stats.energy.lost[0],
                lit.stats.energy.entered[0] * trapped / lit.counter("photons"),
                1e-6 * lit.stats.energy.entered[0]); // every photon has the same weight
    EXPECT_LE(lit.counter("steps"), 3 * lit.counter("photons"));
}

TEST(LightRun, FaintPhotonsAreDropped) {
    TestVolume scene({32, 4, 4});
    scene.constantVector("absorption", dvec3(1));
    Params params = paramsOf({beam({1, 0, 0})}, 1 << 12);
    params.octreeTolerance = 0;
    params.octreeTolerance2 = 0;
    params.stepMin = 1;
    params.dropBelow = 0.01;
    const Lit lit(scene.volume(), params);
    EXPECT_LE(lit.stats.energy.lost[0], 0.01 * lit.stats.energy.entered[0]);
    // Whether it is dropped or not, it is dark beyond: exp(−5) is below 0.01.
    EXPECT_LT(lit.fluence({20, 1, 1}), 0.01);
}

TEST(LightRun, AProxyIsWherePhotonsStart) {
    // A cube of 6 voxels amid 16: bright from its upper face down, dark elsewhere.
    TestVolume scene(ivec3(16));
    scene.constant("ior", 1);
    Params params = paramsOf({beam({0, -1, 0})}, 1 << 14);
    params.proxy = cornersOf(mesh::boxShape(dvec3(5), dvec3(11)));
    const Lit lit(scene.volume(), params);
    // The pixels divide the cube's face evenly but for those on its edge, a row or two of 128.
    EXPECT_NEAR(lit.stats.energy.entered[0], 36, 36 * 0.03);
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        const bool lightFalls = p.x >= 5 && p.x < 11 && p.z >= 5 && p.z < 11 && p.y < 11;
        // 21⅓ pixels to a voxel's edge: where 22 of them fall into it each way, 6.4 % too many.
        ASSERT_NEAR(lit.fluence(p), lightFalls ? 1 : 0, 0.07) << p.x << " " << p.y << " " << p.z;
    });
    // A ball inside another is seen by its own silhouette, π r².
    params.proxy = cornersOf(mesh::moved(mesh::icosphere(5, 3), dvec3(8)));
    const Lit round(scene.volume(), params);
    const double disc = 3.14159265 * 25;
    EXPECT_NEAR(round.stats.energy.entered[0], disc, 0.02 * disc); // facets cut off 0.6 %
    EXPECT_GT(round.fluence({8, 2, 8}), 0.9);
    EXPECT_EQ(round.fluence({8, 14, 8}), 0);
    // One that reaches beyond the domain starts them where they enter it, and those that miss it
    // count for nothing: a box of 26 voxels around one of 16.
    params.proxy = cornersOf(mesh::boxShape(dvec3(-5), dvec3(21)));
    params.photons = 1 << 16;
    const Lit large(scene.volume(), params);
    EXPECT_NEAR(large.stats.energy.entered[0], 256, 256 * 0.03); // a row or two of 157 pixels
    forEachVoxel(ivec3(16), [&](ivec3 p) {
        ASSERT_NEAR(large.fluence(p), 1, 0.2); // 9 by 9 pixels where 9.85² belong
    });
}

TEST(LightRun, AutoSimulatesWhatARenderNeeds) {
    const auto planOf = [](TestVolume& scene) {
        Params params = paramsOf({beam({0, -1, 0})}, 1 << 10);
        params.automaticOutputs = true;
        return makePlan(scene.volume(), params);
    };
    TestVolume glass = glassBall(8);
    EXPECT_EQ(planOf(glass).outputs, Output::none);
    glass.constantVector("absorption", dvec3(1));
    EXPECT_EQ(planOf(glass).outputs, Output::none);
    glass.constantVector("scattering", dvec3(1));
    EXPECT_EQ(planOf(glass).outputs, Output::fluence);
    glass.constant("anisotropy", 0.3);
    EXPECT_EQ(planOf(glass).outputs, Output::both);
    TestVolume solid(ivec3(8));
    solid.add("opacity", [](dvec3 p) { return p.x > 4 ? 1 : 0; });
    EXPECT_EQ(planOf(solid).outputs, Output::irradiance);
    TestVolume nothing(ivec3(8));
    nothing.constantVector("scattering", dvec3(0));
    EXPECT_EQ(planOf(nothing).outputs, Output::none);
}

TEST(LightRun, APlaneForEveryChannelThatDiffersAndNoMore) {
    const auto planesOf = [](const dvec3& sigma, Output outputs, const dvec3& rgb) {
        TestVolume scene(ivec3(8));
        scene.constantVector("scattering", sigma);
        Params params = paramsOf({beam({0, -1, 0}, rgb)}, 1 << 10);
        params.outputs = outputs;
        const Lit lit(scene.volume(), params);
        const double planes = lit.counter("atomic_adds") / lit.counter("deposits");
        EXPECT_EQ(planes, lit.plan.planes());
        EXPECT_EQ(lit.result.direction.values.empty(), outputs == Output::fluence);
        EXPECT_EQ(lit.result.fluence.values.empty(), outputs == Output::direction);
        return planes;
    };
    const dvec3 grey(0.1), coloured(0.1, 0.2, 0.3);
    EXPECT_EQ(planesOf(grey, Output::fluence, dvec3(1)), 1);
    EXPECT_EQ(planesOf(grey, Output::fluence, {1, 2, 3}), 1); // one plane serves a coloured light
    EXPECT_EQ(planesOf(grey, Output::both, dvec3(1)), 4);
    EXPECT_EQ(planesOf(coloured, Output::fluence, dvec3(1)), 3);
    EXPECT_EQ(planesOf(coloured, Output::both, dvec3(1)), 6);
    EXPECT_EQ(planesOf(grey, Output::direction, dvec3(1)), 4);
}

TEST(LightRun, TheOctreeIsCoarseWhereNothingHappens) {
    const Params params = paramsOf({beam({0, -1, 0})});
    TestVolume even(ivec3(16));
    even.constant("ior", 1.3);
    const OctreeDump one = dumpOctree(makePlan(even.volume(), params), params);
    const auto& level = one.level.values;
    EXPECT_EQ(std::set<float>(level.begin(), level.end()).size(), 1u);
    EXPECT_GE(level[0], 4); // 2^4 voxels and more
    EXPECT_EQ(one.stepLimit.values[0], 1e6f);

    // An edge at x = 20 blurred over some voxels each way.
    TestVolume edge(ivec3(64, 16, 16));
    edge.index([](dvec3 p) { return 1.25 + 0.25 * std::erf((p.x - 20) / 2); });
    const OctreeDump many = dumpOctree(makePlan(edge.volume(), params), params);
    forEachVoxel({64, 16, 16}, [&](ivec3 p) {
        const double found = at(many.level, p);
        if (p.x >= 17 && p.x < 23) {
            ASSERT_EQ(found, 0) << p.x; // over two voxels and more the index rises by 0.05
            ASSERT_EQ(at(many.stepLimit, p), params.stepMin);
        }
        // Half a leaf's distance from the edge and more: whole blocks of 16.
        if (p.x >= 32) {
            ASSERT_GE(found, 4) << p.x;
        }
        // The gradient's reach is two voxels: a leaf that may be crossed in one step has none.
        if (found >= 1 && p.x > 20) {
            ASSERT_GT(p.x, 22);
        }
    });
}

TEST(LightRun, WrongParametersAreUsageErrors) {
    const auto refused = [](const std::function<void(Params&)>& spoil) {
        Params params = paramsOf({beam({0, -1, 0})});
        spoil(params);
        EXPECT_THROW(params.check(), UsageError);
    };
    EXPECT_NO_THROW(paramsOf({beam({0, -1, 0})}).check());
    refused([](auto& p) { p.lights.clear(); });
    refused([](auto& p) { p.photons = -1; });
    refused([](auto& p) { p.shadowCull = 0; });
    refused([](auto& p) { p.octreeTolerance = -1; });
    refused([](auto& p) { p.octreeTolerance = std::nan(""); });
    refused([](auto& p) { p.octreeTolerance2 = 0.001; });
    refused([](auto& p) { p.stepLimit = 0; });
    refused([](auto& p) { p.stepMin = 0; });
    refused([](auto& p) { p.maxSteps = 0; });
    refused([](auto& p) { p.dropBelow = 1; });
    refused([](auto& p) { p.thinTo = -0.1; });
    refused([](auto& p) { p.smoothing = 65; });
}

TEST(LightRun, LightsAreReadAsTheyAreWritten) {
    const Light sun = parseLight("directional:0,-3,4:1,2,3");
    EXPECT_EQ(sun.kind, Light::Kind::directional);
    EXPECT_LT(glm::length(sun.vector - dvec3(0, -0.6, 0.8)), 1e-15); // rounding
    EXPECT_EQ(sun.rgb, dvec3(1, 2, 3));
    const Light bulb = parseLight("point:1,2.5,-3");
    EXPECT_EQ(bulb.kind, Light::Kind::point);
    EXPECT_EQ(bulb.vector, dvec3(1, 2.5, -3));
    EXPECT_EQ(bulb.rgb, dvec3(1));
    EXPECT_EQ(parseLight("point:0,0,0:7").rgb, dvec3(7));
}

TEST(LightRun, AutomaticPhotonsAreSoManyAVoxel) {
    // Across the light, a cube of 24 voxels is an area of 24² or, seen along its diagonal, √3 as
    // much.
    const TestVolume scene = glassBall(24);
    Params params = paramsOf({beam({0, 0, 1})});
    params.photons = 0;
    EXPECT_NEAR(Lit(scene.volume(), params).counter("photons"), 36 * 24 * 24, 36 * 4 * 24);
    params.lights = {beam({1, 1, 1})};
    EXPECT_NEAR(Lit(scene.volume(), params).counter("photons"), 36 * std::sqrt(3) * 24 * 24,
                36 * 4 * 24);
    // A lamp four edges off sees a face and a little of what is behind it.
    params.lights = {lamp({12, 12, 120})};
    EXPECT_NEAR(Lit(scene.volume(), params).counter("photons"), 36 * 24 * 24, 36 * 8 * 24);
}

TEST(LightRun, AutomaticPhotonsAreEnough) {
    const int size = 32;
    TestVolume scene{ivec3(size)};
    scene.add(
        "sdf", [=](dvec3 p) { return glm::length(p - 0.5 * size) - 0.3 * size; }, 1e3);
    scene.constant("ior", 1.5);
    scene.constant("scattering", 0.05 / size);
    scene.add("scattering.medium", [=](dvec3) { return 0.05 / size; });
    Params params = paramsOf({beam({0.3, -1, 0.2})});
    params.outputs = Output::fluence;
    params.smoothing = 1;
    params.photons = 0;
    const Lit found(scene.volume(), params);
    params.photons = std::int64_t{1024} * size * size;
    params.seed = 3;
    const Lit wanted(scene.volume(), params);
    double off = 0, sum = 0;
    forEachVoxel(ivec3(size), [&](ivec3 p) {
        off += std::abs(found.fluence(p) - wanted.fluence(p));
        sum += wanted.fluence(p);
    });
    EXPECT_LT(off / sum, 0.005);
}
