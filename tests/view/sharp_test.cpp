// Sharp boundaries as viewing rays meet them, on cases solved on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;

namespace {

/// Radiance 1 all round, boundaries sharp.
Params sharply(Params params, int maxDepth) {
    params.boundary = optics::Boundary::sharp;
    params.maxDepth = maxDepth;
    params.background = dvec3(1);
    return params;
}

} // namespace

TEST(Sharp, AMirrorsTintColoursWhatItSendsBack) {
    // A plate across the view: at depth 1 all that is left is what its face mirrors, R = 0.04.
    TestVolume plate({24, 24, 24});
    plate.add("sdf", [](dvec3 p) { return std::abs(p.z - 12.3) - 5; });
    plate.constant("ior", 1.5);
    plate.constantVector("reflectance", {0.5, 1, 0.25});
    const Look look(plate.take(), sharply(parallel({12, 12, 50}, {12, 12, 12}, 4), 1));
    // Roundings of floats are 1e-7 of 0.04 each; a handful of them.
    expectNear(look.colour(), 0.04 * dvec3(0.5, 1, 0.25), 1e-6);
}
