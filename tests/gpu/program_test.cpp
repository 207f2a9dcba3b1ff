// Shaders: includes, switches, errors that name the right line, and that they run.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"
#include "gpu/resources.h"
#include "support/device.h"
#include "support/scratch.h"

#include <cstdlib>

using namespace eikonal;
using namespace eikonal::gpu;

namespace {

/// Shaders come from the test's own folder, then from those built in.
class ProgramTest : public ScratchTest {
protected:
    void SetUp() override {
        ScratchTest::SetUp();
        ::setenv("EIKONAL_SHADERS", folder.c_str(), 1);
    }
    void TearDown() override {
        ::unsetenv("EIKONAL_SHADERS");
        ScratchTest::TearDown();
    }
};

const std::string kMain = "layout(local_size_x = 4, local_size_y = 2) in;\n"
                          "layout(std430, binding = 0) buffer Out { uint values[]; };\n"
                          "void main() {\n"
                          "    uvec3 p = gl_GlobalInvocationID;\n";

} // namespace

TEST_F(ProgramTest, IncludesAreExpandedOnceAndRememberTheirLines) {
    putBytes("t/main.comp.glsl", "#include \"t/a.glsl\"\n#include \"t/b.glsl\"\nint last;\n");
    putBytes("t/a.glsl", "int a;\n#include \"t/b.glsl\"\nint a2;\n");
    putBytes("t/b.glsl", "// b\nint b;\n#include \"t/b.glsl\"\n"); // itself: once all the same
    const ShaderText text = loadShader("t/main.comp.glsl", {{"SIZE", 3}, {"ON", 0}});
    EXPECT_EQ(text.text, "#version 450 core\n#define SIZE 3\n#define ON 0\n"
                         "int a;\n// b\nint b;\nint a2;\nint last;\n");
    ASSERT_EQ(text.lines.size(), 8u);
    EXPECT_EQ(text.lines[5].file, "t/b.glsl");
    EXPECT_EQ(text.lines[5].line, 2);
    EXPECT_EQ(text.lines[6].file, "t/a.glsl");
    EXPECT_EQ(text.lines[6].line, 3);
    EXPECT_EQ(text.lines[7].file, "t/main.comp.glsl");
    EXPECT_EQ(text.lines[7].line, 3);
}

TEST_F(ProgramTest, BuiltInShadersAreFoundBehindTheFolder) {
    putBytes("t/main.comp.glsl", "#include \"lib/random.glsl\"\n");
    EXPECT_NE(loadShader("t/main.comp.glsl", {}).text.find("pcgHash"), std::string::npos);
    putBytes("lib/random.glsl", "int mine;\n");
    EXPECT_NE(loadShader("t/main.comp.glsl", {}).text.find("int mine;"), std::string::npos);
}

TEST_F(ProgramTest, AMissingIncludeIsNamedWithItsPlace) {
    expectError(ExitStatus::internal, {"t/none.comp.glsl"},
                [] { loadShader("t/none.comp.glsl", {}); });
    putBytes("t/main.comp.glsl", "int a;\n#include \"t/none.glsl\"\n");
    expectError(ExitStatus::internal, {"t/main.comp.glsl:2", "'t/none.glsl'"},
                [] { loadShader("t/main.comp.glsl", {}); });
    putBytes("t/main.comp.glsl", "\n\n#include <t/a.glsl>\n");
    expectError(ExitStatus::internal, {"t/main.comp.glsl:3", "#include"},
                [] { loadShader("t/main.comp.glsl", {}); });
}

TEST_F(ProgramTest, ACompilersLogIsToldInFilesAndLines) {
    putBytes("t/main.comp.glsl", "#include \"t/a.glsl\"\nint last;\n");
    putBytes("t/a.glsl", "int a;\n");
    const ShaderText text = loadShader("t/main.comp.glsl", {});
    EXPECT_EQ(explainLog("0:2(5): error: x", text), "t/a.glsl:1: error: x");         // Mesa
    EXPECT_EQ(explainLog("0(3) : error C1", text), "t/main.comp.glsl:2 : error C1"); // NVIDIA
    EXPECT_EQ(explainLog("ERROR: 0:3: 'x'", text), "ERROR: t/main.comp.glsl:2 'x'");
    EXPECT_EQ(explainLog("0:77(5): beyond", text), "0:77(5): beyond");
    EXPECT_EQ(explainLog("10:2 of 30(4)", text), "10:2 of 30(4)"); // no place
}

TEST_F(ProgramTest, AnErrorInsideAnIncludeNamesThatLine) {
    putBytes("t/main.comp.glsl", "#include \"t/broken.glsl\"\n" + kMain + "}\n");
    putBytes("t/broken.glsl", "// fine\nfloat half_of(float x) {\n    return 0.5 * y;\n}\n");
    const auto compile = [] {
        const Program program(eikonal::device(), "t/main.comp.glsl", {{"A", 1}, {"B", 2}});
    };
    expectError(ExitStatus::internal, {"t/main.comp.glsl", "t/broken.glsl:3", "y"}, compile, false);
}

TEST_F(ProgramTest, AProgramThatDoesNotLinkIsAnInternalError) {
    putBytes("t/main.comp.glsl", "uint missing();\n" + kMain + "    values[p.x] = missing();\n}\n");
    const auto link = [] { const Program program(eikonal::device(), "t/main.comp.glsl", {}); };
    expectError(ExitStatus::internal, {"t/main.comp.glsl", "link", "missing"}, link, false);
}

TEST_F(ProgramTest, RunsOverEveryItemWithItsSwitches) {
    putBytes("t/main.comp.glsl",
             kMain +
                 "    if (p.x < 5u && p.y < 3u && p.z < 2u)\n"
                 "        values[(p.z * 3u + p.y) * 5u + p.x] = uint(FACTOR) * (p.x + 10u * p.y "
                 "+ 100u * p.z);\n}\n");
    Buffer values(eikonal::device(), 30 * 4);
    values.clear();
    const Program program(eikonal::device(), "t/main.comp.glsl", {{"FACTOR", 7}});
    values.bindStorage(0);
    program.dispatch({5, 3, 2}); // no multiples of the group's 4 × 2
    program.dispatch({0, 3, 2}); // none at all
    barrier();
    std::vector<std::uint32_t> out(30);
    values.download(out.data(), 30 * 4);
    eikonal::device().check("the test");
    for (std::uint32_t i = 0; i < 30; ++i)
        EXPECT_EQ(out[i], 7 * (i % 5 + 10 * (i / 5 % 3) + 100 * (i / 15))) << i;
}

TEST_F(ProgramTest, TheProfilerFillsTheStats) {
    putBytes("t/main.comp.glsl", kMain + "    uint v = p.x;\n"
                                         "    for (int i = 0; i < 1000; ++i) v = v * 3u + 1u;\n"
                                         "    values[p.x] = v;\n}\n");
    const Program program(eikonal::device(), "t/main.comp.glsl", {});
    const Buffer values(eikonal::device(), 1 << 18);
    values.bindStorage(0);
    Stats stats;
    {
        Profiler profiler(stats);
        for (const char* pass : {"one", "two", "one"}) {
            profiler.begin(pass);
            program.dispatch({1 << 16, 1, 1});
            profiler.end();
        }
        profiler.collect();
    }
    ASSERT_EQ(stats.passes.size(), 2u); // of one name added up
    EXPECT_EQ(stats.passes[0].name, "one");
    EXPECT_EQ(stats.passes[1].name, "two");
    for (const PassTime& pass : stats.passes) {
        EXPECT_GT(pass.gpuMs, 0);
        EXPECT_GT(pass.cpuMs, 0);
        EXPECT_LT(pass.gpuMs, 60000); // a difference of times, not a time
    }
}
