// What an absent effect costs, as far as no clock is needed: nothing in memory, pixels,
// instructions. SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace effects;
using namespace eikonal;

namespace {

constexpr Scale kSmall{16, 48, 36, 1 << 10};

class Effects : public testing::Test {
protected:
    void SetUp() override { watchPrograms(); }
    void TearDown() override { std::filesystem::remove_all(mWork); }

    /// Full text and text without the effects: the same result to the last bit, and as many
    /// instructions but for 1 % (where the tools that count are
    /// installed).
    void expectFree(gpu::Device& device, const Case& scene, const std::vector<Cut>& cuts,
                    const std::string& name) {
        SCOPED_TRACE(scene.kernel + " without " + name);
        const Outcome full = scene.run(device);
        const Variant before = lastVariant(scene.kernel);
        ASSERT_NO_THROW(writeWithout(cuts, mWork + "/without"));
        const ShaderFolder use(mWork + "/without");
        const Outcome less = scene.run(device);
        const Variant after = lastVariant(scene.kernel);
        EXPECT_NE(before.text, after.text) << "the folder was not read";
        EXPECT_EQ(before.switches, after.switches);
        ASSERT_EQ(full.result.size(), less.result.size());
        const size_t bytes = full.result.size() * sizeof(float);
        EXPECT_EQ(std::memcmp(full.result.data(), less.result.data(), bytes), 0);
        const std::optional<Instructions> more = instructionsOf(before.text, mWork);
        const std::optional<Instructions> fewer = instructionsOf(after.text, mWork);
        if (!more || !fewer) return;
        EXPECT_LE(static_cast<double>(more->size()), 1.01 * static_cast<double>(fewer->size()));
    }

    void expectAllFree(const Case& scene, const std::vector<Cut>& cuts) {
        gpu::Device device({gpu::DeviceChoice::Kind::software});
        for (const Cut& one : cuts) expectFree(device, scene, {one}, one.effect);
        if (cuts.size() > 1) expectFree(device, scene, cuts, "all of them");
    }

    const std::string mWork =
        std::filesystem::temp_directory_path() / ("eikonal_effects_" + std::to_string(::getpid()));
};

void expectMisfit(const Cut& cut, const std::string& said) {
    try {
        effects::cut("const bool kA = A == 1;\nvoid main() { if (kA) x = 1; x = 2; x = 2; }\n",
                     {cut});
        ADD_FAILURE() << "a cut that does not fit was made: " << said;
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
}

} // namespace

TEST_F(Effects, AbsentFromTheViewKernelTheyCostNothing) {
    expectAllFree(viewCases(kSmall)[0], viewCuts());
    expectAllFree(straightViewCase(kSmall), straightViewCuts());
}

TEST_F(Effects, AbsentFromTheSharpKernelTheyCostNothing) {
    expectAllFree(sharpCases(kSmall)[0], sharpCuts());
    expectAllFree(curvedSharpCase(kSmall), curvedSharpCuts());
}

TEST_F(Effects, AbsentFromThePhotonKernelTheyCostNothing) {
    expectAllFree(photonCases(kSmall)[0], photonCuts());
    expectAllFree(straightPhotonCase(kSmall), straightPhotonCuts());
}

// Sharp boundaries have a kernel of their own: in the other nothing is left of them to cut.
TEST_F(Effects, BlurredBoundariesKnowNothingOfSharpOnes) {
    const std::string text = gpu::loadShader(kViewKernel, {}).text;
    for (const char* name : {"SurfaceParams", "distances", "clearance", "partAt", "SOLIDS"})
        EXPECT_EQ(text.find(name), text.npos) << name;
}

// A grid that is 0 all over asks for nothing: the same switches, not a byte more.
TEST_F(Effects, AbsentTheyTakeNoMemory) {
    for (const auto& scene :
         {viewCases(kSmall)[0], sharpCases(kSmall)[0], photonCases(kSmall)[0]}) {
        const std::uint64_t bytes = peakBytesOf(scene);
        const gpu::Switches switches = lastVariant(scene.kernel).switches;
        EXPECT_EQ(peakBytesOf(emptyGridsCase(kSmall, scene.kernel)), bytes) << scene.kernel;
        EXPECT_EQ(lastVariant(scene.kernel).switches, switches) << scene.kernel;
    }
}

// Each scene's kernel differs from that of refraction alone by the switches of its one effect; an
// environment map and AOVs' names are no switches of their own.
TEST_F(Effects, EveryRowHasItsOwnVariant) {
    gpu::Device device({gpu::DeviceChoice::Kind::software});
    for (const auto& cases : {viewCases(kSmall), sharpCases(kSmall), photonCases(kSmall)}) {
        std::vector<gpu::Switches> seen;
        for (const Case& one : cases) {
            one.run(device);
            const gpu::Switches& switches = lastVariant(one.kernel).switches;
            const bool isNew = std::count(seen.begin(), seen.end(), switches) == 0;
            EXPECT_TRUE(isNew || one.name == "environment map") << one.name;
            seen.push_back(switches);
        }
    }
}

// The list of cuts can't outlive the text it was made for.
TEST_F(Effects, ACutThatDoesNotFitIsAnError) {
    expectMisfit({"a", "k", {{"kB", false}}}, "'kB' is no condition");
    expectMisfit({"a", "k", {}, {"A == 1"}}, "is no condition of #if");
    expectMisfit({"a", "k", {}, {}, {"y"}}, "'y' is nowhere written");
    expectMisfit({"a", "k", {}, {}, {}, {{"x = 3;", ""}}}, "'x = 3;' is not there");
    expectMisfit({"a", "k", {}, {}, {}, {{"x = 2;", ""}}}, "'x = 2;' is there twice");
    expectMisfit({"a", "k", {}, {}, {}, {}, {"kB"}}, "'kB' is no identifier");
    expectMisfit({"a", "k", {}, {}, {}, {}, {"kA"}}, "'kA' is left");
}

TEST_F(Effects, WhatHangsOnAConditionGoesWithIt) {
    const auto without = [](const std::string& body) {
        const std::string text =
            cut("const bool kA = A == 1;\nint f() { return 3; }\nvoid main() {" + body + "}\n",
                {{"a", "k", {{"kA", false}}}});
        return text.substr(text.find("main() {") + 8);
    };
    EXPECT_EQ(without("if (kA) x = 1; else x = 2;"), "x = 2;}\n");
    EXPECT_EQ(without("if (b) x = 1; else if (kA) x = f();"), "if (b) x = 1;}\n");
    EXPECT_EQ(without("if (kA || b && c) x = 1;"), "if (b && c) x = 1;}\n");
    EXPECT_EQ(without("if (b || kA && c(1, 2)) x = 1;"), "if (b) x = 1;}\n");
    EXPECT_EQ(without("if (!kA && b) x = 1;"), "if (b) x = 1;}\n");
    EXPECT_EQ(without("x = b ? 1 : kA ? f() : c ? 2 : 3;"), "x = b ? 1 : c ? 2 : 3;}\n");
    EXPECT_EQ(without("int y = 3; if (kA) x = y; while (b) { if (kA) { x = 1; } }"),
              " while (b) { }}\n");
    EXPECT_EQ(without("if (!kA) { return; } x = 1;"), "{ return; } x = 1;}\n");
}
