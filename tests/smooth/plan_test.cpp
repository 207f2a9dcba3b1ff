// Which grids of a volume are smoothed, and what the volume keeps when they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "smooth/plan.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace eikonal;

namespace {

const volume::IndexBox kBox{{0, 0, 0}, {3, 3, 3}};

volume::DenseGrid grid(int components, bool varies) {
    volume::DenseGrid out;
    out.size = kBox.size();
    out.components = components;
    for (int i = 0; i < 64 * components; ++i)
        out.values.push_back(varies ? 0.5f + static_cast<float>(i) / 512 : 0.5f);
    return out;
}

/// ior, opacity and absorption vary, fog does not.
volume::Volume scene() {
    volume::Volume out(volume::Frame{});
    out.put("ior", kBox, grid(1, true), {.background = glm::vec3(1), .allActive = true});
    out.put("opacity", kBox, grid(1, true), {});
    out.put("absorption", kBox, grid(3, true), {});
    out.put("fog", kBox, grid(1, false), {});
    return out;
}

smooth::Params naming(const std::vector<std::string>& grids) {
    smooth::Params params;
    params.automaticGrids = false;
    params.grids = grids;
    return params;
}

} // namespace

TEST(SmoothPlan, TakesTheGridsThatBendOrBoundLight) {
    const smooth::Plan plan = smooth::makePlan(scene(), {});
    ASSERT_EQ(plan.items.size(), 2u);
    EXPECT_EQ(plan.items[0].grid, "ior");
    EXPECT_EQ(plan.items[0].background, glm::vec3(1));
    EXPECT_EQ(plan.items[1].grid, "opacity");
    EXPECT_EQ(plan.size, glm::ivec3(4));
    EXPECT_EQ(plan.weights.size(), 5u);
    ASSERT_EQ(plan.effects.size(), 2u);
    EXPECT_TRUE(plan.effects[0].on);
}

TEST(SmoothPlan, AnIndexInDoubleIsSmoothedByItsDifferences) {
    volume::Volume out(volume::Frame{});
    out.put("density", kBox, grid(1, true), {.allActive = true});
    volume::Law law;
    law.value = [](double density, int) { return 1.000277 + 1e-6 * density; };
    law.inDouble = true;
    out.derive("density", "ior", law);
    const smooth::Plan plan = smooth::makePlan(out, {});
    ASSERT_EQ(plan.items.size(), 1u);
    const smooth::Item& item = plan.items[0];
    ASSERT_TRUE(item.base);
    // Floats of differences below 1e-6 are that near; floats of the index would be 6e-8 off.
    for (size_t i = 0; i < 64; ++i)
        EXPECT_NEAR(*item.base + double{item.values.values[i]},
                    1.000277 + 1e-6 * (0.5 + static_cast<double>(i) / 512), 1e-13);
    EXPECT_NEAR(*item.base + double{item.background.x}, 1.000277, 1e-13);
    // Where floats hold it all, all is as it was.
    out.put("ior", kBox, grid(1, true), {.background = glm::vec3(1), .allActive = true});
    EXPECT_FALSE(smooth::makePlan(out, {}).items[0].base);
}

TEST(SmoothPlan, AVolumeWithoutThemHasNothingToSmooth) {
    volume::Volume out(volume::Frame{});
    out.put("density", kBox, grid(1, true), {});
    const smooth::Plan plan = smooth::makePlan(out, {});
    EXPECT_TRUE(plan.items.empty());
    EXPECT_FALSE(plan.effects.at(0).on);
    EXPECT_EQ(plan.effects.at(0).why, "no grid 'ior'");
}

TEST(SmoothPlan, TakesNamedGridsOnceAndInOrder) {
    const smooth::Plan plan =
        smooth::makePlan(scene(), naming({"absorption", "ior", "absorption"}));
    ASSERT_EQ(plan.items.size(), 2u);
    EXPECT_EQ(plan.items[0].grid, "absorption");
    EXPECT_EQ(plan.items[0].values.components, 3);
    EXPECT_EQ(plan.items[1].grid, "ior");
}

TEST(SmoothPlan, LeavesConstantGridsAndNarrowKernelsAlone) {
    const smooth::Plan constant = smooth::makePlan(scene(), naming({"fog"}));
    EXPECT_TRUE(constant.items.empty());
    EXPECT_EQ(constant.effects.at(0).why, "it has one value");
    smooth::Params params;
    params.sigma = 0;
    EXPECT_TRUE(smooth::makePlan(scene(), params).items.empty());
    params.sigma = 1.5;
    params.kernel = 1;
    EXPECT_TRUE(smooth::makePlan(scene(), params).items.empty());
}

TEST(SmoothPlan, AnUnknownGridIsNamedWithThoseThatAreThere) {
    smooth::Params params = naming({"smoke"});
    params.sigma = 0; // wrong all the same
    try {
        smooth::makePlan(scene(), params);
        FAIL() << "expected a DataError";
    } catch (const DataError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("no grid 'smoke' (found: absorption, fog, ior, opacity)"),
                  std::string::npos)
            << message;
    }
}
