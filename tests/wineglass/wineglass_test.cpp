// Parts of the wine glass, at the voxels of 1024 over its height: rays through its wall, and
// through its stem and foot, where they are totally reflected, against those through the exact
// surface. SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "image/exr.h"
#include "support/scratch.h"
#include "support/tool.h"
#include "wineglass/compare.h"

using namespace eikonal;
using namespace wineglass;

namespace {

constexpr double kVoxel = 120.0 / 1008; // [mm]

std::string textOf(const dvec3& x) {
    return toText(x.x) + "," + toText(x.y) + "," + toText(x.z);
}

class WineGlass : public ScratchTest {
protected:
    void SetUp() override {
        ScratchTest::SetUp();
        const std::string parts = EIKONAL_SOURCE_DIR "/pipelines/wineglass/";
        command("awk -f " + parts + "profile.awk && cp stdout.txt profile.txt");
        command("awk -v around=256 -f " + parts +
                "mesh.awk profile.txt && mv stdout.txt glass.obj");
        std::ifstream in(at("profile.txt"));
        setting.glass = judge::readProfile(in);
        setting.voxel = kVoxel;
    }

    void command(const std::string& line) const {
        const Ran ran = run("{ " + line + "; }", folder);
        ASSERT_EQ(ran.status, 0) << line << "\n" << ran.said;
    }

    /// A parallel view of what lies between two corners, so high.
    std::array<Errors, 4> errorsOf(const dvec3& low, const dvec3& high, const dvec3& eye,
                                   const dvec3& target, double height) {
        setting.low = low, setting.high = high;
        setting.camera = {eye, target, {0, 1, 0}, true, 0, height, 160, 120};
        command("mesh2vol glass.obj -o part.vdb --ior 1.5 --voxel-size " + toText(kVoxel) +
                " --bounds=" + textOf(low) + "," + textOf(high));
        command("render part.vdb -o part.exr --eye=" + textOf(eye) + " --target=" + textOf(target) +
                " --ortho " + toText(height) +
                " --size 160x120 --background 1,1,1 --aov exit_position,exit_direction");
        return compare(setting, image::readExr(at("part.exr")));
    }

    static const Errors& of(const std::array<Errors, 4>& all, Course course) {
        return all[static_cast<size_t>(course)];
    }

    Setting setting;
};

/// Most of what is wrong is where an arc goes over into a line: the curvature jumps there, which a
/// spline smooths over three voxels. So the bars are for most rays and for all.
void expectClose(const Errors& errors, double degrees) {
    EXPECT_LT(quantile(errors.degrees, 0.9), degrees);
    EXPECT_LT(quantile(errors.degrees, 0.99), 0.03);
    EXPECT_LT(quantile(errors.degrees, 1), 0.15);
    EXPECT_LT(quantile(errors.apart, 0.9), 0.01); // [voxel]: a thousandth of the wall
    EXPECT_LT(quantile(errors.apart, 1), 0.15);
    EXPECT_GT(errors.close, 0.98 * errors.rays);
}

} // namespace

TEST_F(WineGlass, ItsWallSetsRaysAsideAsItShould) {
    const auto all = errorsOf({18, 70, -12}, {40, 100, 12}, {90, 100, 40}, {33, 86, 0}, 22);
    const Errors& wall = of(all, Course::wall);
    EXPECT_GT(wall.rays, 10000);
    EXPECT_EQ(wall.leftOut, 0);
    EXPECT_GT(wall.set, 0.5); // [mm]: a wall does set rays aside
    expectClose(wall, 1e-3);
}

TEST_F(WineGlass, ItsFootReflectsTotally) {
    const auto all = errorsOf({-26, -1, -16}, {14, 18, 12}, {62, 14, 8}, {8, 8, 0}, 6);
    const Errors& total = of(all, Course::total);
    EXPECT_GT(total.rays, 5000);
    EXPECT_GE(total.reflections, 3);
    expectClose(total, 1e-2);
}

TEST_F(WineGlass, TheBowlsEndAboveTheStemReflectsTotally) {
    const auto all = errorsOf({-11, 40, -11}, {11, 60, 11}, {50, 60, 22}, {0, 50, 0}, 16);
    const Errors& thick = of(all, Course::thick);
    EXPECT_GT(thick.rays, 2500);
    expectClose(thick, 1e-2);
    const Errors& total = of(all, Course::total);
    EXPECT_GT(total.rays, 1500);
    EXPECT_GE(total.reflections, 5);
    expectClose(total, 1e-2);
}
