// Smoothing in files with objects: nothing leaks across a boundary, and what moves one by how much.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/smooth.h"

#include "support/device.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace eikonal;
using glm::dvec3;
using glm::ivec3;

namespace {

using Function = std::function<double(dvec3)>;

/// A cube of voxels of edge 1 about voxel 0, `reach` voxels to either side.
struct Cube {
    int reach;

    volume::IndexBox box() const { return {ivec3(-reach), ivec3(reach)}; }

    volume::DenseGrid grid(const Function& value) const {
        volume::DenseGrid out;
        out.size = box().size();
        for (int z = -reach; z <= reach; ++z)
            for (int y = -reach; y <= reach; ++y)
                for (int x = -reach; x <= reach; ++x)
                    out.values.push_back(static_cast<float>(value(dvec3(x, y, z))));
        return out;
    }
    /// A volume whose domain is the cube.
    volume::Volume volume() const {
        volume::Volume out(volume::Frame{});
        out.put("domain", box(), grid([](const dvec3&) { return 1; }), {.allActive = true});
        return out;
    }
    float at(const volume::DenseGrid& grid, ivec3 p) const {
        p += reach;
        return grid.values[(static_cast<size_t>(p.z) * grid.size.y + p.y) * grid.size.x + p.x];
    }
};

constexpr double kBand = 6;

double ball(const dvec3& x, double radius) {
    return glm::length(x) - radius;
}

smooth::Params naming(const std::vector<std::string>& grids) {
    smooth::Params params;
    params.automaticGrids = false;
    params.grids = grids;
    return params;
}

std::vector<smooth::Item> smoothed(const volume::Volume& volume, const smooth::Params& params) {
    Stats stats;
    return smooth::run(device(), smooth::makePlan(volume, params), stats, {});
}

std::vector<std::string> names(const std::vector<smooth::Item>& items) {
    std::vector<std::string> out;
    for (const smooth::Item& item : items) out.push_back(item.grid);
    return out;
}

/// Where values along +x from the centre pass zero [voxel].
double zeroAlong(const Cube& cube, const volume::DenseGrid& grid, const ivec3& step) {
    for (int k = 0; k < cube.reach; ++k) {
        const double a = cube.at(grid, k * step), b = cube.at(grid, (k + 1) * step);
        if (a < 0 && b >= 0) return (k + a / (a - b)) * glm::length(dvec3(step));
    }
    return -1;
}

} // namespace

TEST(SmoothSides, AnObjectsValuesKnowNothingOfWhatIsBeyond) {
    // A ramp that is valid to 4 voxels beyond a ball of 10; from there on it is nonsense.
    const Cube cube{20};
    const auto ramp = [](const dvec3& x) { return 1.5 + 0.01 * x.x; };
    volume::Volume volume = cube.volume();
    volume.putLevelSet({"glass", "sdf", 0, 0}, cube.box(),
                       cube.grid([](const dvec3& x) { return ball(x, 10); }), kBand);
    volume.put("ior.glass", cube.box(),
               cube.grid([&](const dvec3& x) { return ball(x, 10) < 4 ? ramp(x) : 500; }),
               {.background = glm::vec3(1)});
    volume.put("ior", cube.box(),
               cube.grid([](const dvec3& x) { return ball(x, 10) < 0 ? 1.5 : 1.0; }),
               {.background = glm::vec3(1), .allActive = true});
    const auto items = smoothed(volume, {});
    ASSERT_EQ(names(items), (std::vector<std::string>{"ior", "ior.glass"}));
    const volume::DenseGrid& own = items[1].values;
    for (int x = -20; x <= 20; ++x) {
        const double found = cube.at(own, {x, 0, 0});
        if (std::abs(x) >= 14)
            EXPECT_EQ(found, 500) << x; // not looked at, not changed
        else if (std::abs(x) <= 9)
            // Nine taps reach 4 voxels: along the axis all count. Of those aside the outermost lie
            // beyond; they carry less than 1/200 of the weight and are out by 0.01 a voxel.
            EXPECT_NEAR(found, ramp(dvec3(x, 0, 0)), 1e-4) << x;
        else
            // One-sided means move a ramp by at most the kernel's mean reach of 1.1 voxels.
            EXPECT_NEAR(found, ramp(dvec3(x, 0, 0)), 0.011) << x;
    }
    // The mixed index is smoothed across the boundary as ever.
    EXPECT_NEAR(cube.at(items[0].values, {10, 0, 0}), 1.23, 0.05);
}

TEST(SmoothSides, ConstantsCostNothingAndStay) {
    const Cube cube{14};
    volume::Volume volume = cube.volume();
    volume.putLevelSet({"glass", "sdf", 0, 0}, cube.box(),
                       cube.grid([](const dvec3& x) { return ball(x, 6); }), kBand);
    volume.putConstant("ior.glass", glm::vec3(1.5f));
    const smooth::Plan plan = smooth::makePlan(volume, {});
    EXPECT_TRUE(plan.items.empty());
    ASSERT_EQ(plan.effects.size(), 3u); // ior and opacity are not there
    EXPECT_EQ(plan.effects[2].name, "ior.glass");
    EXPECT_EQ(plan.effects[2].why, "it has one value");
    // Of one value where it counts: to the last bit, whatever is around.
    volume.put("ior.glass", cube.box(),
               cube.grid([](const dvec3& x) { return ball(x, 6) < 4 ? 1.3333334 : 7; }),
               {.background = glm::vec3(1)});
    const auto items = smoothed(volume, {});
    ASSERT_EQ(items.size(), 1u);
    for (const float value : items[0].values.values)
        EXPECT_TRUE(value == 1.3333334f || value == 7) << value;
}

TEST(SmoothSides, WithoutIorOfItsOwnTheFilesIndexIsTheObjects) {
    const Cube cube{16};
    volume::Volume volume = cube.volume();
    volume.putLevelSet({"", "sdf", 0, 0}, cube.box(),
                       cube.grid([](const dvec3& x) { return ball(x, 8); }), kBand);
    volume.put("ior", cube.box(), cube.grid([](const dvec3& x) {
        return ball(x, 8) < 4 ? 1.5 + 0.001 * x.y * x.y : 1;
    }),
               {.background = glm::vec3(1), .allActive = true});
    const auto items = smoothed(volume, {});
    ASSERT_EQ(names(items), (std::vector<std::string>{"ior"}));
    for (int x = -11; x <= 11; ++x) EXPECT_GT(cube.at(items[0].values, {x, 0, 0}), 1.49) << x;
    EXPECT_EQ(cube.at(items[0].values, {13, 0, 0}), 1);
}

TEST(SmoothSides, TheMediumCountsOutsideAllObjects) {
    const Cube cube{16};
    volume::Volume volume = cube.volume();
    const dvec3 aside(5, 0, 0);
    volume.putLevelSet({"a", "sdf.a", 0, 0}, cube.box(),
                       cube.grid([&](const dvec3& x) { return ball(x - aside, 7); }), kBand);
    volume.putLevelSet({"b", "sdf.b", 0, 1}, cube.box(),
                       cube.grid([&](const dvec3& x) { return ball(x + aside, 7); }), kBand);
    volume.putConstant("ior.a", glm::vec3(1.5f));
    volume.putConstant("ior.b", glm::vec3(1.4f));
    volume.put("ior.medium", cube.box(), cube.grid([&](const dvec3& x) {
        const double distance = std::min(ball(x - aside, 7), ball(x + aside, 7));
        return distance > -4 ? 1 + 0.001 * (x.y + 16) : 90;
    }),
               {.background = glm::vec3(1)});
    const auto items = smoothed(volume, {});
    ASSERT_EQ(names(items), (std::vector<std::string>{"ior.medium"}));
    for (const float value : items[0].values.values) EXPECT_TRUE(value < 1.04 || value == 90);
    EXPECT_EQ(cube.at(items[0].values, {5, 0, 0}), 90);
}

TEST(SmoothSides, DistancesLoseWhatTheirCurvatureSays) {
    // A Gaussian adds half its variance times the Laplacian, 2/R: a ball of radius R loses
    // sigma²/R. Sigma 1.5 in nine taps has a variance of 2.19; of the next order, sigma⁴/R³, is
    // what is left, and the zero is found by a line between voxels, off by less than 1/(8 R).
    for (const double radius : {10.0, 28.0}) {
        const Cube cube{static_cast<int>(radius) + 8};
        volume::Volume volume = cube.volume();
        volume.putLevelSet({"glass", "sdf", 0, 0}, cube.box(),
                           cube.grid([&](const dvec3& x) { return ball(x, radius); }), kBand);
        const auto items = smoothed(volume, naming({"sdf"}));
        ASSERT_EQ(items.size(), 1u);
        const double loss = radius - zeroAlong(cube, items[0].values, {1, 0, 0});
        EXPECT_NEAR(loss, 2.19 / radius, 0.05 * 2.19 / radius) << radius;
    }
}

TEST(SmoothSides, DistancesRoundAnEdge) {
    // The edges of a block of 10 voxels half-edge. Amid its faces nothing moves; on the diagonals
    // the zero recedes in proportion to sigma, which is the only length there is. How far is
    // measured, not derived; docs/design.md quotes it.
    const Cube cube{18};
    const auto block = [](const dvec3& x) {
        const dvec3 q = glm::abs(x) - 10.0;
        return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
    };
    volume::Volume volume = cube.volume();
    volume.putLevelSet({"glass", "sdf", 0, 0}, cube.box(), cube.grid(block), kBand);
    const auto items = smoothed(volume, naming({"sdf"}));
    ASSERT_EQ(items.size(), 1u);
    EXPECT_NEAR(zeroAlong(cube, items[0].values, {1, 0, 0}), 10, 1e-5);
    const double receded = 10 * std::sqrt(2.0) - zeroAlong(cube, items[0].values, {1, 1, 0});
    const double corner = 10 * std::sqrt(3.0) - zeroAlong(cube, items[0].values, {1, 1, 1});
    EXPECT_NEAR(receded, 0.8 * 1.5, 0.05);
    EXPECT_NEAR(corner, 1.4 * 1.5, 0.1);
}

TEST(SmoothSides, ALevelSetKeepsItsBandAndItsSigns) {
    const Cube cube{20};
    volume::Volume volume = cube.volume();
    volume.putLevelSet({"glass", "sdf", 2, 1}, cube.box(),
                       cube.grid([](const dvec3& x) { return ball(x, 9); }), kBand);
    const auto items = smoothed(volume, naming({"sdf"}));
    ASSERT_EQ(items.size(), 1u);
    EXPECT_EQ(items[0].halfWidth, kBand);
    volume.putLevelSet(*items[0].object, cube.box(), items[0].values, items[0].halfWidth);
    EXPECT_EQ(volume.objects().at(0).name, "glass");
    EXPECT_EQ(volume.objects().at(0).priority, 2);
    const volume::DenseGrid after = volume.dense("sdf", cube.box());
    for (int x = -20; x <= 20; ++x) {
        const double before = glm::clamp(std::abs(x) - 9.0, -kBand, kBand);
        if (std::abs(before) == kBand)
            EXPECT_EQ(cube.at(after, {x, 0, 0}), before) << x;
        else
            EXPECT_NEAR(cube.at(after, {x, 0, 0}), before, 0.8) << x; // bent towards the band's end
    }
}
