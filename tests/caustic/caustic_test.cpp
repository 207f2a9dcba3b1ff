// The tools' picture of a ball over a floor against the exact one, and what counts as their
// difference. SPDX-License-Identifier: GPL-3.0-or-later
#include "caustic/compare.h"
#include "image/exr.h"
#include "support/scratch.h"
#include "support/tool.h"

#include <stdexcept>

using namespace eikonal;
using namespace caustic;

namespace {

class Caustic : public ScratchTest {
protected:
    void command(const std::string& line) const {
        const Ran ran = run("{ " + line + "; }", folder);
        ASSERT_EQ(ran.status, 0) << line << "\n" << ran.said;
    }
};

} // namespace

TEST(CausticErrors, AreTheFormulas) {
    judge::View view;
    view.width = 4, view.rows = 1;
    const judge::Picture exact{
        {1, 3, 0, 9},
        {judge::Meets::floor, judge::Meets::floor, judge::Meets::floor, judge::Meets::through}};
    const image::Image wanted = imageOf(exact, view, 2);
    judge::Picture other = exact;
    other.radiance = {1.5, 3, 0.1, 5};
    const Errors errors = errorsOf(imageOf(other, view, 2), wanted, judge::Meets::floor);
    EXPECT_EQ(errors.pixels, 3);
    const double tenth = 0.1 * 4 / 3;
    EXPECT_NEAR(errors.error, std::sqrt((0.25 / (1 + tenth * tenth) + 0.01 / (tenth * tenth)) / 3),
                1e-6);
    EXPECT_NEAR(errors.within, 1.0 / 3, 1e-12);
    EXPECT_NEAR(errors.energy, 4.6 / 4 - 1, 1e-6);
    EXPECT_EQ(errorsOf(wanted, wanted, judge::Meets::through).error, 0);
    view.width = 2, view.rows = 2;
    EXPECT_THROW(errorsOf(wanted, imageOf(exact, view, 2), judge::Meets::floor),
                 std::invalid_argument);
}

TEST_F(Caustic, OfABallIsSeenAsItShouldBe) {
    command("meshgen sphere --radius 0.5 --segments 96 -o ball.obj");
    command("meshgen box --from=-2,-1,-2 --to=2,-0.75,2 -o floor.obj");
    command("mesh2vol ball.obj floor.obj -o v.vdb --ior 1.5 --ior 1 --opacity 0 --opacity 1 "
            "--albedo 0 --albedo 0.8 --resolution 64 --bounds=-1.5,-0.85,-1.5,1.5,0.6,1.5");
    command("lightsim v.vdb -o lit.vdb --light directional:-0.3,-1,-0.2:3 --surface-detail 4 "
            "--photons 65536");
    command("render lit.vdb -o seen.exr --eye 0,0.9,2.6 --target 0,-0.15,0 --fov 40 --size 80x60 "
            "--samples 4 --background 0,0,0");
    judge::View view;
    view.width = 80, view.rows = 60;
    judge::Floor floor;
    floor.extent = 1.5, floor.fine = 128;
    const image::Image exact =
        imageOf(judge::pictureOf(judge::BallOverPlane{}, floor, view), view, 3);
    const image::Image seen = image::readExr(at("seen.exr"));
    const Errors errors = errorsOf(seen, exact, judge::Meets::floor);
    EXPECT_GT(errors.pixels, 1000);
    // The specks and the shadow's edge of so few voxels and photons.
    EXPECT_LT(errors.error, 0.09);
    EXPECT_GT(errors.within, 0.88);
    EXPECT_NEAR(errors.energy, 0, 0.004);
    const Errors through = errorsOf(seen, exact, judge::Meets::through);
    EXPECT_LT(through.error, 0.17);
    EXPECT_NEAR(through.energy, 0, 0.01);
}
