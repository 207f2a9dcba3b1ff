// Scenes: which voxels the domain has, who gets a shared one, and what it holds then.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "support/lattice.h"
#include "voxelize/voxelize.h"

#include <gtest/gtest.h>

namespace eikonal::voxelize {
namespace {

using glm::dvec3;
using glm::ivec3;

Object objectOf(const mesh::TriangleMesh& mesh, double ior, int priority = 0) {
    Object object;
    object.name = "object" + toText(ior);
    object.material.ior = ior;
    object.priority = priority;
    object.mesh = mesh;
    return object;
}

/// Voxels of edge 1 that tile the box from 0 to `size`.
Params unitVoxels(const dvec3& size, std::vector<Object> objects) {
    Params params;
    params.objects = std::move(objects);
    params.voxelSize = 1;
    params.bounds = mesh::Box{dvec3(0), size};
    params.sharp = false;
    return params;
}

struct Scene {
    Plan plan;
    Stats stats;
    Result result;

    float at(const std::string& grid, const ivec3& voxel, int component = 0) const {
        return result.volume.dense(grid, {voxel, voxel}).values[static_cast<size_t>(component)];
    }
    bool has(const std::string& grid) const { return result.volume.has(grid); }
    bool on(const std::string& effect) const {
        for (const Effect& candidate : stats.effects)
            if (candidate.name == effect) return candidate.on;
        ADD_FAILURE() << "no effect " << effect;
        return false;
    }
};

Scene make(const Params& params, std::int64_t stripBytes = kStripBytes) {
    params.check();
    const Plan plan = makePlan(params);
    Stats stats;
    Result result = voxelize(testDevice(), params, plan, stats, {}, stripBytes);
    return {plan, stats, std::move(result)};
}

mesh::TriangleMesh box(const dvec3& from, const dvec3& to) {
    return mesh::boxShape(from, to);
}

TEST(Domain, HasTheResolutionAlongItsLongestEdge) {
    Params params;
    params.objects = {objectOf(box({1, 2, 3}, {5, 4, 3.5}), 1.5)};
    params.resolution = 40;
    params.padding = 4;
    const Plan plan = makePlan(params);
    EXPECT_EQ(plan.lattice.size, ivec3(40, 24, 12));
    EXPECT_EQ(plan.lattice.voxelSize, 0.125);
    EXPECT_EQ(plan.lattice.low, dvec3(0.5, 1.5, 2.5));
    // Voxel 0's centre lies half a voxel inside the low corner.
    EXPECT_EQ(dvec3(plan.frame.worldFromIndex[3]), dvec3(0.5625, 1.5625, 2.5625));
    EXPECT_EQ(plan.box, (volume::IndexBox{{0, 0, 0}, {39, 23, 11}}));
}

TEST(Domain, TakesVoxelSizeCubeAndBounds) {
    Params params;
    params.objects = {objectOf(box({0, 0, 0}, {4, 2, 1.1}), 1.5)};
    params.voxelSize = 0.5;
    params.padding = 1;
    EXPECT_EQ(makePlan(params).lattice.size, ivec3(10, 6, 5));
    params.cube = true;
    EXPECT_EQ(makePlan(params).lattice.size, ivec3(10));
    EXPECT_EQ(makePlan(params).lattice.low, dvec3(-0.5, -1.5, -1.95));
    params.cube = false;
    params.bounds = mesh::Box{dvec3(-1), dvec3(2, 1, 1)};
    EXPECT_EQ(makePlan(params).lattice.size, ivec3(6, 4, 4)); // no padding
}

TEST(Domain, LeavesHalfOfItsVoxelsToTheObjectsUnlessToldOtherwise) {
    Params params;
    params.objects = {objectOf(box({0, 0, 0}, {4, 2, 1}), 1.5)};
    // Padding 8, or a quarter: of 1, 3, 16, 31 voxels 1, 3, 8, 17 are left.
    const std::pair<int, double> cases[] = {{1, 1},   {3, 3},   {16, 8},
                                            {31, 17}, {32, 16}, {128, 112}};
    for (const auto& [resolution, left] : cases) {
        params.resolution = resolution;
        EXPECT_NO_THROW(params.check()) << resolution;
        const Plan plan = makePlan(params);
        EXPECT_EQ(plan.lattice.size.x, resolution);
        EXPECT_EQ(plan.lattice.voxelSize, 4 / left) << resolution;
    }
    params.resolution = 16;
    params.padding = 8;
    EXPECT_THROW(params.check(), UsageError);
    params.padding = 7;
    EXPECT_NO_THROW(params.check());
    EXPECT_EQ(makePlan(params).lattice.voxelSize, 2);
}

TEST(Domain, PadsVoxelsOfAGivenSizeAsFarAsTheyMayGo) {
    Params params;
    params.objects = {objectOf(box({0, 0, 0}, {4, 2, 1}), 1.5)};
    params.voxelSize = 2; // few voxels lose none to padding
    EXPECT_EQ(makePlan(params).lattice.size, ivec3(18, 17, 17));
    params.voxelSize = 4.0 / 2040; // 2046 is the most
    EXPECT_EQ(makePlan(params).lattice.size.x, 2046);
    params.padding = 8;
    EXPECT_THROW(makePlan(params), UsageError);
}

TEST(Domain, RefusesTooManyVoxels) {
    Params params;
    params.objects = {objectOf(box({0, 0, 0}, {1, 1, 1}), 1.5)};
    params.voxelSize = 1e-4;
    EXPECT_THROW(makePlan(params), UsageError);
    params.voxelSize = 1e-300;
    EXPECT_THROW(params.check(), UsageError);
    params.voxelSize = {};
    params.objects[0].mesh = box(dvec3(0), dvec3(1e-20));
    EXPECT_THROW(makePlan(params), DataError);
    params.objects[0].mesh = box(dvec3(0), dvec3(1));
    params.resolution = 2046;
    params.objects[0].material.emission = params.objects[0].material.absorption =
        params.objects[0].material.scattering = dvec3(1);
    EXPECT_THROW(makePlan(params), MemoryError); // more than 400 GiB
}

TEST(Scene, FillsTheWholeBoxWithTheIndex) {
    const Scene scene = make(unitVoxels({6, 5, 4}, {objectOf(box({1, 1, 1}, {4.5, 3, 3}), 1.5)}));
    EXPECT_EQ(scene.result.volume.domain(), (volume::IndexBox{{0, 0, 0}, {5, 4, 3}}));
    EXPECT_EQ(scene.at("ior", {0, 0, 0}), 1.0f);
    EXPECT_EQ(scene.at("ior", {2, 2, 2}), 1.5f);
    EXPECT_EQ(scene.at("ior", {4, 2, 2}), 1.25f);
    EXPECT_EQ(scene.at("ior", {5, 2, 2}), 1.0f);
    EXPECT_EQ(scene.result.volume.grids().size(), 1u);
    EXPECT_TRUE(scene.on("ior"));
    EXPECT_FALSE(scene.on("absorption"));
}

TEST(Scene, HigherPriorityWinsWhateverTheOrder) {
    const auto glass = box({1, 1, 1}, {9, 9, 9}), bubble = box({3, 3, 3}, {6.5, 6, 6});
    for (bool glassFirst : {true, false}) {
        std::vector<Object> objects = {objectOf(glass, 1.5, 0), objectOf(bubble, 1.1, 2)};
        if (!glassFirst) std::swap(objects[0], objects[1]);
        const Scene scene = make(unitVoxels(dvec3(10), objects));
        EXPECT_EQ(scene.at("ior", {4, 4, 4}), 1.1f);
        EXPECT_EQ(scene.at("ior", {2, 4, 4}), 1.5f);
        EXPECT_FLOAT_EQ(scene.at("ior", {6, 4, 4}), 1.3f); // half of each
        EXPECT_EQ(scene.at("ior", {0, 4, 4}), 1.0f);
    }
    // A lower priority inside is not seen at all, wherever it stands.
    const Scene hidden =
        make(unitVoxels(dvec3(10), {objectOf(glass, 1.5), objectOf(bubble, 1.1, -1)}));
    EXPECT_EQ(hidden.at("ior", {4, 4, 4}), 1.5f);
}

TEST(Scene, LaterWinsAmongEquals) {
    const Scene scene = make(unitVoxels(dvec3(8), {objectOf(box(dvec3(1), dvec3(5)), 1.2),
                                                   objectOf(box(dvec3(3), dvec3(7)), 1.4)}));
    EXPECT_EQ(scene.at("ior", {4, 4, 4}), 1.4f);
    EXPECT_EQ(scene.at("ior", {2, 2, 2}), 1.2f);
}

TEST(Scene, LeavesNoGapBetweenAbuttingObjects) {
    // Both end amid voxel 3; sharing by products would leave a quarter of it to the air.
    const Scene scene = make(unitVoxels({8, 4, 4}, {objectOf(box({1, 1, 1}, {3.5, 3, 3}), 1.5),
                                                    objectOf(box({3.5, 1, 1}, {7, 3, 3}), 1.5)}));
    for (int x = 1; x < 7; ++x) EXPECT_EQ(scene.at("ior", {x, 2, 2}), 1.5f) << x;
}

TEST(Scene, MixesByVolume) {
    Object object = objectOf(box({1, 1, 1}, {3.25, 3, 3}), 1.6);
    object.material.dispersion = 0.004;
    object.material.absorption = {1, 2, 4};
    object.material.scattering = {0, 3, 3};
    object.material.anisotropy = 0.8;
    object.material.emission = {8, 0, 0};
    object.material.opacity = 0.5;
    object.material.albedo = {0.25, 0.5, 0.75};
    object.material.reflectance = {0, 0.5, 1};
    Params params = unitVoxels({5, 4, 4}, {object});
    params.medium.ior = 1.2;
    params.medium.scattering = dvec3(1);
    params.medium.anisotropy = -0.4;
    const Scene scene = make(params);
    const ivec3 in(2, 2, 2), edge(3, 2, 2), out(4, 2, 2); // 1, 1/4 and 0 of the object
    EXPECT_EQ(scene.at("ior", in), 1.6f);
    EXPECT_EQ(scene.at("ior", edge), 1.3f);
    EXPECT_EQ(scene.at("ior", out), 1.2f);
    EXPECT_EQ(scene.result.volume.background("ior", glm::vec3(0)).x, 1.2f);
    EXPECT_EQ(scene.at("dispersion", edge), 0.001f);
    EXPECT_EQ(scene.at("absorption", edge, 2), 1.0f);
    EXPECT_EQ(scene.at("absorption", out, 2), 0.0f);
    EXPECT_EQ(scene.at("scattering", edge, 0), 0.75f);
    EXPECT_EQ(scene.at("scattering", edge, 1), 1.5f);
    EXPECT_EQ(scene.at("scattering", out, 1), 1.0f);
    // Scattering 2 at g = 0.8 in a quarter, 1 at -0.4 in the rest.
    EXPECT_FLOAT_EQ(scene.at("anisotropy", edge), (0.5f * 0.8f - 0.75f * 0.4f) / 1.25f);
    EXPECT_EQ(scene.at("anisotropy", in), 0.8f);
    EXPECT_EQ(scene.at("anisotropy", out), -0.4f);
    EXPECT_EQ(scene.at("emission", edge), 2.0f);
    EXPECT_EQ(scene.at("opacity", edge), 0.125f);
    for (const ivec3& voxel : {in, edge, out}) // not mixed with what is not opaque
        EXPECT_EQ(scene.at("albedo", voxel, 1), 0.5f);
    EXPECT_EQ(scene.at("reflectance", edge, 0), 0.75f);
    EXPECT_EQ(scene.at("reflectance", out, 0), 1.0f);
    EXPECT_EQ(scene.result.volume.background("reflectance", glm::vec3(0)), glm::vec3(1));
}

TEST(Scene, AlbedoCountsWhatIsOpaque) {
    Object red = objectOf(box({1, 1, 1}, {3.5, 3, 3}), 1), blue = red,
           glass = objectOf(box({5, 1, 1}, {6, 3, 3}), 1.5);
    red.material.opacity = 1;
    red.material.albedo = {1, 0, 0};
    blue.mesh = box({3.5, 1, 1}, {5, 3, 3});
    blue.material.opacity = 1;
    blue.material.albedo = {0, 0, 1};
    glass.material.albedo = {0, 1, 0};
    const Scene scene = make(unitVoxels({7, 4, 4}, {red, blue, glass}));
    EXPECT_EQ(scene.at("albedo", {2, 2, 2}, 0), 1.0f);
    EXPECT_EQ(scene.at("albedo", {4, 2, 2}, 0), 0.0f);
    EXPECT_EQ(scene.at("albedo", {3, 2, 2}, 2), 0.5f);
    EXPECT_EQ(scene.at("albedo", {5, 2, 2}, 1), 0.0f);
    EXPECT_EQ(scene.at("albedo", {0, 0, 0}, 0), 0.5f); // the mean of what is opaque
}

TEST(Scene, LeavesOutAGridThatShowsNothing) {
    Object hidden = objectOf(box({2, 2, 2}, {3, 3, 3}), 1.1, -1);
    hidden.material.emission = dvec3(1);
    const Scene scene =
        make(unitVoxels(dvec3(5), {objectOf(box(dvec3(1), dvec3(4)), 1.5), hidden}));
    EXPECT_FALSE(scene.has("emission"));
    EXPECT_FALSE(scene.on("emission"));
}

TEST(Scene, WarnsOfAnObjectThatCoversNothing) {
    const Scene scene = make(unitVoxels(dvec3(5), {objectOf(box(dvec3(7), dvec3(8)), 1.5)}));
    ASSERT_EQ(scene.result.warnings.size(), 1u);
    EXPECT_NE(scene.result.warnings[0].find("'object1.5' covers no voxel"), std::string::npos);
    EXPECT_TRUE(make(unitVoxels(dvec3(5), {objectOf(box(dvec3(1), dvec3(4)), 1.5)}))
                    .result.warnings.empty());
}

TEST(Scene, IsTheSameInStrips) {
    Object ball = objectOf(mesh::moved(mesh::icosphere(4, 3), dvec3(6)), 1.5);
    ball.material.absorption = {1, 2, 3};
    const Params params =
        unitVoxels({12, 13, 11}, {ball, objectOf(box({2, 2, 2}, {8.3, 7.1, 6.6}), 1.3, 1)});
    const Scene whole = make(params), strips = make(params, 12 * 11 * 4 * 3);
    for (const char* grid : {"ior", "absorption"})
        EXPECT_EQ(whole.result.volume.dense(grid, whole.plan.box).values,
                  strips.result.volume.dense(grid, whole.plan.box).values);
}

TEST(Scene, CountsWhatItDid) {
    const Scene scene = make(unitVoxels(dvec3(6), {objectOf(box(dvec3(1), dvec3(3)), 1.5),
                                                   objectOf(box(dvec3(2), dvec3(5)), 1.3)}));
    const std::vector<std::pair<std::string, double>> expected = {
        {"triangles", 24}, {"voxels", 216}, {"occupied_voxels", 8 + 27 - 1}};
    EXPECT_EQ(scene.stats.counters, expected);
}

TEST(Distances, AreNegativeInsideAndInUnits) {
    Params params;
    params.objects = {objectOf(mesh::icosphere(2, 5), 1.5)};
    params.resolution = 48;
    const Scene scene = make(params);
    const double h = scene.plan.lattice.voxelSize;
    EXPECT_NEAR(scene.result.volume.background("sdf", glm::vec3(0)).x, 6 * h, 1e-6);
    int band = 0;
    for (int x = 0; x < 48; ++x) {
        const dvec3 place = dvec3(scene.plan.frame.worldFromIndex * glm::dvec4(x, 24, 24, 1));
        const double distance = glm::length(place) - 2;
        const double found = scene.at("sdf", {x, 24, 24});
        if (std::abs(distance) < 5.5 * h) {
            // The faces lie up to 1e-3 below the ball.
            EXPECT_NEAR(found, distance, 2e-3) << x;
            ++band;
        } else {
            EXPECT_GT(found * distance, 0) << x;
        }
    }
    EXPECT_GE(band, 20);
}

TEST(Distances, ArePositiveInACavity) {
    Params params = unitVoxels(
        dvec3(20), {objectOf(mesh::joined(box(dvec3(2), dvec3(18)),
                                          mesh::turnedInsideOut(box(dvec3(6), dvec3(14)))),
                             1.5)});
    params.sharp = true;
    const Scene scene = make(params);
    EXPECT_NEAR(scene.at("sdf", {3, 10, 10}), -1.5, 1e-5); // its centre at 3.5, as all by halves
    EXPECT_NEAR(scene.at("sdf", {4, 10, 10}), -1.5, 1e-5);
    EXPECT_NEAR(scene.at("sdf", {7, 10, 10}), 1.5, 1e-5);
    EXPECT_NEAR(scene.at("sdf", {0, 10, 10}), 1.5, 1e-5);
    EXPECT_GT(scene.at("sdf", {10, 10, 10}), 0);
}

TEST(Distances, HaveANamePerObject) {
    Params params = unitVoxels(
        dvec3(8), {objectOf(box(dvec3(1), dvec3(4)), 1.5), objectOf(box(dvec3(5), dvec3(7)), 1.3)});
    params.sharp = true;
    const Scene scene = make(params);
    EXPECT_TRUE(scene.has("sdf.object1.5") && scene.has("sdf.object1.3"));
    params.objects[1].name = params.objects[0].name;
    EXPECT_THROW(params.check(), UsageError);
}

TEST(OwnValues, AreWrittenWhereTheyAreNotTakenForGranted) {
    Object glass = objectOf(box(dvec3(2), dvec3(7)), 1.5, 3);
    glass.name = "glass";
    glass.material.absorption = {1, 2, 3};
    glass.material.reflectance = dvec3(0);
    Object wine = objectOf(box(dvec3(4), dvec3(9)), 1.3);
    wine.name = "wine";
    Params params = unitVoxels(dvec3(11), {glass, wine});
    params.sharp = true;
    params.medium.ior = 1.1;
    params.medium.scattering = dvec3(0.5);
    const Scene scene = make(params);
    const volume::Volume& volume = scene.result.volume;
    EXPECT_EQ(volume.constant("ior.glass"), glm::vec3(1.5f));
    EXPECT_EQ(volume.constant("ior.wine"), glm::vec3(1.3f));
    EXPECT_EQ(volume.constant("absorption.glass"), glm::vec3(1, 2, 3));
    EXPECT_EQ(volume.constant("reflectance.glass"), glm::vec3(0));
    for (const char* grid : {"absorption.wine", "reflectance.wine", "scattering.glass"})
        EXPECT_FALSE(volume.has(grid)) << grid;
    // The medium's index is the mixed grid's background, its scattering is not.
    EXPECT_FALSE(volume.has("ior.medium"));
    EXPECT_EQ(volume.constant("scattering.medium"), glm::vec3(0.5f));
    const auto objects = volume.objects();
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_EQ(objects[0].name, "glass");
    EXPECT_EQ(objects[0].sdf, "sdf.glass");
    EXPECT_EQ(objects[0].priority, 3);
    EXPECT_EQ(objects[1].order, 1);
    params.sharp = false;
    EXPECT_EQ(make(params).result.volume.grids().size(), 4u); // those mixed by coverage
}

/// What is said of a plate of so many voxels.
std::vector<std::string> saidOfWall(double voxels, bool sharp = true) {
    Params params = unitVoxels({20, 20, 16}, {objectOf(box({2, 2, 4}, {18, 18, 4 + voxels}), 1.5)});
    params.sharp = sharp;
    return make(params).result.warnings;
}

TEST(ThinWalls, AreWarnedOfByTheErrorTheyMake) {
    const std::vector<std::pair<double, std::string>> wanted = {
        {0.5, "a sharp boundary loses it"},         {1.99, "a sharp boundary loses it"},
        {2, "rays through it may be 8° off"},       {2.02, "rays through it may be 7.7° off"},
        {3, "rays through it may be 1.4° off"},     {4, "rays through it may be 0.2° off"},
        {4.99, "rays through it may be 0.031° off"}};
    for (const auto& [voxels, words] : wanted) {
        const std::vector<std::string> said = saidOfWall(voxels);
        ASSERT_EQ(said.size(), 1u) << voxels;
        EXPECT_NE(said[0].find(words + "; it needs 5 voxels"), std::string::npos) << said[0];
        EXPECT_TRUE(saidOfWall(voxels, false).empty());
    }
    EXPECT_TRUE(saidOfWall(5).empty());
}

TEST(ThinWalls, AreWarnedOfWithWhatWouldHoldThem) {
    Params params = unitVoxels({20, 20, 10}, {objectOf(box({2, 2, 4}, {18, 18, 6.5}), 1.5)});
    params.sharp = true;
    const Scene thin = make(params);
    const std::string first = thin.result.warnings.at(0);
    EXPECT_NE(first.find("'object1.5' has a wall of 2.5 units, 2.5 voxels"), std::string::npos);
    EXPECT_NE(first.find("--voxel-size 0.5 would"), std::string::npos);
    EXPECT_NEAR(thin.stats.counter("thinnest_wall_voxels"), 2.5, 1e-6);
    params.voxelSize = 0.5;
    EXPECT_TRUE(make(params).result.warnings.empty());
    params.bounds = {};
    params.voxelSize = {};
    params.resolution = 30; // voxels of 16 / 14 units; 16 / 0.5 are 32, or 33 by rounding's margin
    const std::string said = make(params).result.warnings.at(0);
    EXPECT_NE(said.find("--resolution 48 would"), std::string::npos) << said;
    params.resolution = 48;
    EXPECT_TRUE(make(params).result.warnings.empty());
    params.resolution = 47;
    EXPECT_FALSE(make(params).result.warnings.empty());
}

} // namespace
} // namespace eikonal::voxelize
