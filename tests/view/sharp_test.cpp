// Sharp boundaries as viewing rays meet them, on cases solved on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;

namespace {

/// Radiance 1 from half of all directions, and none from the others.
image::Image halfSky(const dvec3& towards) {
    return sharp::mapOf([=](dvec3 d) { return dvec3(glm::dot(d, towards) > 0 ? 1 : 0); });
}

/// Radiance 1 all round, boundaries sharp.
Params sharply(Params params, int maxDepth) {
    params.boundary = optics::Boundary::sharp;
    params.maxDepth = maxDepth;
    params.background = dvec3(1);
    return params;
}

} // namespace

TEST(Sharp, AMirrorsTintColoursWhatItSendsBack) {
    // A plate across the view: all light comes from behind the eye, by what its first face mirrors,
    // R = 0.04.
    TestVolume plate({24, 24, 24});
    plate.add("sdf", [](dvec3 p) { return std::abs(p.z - 12.3) - 5; });
    plate.constant("ior", 1.5);
    plate.constantVector("reflectance", {0.5, 1, 0.25});
    const Look look(plate.take(), sharply(parallel({12, 12, 50}, {12, 12, 12}, 4), 1),
                    halfSky({0, 0, 1}));
    // Roundings of floats are 1e-7 of 0.04 each; a handful of them.
    expectNear(look.colour(), 0.04 * dvec3(0.5, 1, 0.25), 1e-6);
}

namespace {

/// Glass of 1.5 between two heights [voxel], in a domain of 24 voxels along each axis.
TestVolume slabOfGlass(double low, double high) {
    TestVolume slab(glm::ivec3(24));
    slab.add("sdf", [=](dvec3 p) { return std::max(low - p.z, p.z - high); });
    slab.constant("ior", 1.5);
    return slab;
}

} // namespace

TEST(Sharp, AnEyeOnABoundaryIsOnTheSideItLooksTo) {
    // Parallel rays that start on the face of a slab, all of them within rounding of it. Those that
    // head into it are in glass, and see the background through the other face with n² and less
    // what that one sends back; those that head out see it as it is.
    const double R = 0.04;
    for (const double face : {17.0, 17.3, 16.95}) {
        for (const bool inward : {true, false}) {
            const dvec3 eye(12, 12, face), ahead = eye + dvec3(0, 0, inward ? -1 : 1);
            const Look look(slabOfGlass(6.2, face).take(),
                            sharply(parallel(eye, ahead, 12, {12, 12}), 1), halfSky(ahead - eye));
            for (int y = 0; y < 12; ++y)
                for (int x = 0; x < 12; ++x)
                    EXPECT_NEAR(look.at("R", x, y), inward ? 2.25 * (1 - R) : 1, 1e-4) << face;
        }
    }
}

TEST(Sharp, ABackgroundBehindAFaceThatCutsGlassIsScaled) {
    // The glass goes on beyond the domain's face: an eye within it sees radiance times n², one
    // before the slab sees it through the boundary, less what that sends back.
    const Look within(slabOfGlass(-5, 12.4).take(),
                      sharply(parallel({12, 12, 6}, {12, 12, 0}, 12, {4, 4}), 8));
    EXPECT_NEAR(within.at("R", 1, 1), 2.25, 1e-5);
    const Look before(slabOfGlass(-5, 12.4).take(),
                      sharply(parallel({12, 12, 50}, {12, 12, 0}, 12, {4, 4}), 8));
    EXPECT_NEAR(before.at("R", 1, 1), 1, 1e-5);
}

TEST(Sharp, ABoundaryOnTheDomainsFaceRefracts) {
    // A slab as thick as the domain: rays aslant come out as they went in, shifted by what Snell's
    // law says, and the faces reflect. Many of them, so that places round
    // in every way; none comes to a side of the domain.
    for (const dvec3& towards : {dvec3(0.5, 0.21, -1), dvec3(-0.3, 0.4, 1)}) {
        const dvec3 d = glm::normalize(towards), middle(12.03, 11.94, 12);
        Params params = sharply(parallel(middle - 60.0 * d, middle, 2.5, {24, 24}), 1);
        params.aovs = {"exit_direction", "optical_path_length"};
        const Look look(slabOfGlass(0, 24).take(), params, halfSky({0, 0, -d.z}));
        params.maxDepth = 2;
        const Look through(slabOfGlass(0, 24).take(), params, halfSky(d));
        const double sine = std::hypot(d.x, d.y) / 1.5, length = 24 / std::sqrt(1 - sine * sine);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                EXPECT_LT(look.at("R", x, y), 0.1);     // the mirror's share alone
                EXPECT_LT(through.at("R", x, y), 0.99); // less what the far face sends back
                EXPECT_LT(glm::length(through.direction(x, y) - d), 1e-5);
                EXPECT_NEAR(through.at("optical_path_length.V", x, y), 1.5 * length, 1e-3);
            }
    }
}
