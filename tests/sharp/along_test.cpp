// Rays that a thin wall leads along itself part again and again: none of their light is lost
// unsaid. SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

TEST(SharpAlong, AHollowBallLosesNoLight) {
    // What enters the hollow at a grazing angle is reflected within it, and leaves a part in the
    // wall at each reflection: hundreds of boundaries a ray, among even light of 1.
    const dvec3 centre(31.8, 32.1, 31.9);
    const double hollow = 23;
    const judge::Glass glass{
        {judge::glassBall(centre, 28, 1.5, 0), judge::glassBall(centre, hollow, 1, 1)}};
    const dvec3 target = centre + dvec3(hollow - 0.03, 0, 0);
    const glm::ivec2 size(8, 4);
    Params params = sharply(view::parallel(target - dvec3(0, 0, 80), target, 0.02, size));
    params.background = dvec3(1);
    params.maxDepth = 64;
    params.cutoff = 1e-5;
    const Look look(volumeOf(glass, {.halfWidth = 6}), params);
    double lost = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) lost += (1 - look.at("R", x, y)) / (size.x * size.y);
    EXPECT_GT(look.counter("boundaries_met"), 200 * look.counter("rays"));
    EXPECT_EQ(look.counter("trapped"), 0);
    EXPECT_NEAR(lost, look.counter("light_dropped_by_depth"), 1e-5);
    EXPECT_LT(lost, 0.1);
}
