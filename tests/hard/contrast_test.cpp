// Hard cases of contrast and of foci: diamond in air, air in diamond, indices below 1, lenses.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

struct Ball {
    double inside, outside;
    static constexpr int kSize = 40;
    static constexpr double kRadius = 13;

    TestVolume volume() const { return ballIn(kSize, kRadius, inside, outside); }
    /// By how much a ray of that impact [radius] turns towards the axis: Snell's law, twice.
    double deflection(double impact) const {
        const double sine = impact * outside / inside;
        return sine >= 1 ? -(kPi - 2 * std::asin(impact))
                         : 2 * (std::asin(impact) - std::asin(sine));
    }
};

const Ball kBalls[] = {{2.42, 1}, {1, 2.42}, {1.5, 1.33}, {1, 1.33}, {0.999, 1}, {1, 0.999}};

class HardContrast : public testing::TestWithParam<Mode> {};
class HardBending : public testing::TestWithParam<Mode> {};

/// The brightest voxel, and whether every one is finite and lit as books say.
ivec3 brightest(const lightsim::Lit& lit) {
    ivec3 best(0);
    forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
        ASSERT_TRUE(std::isfinite(lit.fluence(p)));
        if (lit.fluence(p) > lit.fluence(best)) best = p;
    });
    return best;
}

/// Absorbs and scatters a little everywhere, so that every account of the books is used.
TestVolume& dimmed(TestVolume& scene) {
    scene.constantVector("absorption", dvec3(0.003));
    scene.constantVector("scattering", dvec3(0.002));
    return scene;
}

} // namespace

TEST_P(HardBending, RaysAreBentToTheRightSideByTheRightAngle) {
    for (const Ball& ball : kBalls) {
        SCOPED_TRACE(testing::Message() << ball.inside << " in " << ball.outside);
        const int rays = 40;
        Params params = parallel({20, 20, 100}, dvec3(20), Ball::kSize, {1, rays});
        params.background = dvec3(1);
        GetParam().set(params);
        const Look look(ball.volume().take(), params);
        EXPECT_EQ(look.counter("trapped"), 0);
        for (int i = 0; i < rays; ++i) {
            const double height = 19.5 - i, impact = std::abs(height) / Ball::kRadius;
            const dvec3 out = look.direction(0, i);
            if (impact > 0.85) continue; // within the blur of the edge, 1.5 voxels
            SCOPED_TRACE(testing::Message() << "impact " << impact);
            // The angle of turning towards the axis, from the direction −z.
            const double towards = std::atan2(-out.y * (height > 0 ? 1 : -1), -out.z);
            const double wanted = ball.deflection(impact);
            EXPECT_GT(towards * wanted, 0) << towards;
            // An edge of σ = 1.5 voxels in a radius of 13 bends otherwise than a sharp one: by as
            // much as (σ/R)² of the contrast and more at the rim and at total reflection.
            if (impact < 0.3 && impact * ball.outside / ball.inside < 0.5) {
                EXPECT_NEAR(towards, wanted, 0.15 * std::abs(wanted)) << height;
            }
            EXPECT_NEAR(look.at("R", 0, i), 1, 1e-5); // the same sky everywhere: n²/n² in floats
        }
    }
}

TEST_P(HardContrast, ARayKeepsItsBouguerConstantThroughABall) {
    // n r sinφ: outside, the distance of the ray's line from the centre is the same before and
    // after.
    for (const Ball& ball : kBalls) {
        SCOPED_TRACE(testing::Message() << ball.inside << " in " << ball.outside);
        const int rays = 26;
        Params params = parallel({20, 20, 100}, dvec3(20), 26, {1, rays});
        GetParam().set(params);
        const Look look(ball.volume().take(), params);
        const double contrast = std::abs(ball.inside - ball.outside) / ball.outside;
        for (int i = 0; i < rays; ++i) {
            const double height = 12.5 - i;
            const double line =
                glm::length(glm::cross(look.place(0, i) - 20.0, look.direction(0, i)));
            // Differences of voxels are off the radius by (1/σ)²/6 of the gradient in the
            // direction of an axis: a few hundredths of a voxel per unit of contrast.
            EXPECT_NEAR(line, std::abs(height), 0.25 * contrast + 1e-4) << height;
        }
    }
}

TEST_P(HardBending, AMediumAsHotAsItsSkyIsNotSeen) {
    // In equilibrium L/n² is the same everywhere, and a medium shines as it absorbs: ε = σ L. Every
    // ray then sees the sky, however it is bent: Clausius's n² and Kirchhoff's law in one.
    for (const Ball& ball : kBalls) {
        SCOPED_TRACE(testing::Message() << ball.inside << " in " << ball.outside);
        const double sky = 3, sigma = 0.05;
        TestVolume scene = ball.volume();
        scene.constantVector("absorption", dvec3(sigma));
        scene.addVector("emission", [&](dvec3 p) {
            const double depth = Ball::kRadius - glm::length(p - 0.5 * Ball::kSize);
            const double n = edge(ball.outside, ball.inside, depth, 1.5);
            return dvec3(sigma * sky * n * n / (ball.outside * ball.outside));
        });
        Params params = parallel({50, 70, 100}, dvec3(20), 20, {12, 12});
        params.background = dvec3(sky);
        GetParam().set(params);
        const Look look(scene.take(), params);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x)
                // Between voxels the mean of n² is not the square of the mean of n, nor within a
                // step: a hundredth of it where n changes by half its size in three voxels.
                EXPECT_NEAR(look.at("R", x, y), sky, 0.02 * sky) << x << " " << y;
    }
}

TEST(HardLightContrast, EnergyIsKeptByLightThroughABall) {
    for (const Ball& ball : kBalls) {
        SCOPED_TRACE(testing::Message() << ball.inside << " in " << ball.outside);
        TestVolume scene = ball.volume();
        const lightsim::Lit lit(
            dimmed(scene).volume(),
            lightsim::paramsOf({lightsim::beam({0, 0, -1}), lightsim::lamp({20, 26, 20})},
                               1 << 13)); // which checks the books
        const Energy& energy = lit.stats.energy;
        brightest(lit);
        // 40 voxels of 0.005: what is not lost in a diamond's trap is absorbed or gets out.
        EXPECT_GT(energy.escaped[0], 0.5 * energy.entered[0]);
        EXPECT_NEAR(energy.scattered[0], energy.absorbed[0] * 2 / 3, 1e-5 * energy.entered[0]);
        // The fluence tells the same as the books, but for fixed point.
        EXPECT_NEAR(lit.total() * 0.003, energy.absorbed[0], 1e-3 * energy.absorbed[0]);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, HardContrast, testing::ValuesIn(conservingModes()), modeName);
INSTANTIATE_TEST_SUITE_P(Modes, HardBending, testing::ValuesIn(allModes()), modeName);

TEST(HardFocus, LuneburgsLensGathersABeamInOnePointOfItsRim) {
    for (const dvec3& way : {dvec3(0, 0, 1), dvec3(-1, 0, 0), dvec3(0, 1, 1), dvec3(1, -2, 2)}) {
        SCOPED_TRACE(testing::Message() << way.x << " " << way.y << " " << way.z);
        TestVolume scene(ivec3(40));
        scene.index([](dvec3 p) {
            const double r = glm::length(p - 20.0) / 13;
            return std::sqrt(2 - std::min(r * r, 1.0));
        });
        const lightsim::Lit lit(dimmed(scene).volume(),
                                lightsim::paramsOf({lightsim::beam(way)}, 1 << 16));
        const ivec3 best = brightest(lit);
        const dvec3 focus = 20.0 + 13.0 * glm::normalize(way);
        // A voxel's diagonal: before the focus the cone of rays is as narrow.
        EXPECT_LT(glm::length(dvec3(best) + 0.5 - focus), 1.8);
        // 531 voxels² of light in a few, dimmed by at most 33 voxels of 0.005.
        EXPECT_GT(lit.fluence(best), 50);
        EXPECT_NEAR(lit.stats.energy.lost[0], 0, 2e-3 * lit.stats.energy.entered[0]); // thinning
    }
}

TEST(HardFocus, ABallOfIndexTwoGathersABeamOnItsBack) {
    // Paraxial rays meet at nR/(2(n − 1)) = R behind the centre; those farther out before that, in
    // the ball.
    TestVolume scene = ballIn(40, 13, 2, 1, 1);
    const lightsim::Lit lit(dimmed(scene).volume(),
                            lightsim::paramsOf({lightsim::beam({0, 0, 1})}, 1 << 16));
    const ivec3 best = brightest(lit);
    EXPECT_TRUE(best.x == 19 || best.x == 20) << best.x;
    EXPECT_TRUE(best.y == 19 || best.y == 20) << best.y;
    EXPECT_GE(best.z, 20 + 8);
    EXPECT_LE(best.z, 20 + 14);
    EXPECT_GT(lit.fluence(best), 20);
}
