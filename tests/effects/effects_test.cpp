// What an absent effect costs, as far as no clock is needed: nothing in memory, no binding, and as
// many instructions as ever. SPDX-License-Identifier: GPL-3.0-or-later
#include "counts.h"
#include "effects.h"
#include "support/scratch.h"

#include <algorithm>

using namespace effects;
using namespace eikonal;

// For GoogleTest's messages.
namespace effects {
static void PrintTo(Family family, std::ostream* out) {
    *out << nameOf(family);
}
} // namespace effects

namespace {

/// A case's kernel; it is the same in every test.
struct Seen {
    Case scene;
    Variant variant;
};

const std::vector<Seen>& seenOf(Family family) {
    static std::map<Family, std::vector<Seen>> known;
    std::vector<Seen>& seen = known[family];
    if (!seen.empty()) return seen;
    gpu::Device device({gpu::DeviceChoice::Kind::software});
    for (const Case& one : casesAndStraight(family, kSmall))
        seen.push_back({one, run(one, device).variant});
    return seen;
}

class Effects : public ScratchTest, public testing::WithParamInterface<Family> {
protected:
    /// None where the tools that make it are not installed.
    std::optional<Module> moduleOf(const Seen& seen) const {
        return effects::moduleOf(seen.variant, folder.string());
    }
    static std::string lineOf(const Seen& seen) {
        return nameOf(GetParam()) + ": " + seen.scene.name;
    }
};

bool contains(const std::vector<std::string>& effects, const std::string& effect) {
    return std::count(effects.begin(), effects.end(), effect) > 0;
}

} // namespace

// What a kernel reads and writes is what all of its family need, and what its scene's effects do:
// of an absent effect nothing is bound, of a present one all.
TEST_P(Effects, BindWhatTheyNeedAndAbsentNothing) {
    for (const Seen& seen : seenOf(GetParam())) {
        Bindings wanted;
        for (const Owned& owned : bindingsOf(GetParam()))
            if (owned.effect.empty() || contains(seen.scene.effects, owned.effect))
                wanted.insert(owned.bindings.begin(), owned.bindings.end());
        const std::optional<Module> module = moduleOf(seen);
        if (!module) GTEST_SKIP() << "glslang or SPIRV-Tools are not installed";
        EXPECT_EQ(textOf(module->bindings), textOf(wanted)) << seen.scene.name;
    }
}

// So that the test before this one can fail: of every effect there is a scene with and one without.
TEST_P(Effects, AreEachThereOnceAndAbsentOnce) {
    const std::vector<Owned> all = bindingsOf(GetParam());
    for (const Owned& owned : all) {
        if (owned.effect.empty()) continue;
        const auto has = [&](const Seen& seen) {
            return contains(seen.scene.effects, owned.effect);
        };
        const auto with = std::count_if(seenOf(GetParam()).begin(), seenOf(GetParam()).end(), has);
        EXPECT_GT(with, 0) << owned.effect;
        EXPECT_LT(static_cast<size_t>(with), seenOf(GetParam()).size()) << owned.effect;
    }
    for (const Seen& seen : seenOf(GetParam()))
        for (const std::string& effect : seen.scene.effects)
            EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Owned& owned) {
                return owned.effect == effect;
            })) << effect;
}

// 1 % is what a compiler's mood may make; more is a change, to be looked at and written down.
TEST_P(Effects, HaveAsManyInstructionsAsWrittenDown) {
    const Counts counts = readCounts(EIKONAL_SOURCE_DIR "/tests/effects/instructions.txt");
    if (compilerName() != counts.compiler)
        GTEST_SKIP() << "counted by " << counts.compiler << ", here is " << compilerName();
    std::set<std::string> lines;
    for (const Seen& seen : seenOf(GetParam())) {
        const std::string line = lineOf(seen);
        lines.insert(line);
        const double wanted = counts.of(line);
        EXPECT_NEAR(moduleOf(seen)->instructions, wanted, 0.01 * wanted)
            << line << ": if that is as it should be, make instructions";
    }
    for (const auto& [line, count] : counts.instructions) {
        const bool isOurs = line.rfind(nameOf(GetParam()) + ": ", 0) == 0;
        EXPECT_TRUE(!isOurs || lines.count(line)) << line << " is no case: make instructions";
    }
}

// A grid that is 0 all over asks for nothing: the same switches, not a byte more.
TEST_P(Effects, AbsentTakeNoMemory) {
    const Case empty = emptyGridsCase(GetParam(), kSmall);
    gpu::Switches switches;
    {
        gpu::Device device({gpu::DeviceChoice::Kind::software});
        switches = run(empty, device).variant.switches;
    }
    EXPECT_EQ(switches, seenOf(GetParam())[0].variant.switches);
    EXPECT_EQ(peakBytesOf(empty), peakBytesOf(seenOf(GetParam())[0].scene));
}

// Each scene's kernel differs from that of refraction alone by the switches of its one effect; an
// environment map and AOVs' names are no switches of their own.
TEST_P(Effects, EveryRowHasItsOwnVariant) {
    std::vector<gpu::Switches> known;
    for (const Seen& seen : seenOf(GetParam())) {
        const bool isNew = std::count(known.begin(), known.end(), seen.variant.switches) == 0;
        EXPECT_TRUE(isNew || seen.scene.name == "environment map") << seen.scene.name;
        known.push_back(seen.variant.switches);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Effects, testing::ValuesIn(kFamilies), [](const auto& family) {
    std::string name = nameOf(family.param);
    name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return !std::isalpha(c); }),
               name.end());
    return name;
});
