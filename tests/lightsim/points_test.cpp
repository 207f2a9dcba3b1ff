// Light for single points of opaque surfaces.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"
#include "support/lit.h"

#include <map>

namespace eikonal::lightsim {
namespace {

using glm::dvec3;
using glm::ivec3;

/// A ball of glass over a floor whose top is at y = 4.
volume::Volume ballOverFloor() {
    const judge::Glass glass{
        {judge::glassBall({20, 17, 20}, 8, 1.5), judge::glassBox(dvec3(-20), {60, 4, 60}, 1)}};
    sharp::Voxels voxels;
    voxels.size = {40, 28, 40};
    voxels.halfWidth = 4;
    volume::Volume volume = sharp::volumeOf(glass, voxels);
    volume.putConstant("opacity.S1", glm::vec3(1));
    return volume;
}

Params lit(const std::vector<Light>& lights) {
    Params params = paramsOf(lights, 1 << 14);
    params.maxDepth = 3;
    params.automaticOutputs = true;
    params.surfaceDetail = 2;
    return params;
}

/// A picture of that many points an edge, straight down on a square of the floor; what lies
/// outside the square's half is no point.
Points onFloor(const scene::Scene& scene, int edge, double low, double high) {
    const glm::dmat4 worldFromVoxel = glm::inverse(scene.voxelFromWorld());
    Points points;
    points.width = edge;
    for (int i = 0; i < edge * edge; ++i) {
        const double u = (i % edge + 0.5) / edge, v = (i / edge + 0.5) / edge;
        // Places are counted from the domain's low corner, half a voxel below its first middle.
        const dvec3 x(low + u * (high - low), 4, low + v * (high - low));
        points.places.emplace_back(worldFromVoxel * glm::dvec4(x - 0.5, 1));
        points.normals.emplace_back(u < 0.75 ? scene.worldFromVoxelTurn() * dvec3(0, 1, 0)
                                             : dvec3(0));
    }
    return points;
}

double rms(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(LightPoints, GetWhatTheirSurfaceGets) {
    const volume::Volume volume = ballOverFloor();
    for (const Method method : {Method::beams, Method::photons}) {
        Params params = lit({beam({-0.1, -1, 0.05}, dvec3(2, 1, 0.5))});
        params.method = method;
        const Lit grid(volume, params);
        params.points = onFloor(grid.plan.scene, 24, 8, 32);
        const Lit points(volume, params);
        ASSERT_EQ(points.result.points.size(), 1u);
        EXPECT_TRUE(points.result.irradiance.empty());
        EXPECT_LT(points.plan.surfaces.voxels.size(), grid.plan.surfaces.voxels.size());
        const auto& found = points.result.points[0];
        ASSERT_EQ(found.size(), 24u * 24u);
        // Each point is the middle of two by two fine voxels of the floor's top.
        std::vector<double> off, level;
        const volume::FineGrid& stored = grid.result.irradiance;
        std::map<std::pair<int, int>, dvec3> cells;
        for (size_t i = 0; i < stored.voxels.size(); ++i)
            if (stored.voxels[i].y == 8)
                cells[{stored.voxels[i].x / 2, stored.voxels[i].z / 2}] +=
                    0.25 * dvec3(stored.values[i]);
        for (int i = 0; i < 24 * 24; ++i) {
            const LightAtPoint& light = found[static_cast<size_t>(i)];
            if (i % 24 >= 18) {
                EXPECT_EQ(light.irradiance, glm::vec3(0));
                continue;
            }
            const dvec3 wanted = cells.at({8 + i % 24, 8 + i / 24});
            off.push_back(light.irradiance.x - wanted.x);
            level.push_back(wanted.x);
            EXPECT_NEAR(light.irradiance.y, 0.5 * light.irradiance.x, 1e-4 * wanted.x + 1e-5);
        }
        EXPECT_LT(rms(off), 0.01 * rms(level));
        EXPECT_GT(rms(level), 2);
    }
}

TEST(LightPoints, BeamsToOtherPlacesAreCulled) {
    const volume::Volume volume = ballOverFloor();
    Params params = lit({beam({-0.1, -1, 0.05})});
    const Lit all(volume, params);
    params.points = onFloor(all.plan.scene, 8, 1, 5); // a corner, far from the ball's shadow
    const Lit corner(volume, params);
    EXPECT_GT(corner.counter("beams_culled"), 0);
    EXPECT_EQ(all.counter("beams_culled"), 0);
    EXPECT_LT(corner.counter("beam_points"), 0.7 * all.counter("beam_points"));
    for (size_t i = 0; i < 64; ++i) {
        if (i % 8 >= 6) continue;
        // The sun's, and some that the ball mirrors there.
        EXPECT_NEAR(corner.result.points.at(0)[i].irradiance.x, 1 / std::sqrt(1.0125), 0.04);
    }
}

TEST(LightPoints, WhatIsMostlyShadowedNeedsNoSplit) {
    const volume::Volume volume = ballOverFloor();
    Params params = lit({beam({-0.1, -1, 0.05})});
    const auto power = [](const Lit& lit) {
        double sum = 0;
        for (const glm::vec3& e : lit.result.irradiance.values) sum += e.x;
        return sum;
    };
    const Lit exact(volume, params);
    params.shadowCull = 0.65;
    const Lit culled(volume, params);
    params.shadowCull = 1;
    params.beamLevels = 0;
    const Lit flat(volume, params);
    EXPECT_LT(culled.counter("beam_points"), exact.counter("beam_points"));
    EXPECT_LT(flat.counter("beam_points"), culled.counter("beam_points"));
    // No light is lost by it: what a cell's points stand for is laid down all the same. They are
    // the corners and middles of cells of 2.5 voxels.
    EXPECT_NEAR(power(culled), power(exact), 0.02 * power(exact));
}

TEST(LightPoints, FlowIsTheLightTimesWhereItTravels) {
    const volume::Volume volume = ballOverFloor();
    const dvec3 towards = glm::normalize(dvec3(-0.4, -1, 0.2));
    Params params = lit({beam(towards, dvec3(3, 3, 3))});
    params.points = onFloor(makePlan(volume, params).scene, 16, 1, 39);
    for (const Method method : {Method::beams, Method::photons}) {
        params.method = method;
        const Lit points(volume, params);
        dvec3 flow(0);
        double level = 0, most = 0;
        for (size_t i = 0; i < 16 * 16; ++i) {
            const LightAtPoint& light = points.result.points.at(0)[i];
            // No sum of vectors is longer than that of their lengths.
            EXPECT_LE(glm::length(light.flow), light.irradiance.x * 1.001);
            most = std::max(most, double{light.irradiance.x});
            if (i >= 3 * 16) continue; // the ball's shadow, and caustic
            flow += light.flow;
            level += light.irradiance.x;
        }
        EXPECT_LT(glm::distance(flow / level, towards), 0.02);
        EXPECT_GT(most, 3.5);
    }
}

TEST(LightPoints, OfLightsApartTheSumIsThatOfAll) {
    const volume::Volume volume = ballOverFloor();
    Params params = lit({beam({-0.1, -1, 0}, dvec3(1)), beam({0.3, -1, 0.3}, dvec3(0.2, 0.4, 2))});
    params.points = onFloor(Lit(volume, params).plan.scene, 12, 4, 36);
    const Lit together(volume, params);
    params.lightsApart = true;
    const Lit apart(volume, params);
    ASSERT_EQ(together.result.points.size(), 1u);
    ASSERT_EQ(apart.result.points.size(), 2u);
    double first = 0;
    for (size_t i = 0; i < together.result.points[0].size(); ++i) {
        const LightAtPoint& all = together.result.points[0][i];
        const glm::vec3 sum =
            apart.result.points[0][i].irradiance + apart.result.points[1][i].irradiance;
        const glm::vec3 flow = apart.result.points[0][i].flow + apart.result.points[1][i].flow;
        EXPECT_LT(glm::distance(sum, all.irradiance), 1e-3 * glm::length(sum) + 1e-5);
        EXPECT_LT(glm::distance(flow, all.flow), 1e-3 * glm::length(sum) + 1e-5);
        first = std::max(first, double{apart.result.points[0][i].irradiance.z});
    }
    EXPECT_GT(first, 0.9);
}

TEST(LightPoints, FinerPicturesAskForFinerVoxels) {
    const volume::Volume volume = ballOverFloor();
    Params params = lit({beam({0, -1, 0})});
    params.surfaceDetail = 0;
    const scene::Scene scene = makePlan(volume, params).scene;
    params.points = onFloor(scene, 16, 4, 36); // two voxels apart
    EXPECT_EQ(makePlan(volume, params).surfaces.detail, 1);
    params.points = onFloor(scene, 96, 4, 36); // a third
    EXPECT_EQ(makePlan(volume, params).surfaces.detail, 3);
}

TEST(LightPoints, WithoutAPointNothingIsSimulated) {
    const volume::Volume volume = ballOverFloor();
    Params params = lit({beam({0, -1, 0})});
    params.points.width = 2;
    params.points.places.assign(4, dvec3(0));
    params.points.normals.assign(4, glm::vec3(0));
    const Plan plan = makePlan(volume, params);
    EXPECT_EQ(plan.outputs, Output::none);
    EXPECT_FALSE(plan.beams);
}

} // namespace
} // namespace eikonal::lightsim
