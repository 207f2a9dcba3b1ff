// Light through curved media: a blurred glass ball, turned every way, and orbits that never leave.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lit.h"

#include <array>

using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

namespace {

/// Glass of index 1.5 with an edge blurred to an error function of σ = 1.5 voxels.
double ball(const dvec3& p, const dvec3& centre, double radius) {
    const double depth = radius - glm::length(p - centre);
    return 1 + 0.25 * std::erfc(-depth / (1.5 * std::sqrt(2.0)));
}

/// The 24 ways to turn a cube into itself.
std::vector<dmat3> cubeTurns() {
    std::vector<dmat3> turns;
    const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (const auto& order : orders)
        for (int signs = 0; signs < 8; ++signs) {
            dmat3 turn(0.0);
            for (int i = 0; i < 3; ++i) turn[i][order[i]] = (signs >> i & 1) ? -1 : 1;
            if (glm::determinant(turn) > 0) turns.push_back(turn);
        }
    return turns;
}

} // namespace

TEST(LightLens, AGlassBallFocusesOnTheAxisBehindIt) {
    TestVolume scene(ivec3(32));
    scene.index([](dvec3 p) { return ball(p, dvec3(16), 9); });
    const Lit lit(scene.volume(), paramsOf({beam({0, 0, 1})}, 1 << 16));
    ivec3 brightest(0);
    forEachVoxel(ivec3(32), [&](ivec3 p) {
        if (lit.fluence(p) > lit.fluence(brightest)) brightest = p;
    });
    // A ball of 1.5 brings rays near its axis to 1.5 radii from its centre, those farther out to
    // its surface: 9 to 13.5 voxels behind the centre, on one of the four voxels on the axis.
    EXPECT_TRUE(brightest.x == 15 || brightest.x == 16) << brightest.x;
    EXPECT_TRUE(brightest.y == 15 || brightest.y == 16) << brightest.y;
    EXPECT_GE(brightest.z, 16 + 8);
    EXPECT_LE(brightest.z, 16 + 14);
    EXPECT_GT(lit.fluence(brightest), 15);
    // The rim of the ball throws a shadow, beside it the light is as it came.
    EXPECT_NEAR(lit.fluence({16, 30, 16}), 1, 0.05); // the glory below, spread all round
    EXPECT_LT(lit.fluence({16, 24, 30}), 0.8);
    // n r hardly grows within the blurred edge: rays at 11.0 voxels from the axis are turned back
    // by it, those between 11.0 and 11.3 leave in all directions (the deflection integral, done on
    // paper). The ring is a glory, bright on the axis on the side that the light comes from.
    EXPECT_GT(lit.fluence({16, 16, 2}), 1.2);
    EXPECT_LT(lit.fluence({16, 16, 2}), 3);
    EXPECT_NEAR(lit.stats.energy.escaped[0], lit.stats.energy.entered[0],
                1e-3 * 1024); // the last thousandth of the photons is not traced to its end
    // Mirror images of each other in the axis, photon by photon but for rounding.
    double worst = 0;
    forEachVoxel(ivec3(32), [&](ivec3 p) {
        for (const ivec3& twin : {ivec3(p.y, p.x, p.z), ivec3(31 - p.x, p.y, p.z)})
            worst = std::max(worst, std::abs(lit.fluence(p) - lit.fluence(twin)));
    });
    // Rays of the rim turn a rounding into a neighbouring voxel: a photon in 64 changes sides.
    EXPECT_LT(worst, 0.02 * lit.fluence(brightest));
}

TEST(LightLens, ATurnedSceneGivesTheTurnedLight) {
    // A ball off the centre is bent by light from one side: no two of the 24 turns look alike.
    const dvec3 centre(-1.5, 2, 0.7), size(20), direction(1, 0.2, -0.1);
    const auto scene = [&](const dmat3& turn) {
        TestVolume out{ivec3(size)};
        out.index(
            [&](dvec3 p) { return ball(glm::transpose(turn) * (p - 0.5 * size), centre, 6); });
        return out;
    };
    const Lit reference(scene(dmat3(1)).volume(), paramsOf({beam(direction)}, 1 << 14));
    double most = 0;
    forEachVoxel(ivec3(size), [&](ivec3 p) { most = std::max(most, reference.fluence(p)); });
    for (const dmat3& turn : cubeTurns()) {
        const Lit lit(scene(turn).volume(), paramsOf({beam(turn * direction)}, 1 << 14));
        double difference = 0, turned = 0;
        forEachVoxel(ivec3(size), [&](ivec3 p) {
            const dvec3 place = turn * (dvec3(p) + 0.5 - 0.5 * size) + 0.5 * size;
            const ivec3 twin(glm::floor(place));
            difference += std::abs(lit.fluence(twin) - reference.fluence(p)) / 8000;
            turned += glm::length(lit.direction(twin) - turn * reference.direction(p)) / 8000;
        });
        // The same rays from another lattice of pixels, 40 to a voxel: some 6 % of noise a voxel
        // where the light is even, several times that in the caustic.
        EXPECT_LT(difference, 0.06) << "mean difference of fluence";
        EXPECT_LT(turned, 0.02) << "mean difference of direction"; // its noise, as above
    }
    // That is no empty promise: the wrong turn is far off.
    const dmat3 wrong = cubeTurns()[5];
    double difference = 0;
    const Lit lit(scene(wrong).volume(), paramsOf({beam(wrong * direction)}, 1 << 14));
    forEachVoxel(ivec3(size), [&](ivec3 p) {
        difference += std::abs(lit.fluence(p) - reference.fluence(p)) / 8000;
    });
    EXPECT_GT(difference, 0.15);
}

TEST(LightLens, APointLightsRaysAreBentToo) {
    // From the point at 3 radii a ball images to a real point behind: brightest there, on the axis.
    TestVolume scene({24, 24, 40});
    scene.index([](dvec3 p) { return ball(p, {12, 12, 14}, 7); });
    const Lit lit(scene.volume(), paramsOf({lamp({12, 12, -20})}, 1 << 16));
    ivec3 brightest(0);
    forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
        if (p.z >= 14 && lit.fluence(p) > lit.fluence(brightest)) brightest = p;
    });
    EXPECT_TRUE(brightest.x == 11 || brightest.x == 12) << brightest.x;
    EXPECT_TRUE(brightest.y == 11 || brightest.y == 12) << brightest.y;
    // 1/s' = 1/f − 1/s with f = 1.5 radii and s = 34 voxels from the centre: 15 voxels at most.
    EXPECT_GE(brightest.z, 14 + 6);
    EXPECT_LE(brightest.z, 14 + 16);
}

TEST(LightLens, AGradedRodFocusesAfterAQuarterOfAPeriod) {
    // n² = n0² − a² r² inside the domain, whose face does not refract: parallel rays cross the axis
    // at π/2 · n(r)/a, 31.4 voxels deep for those near it and 29 for those 8 voxels off.
    TestVolume scene({17, 17, 48});
    scene.index([](dvec3 p) {
        const double x = p.x - 8.5, y = p.y - 8.5;
        return std::sqrt(1.6 * 1.6 - 0.08 * 0.08 * (x * x + y * y));
    });
    for (const double side : {1.0, -1.0}) {
        const Lit lit(scene.volume(), paramsOf({beam({0, 0, side})}, 1 << 14));
        ivec3 brightest(0);
        forEachVoxel(lit.plan.scene.size(), [&](ivec3 p) {
            if (lit.fluence(p) > lit.fluence(brightest)) brightest = p;
        });
        EXPECT_EQ(brightest.x, 8);
        EXPECT_EQ(brightest.y, 8);
        const int depth = side > 0 ? brightest.z : 47 - brightest.z;
        EXPECT_GE(depth, 28);
        EXPECT_LE(depth, 31);
    }
}

TEST(LightLens, OrbitsThatOverflowAVoxelAreRunAgain) {
    // In Maxwell's fish-eye rays run in circles. Those from a point inside come back to it again
    // and again, if their circle fits the box, until they are absorbed: the sums of the voxels
    // there overflow their first unit.
    TestVolume scene(ivec3(16));
    scene.index([](dvec3 p) { return 2 / (1 + glm::dot(p - 8.0, p - 8.0) / 9); });
    scene.constantVector("absorption", dvec3(0.0005));
    Params params = paramsOf({lamp({8, 8, 5.2})}, 1000);
    params.stepMin = 0.5;
    params.thinTo = 0;
    params.dropBelow = 0.05;
    params.outputs = Output::fluence;
    params.tracing.interpolation = optics::Interpolation::cubic;
    const Lit lit(scene.volume(), params);
    EXPECT_GE(lit.counter("batches_run_again"), 1);
    const Energy& energy = lit.stats.energy;
    // What the books say was absorbed, the fluence says too. A unit 16 or 256 times coarser rounds
    // each of some million deposits by up to one, in either direction at random.
    EXPECT_NEAR(lit.total() * 0.0005, energy.absorbed[0], 2e-3 * energy.absorbed[0]);
    // Circles about a centre up to 3.4 from the lens's fit a ball of radius 8: three quarters of
    // all directions, and 0.95 of their light is absorbed before it is dropped. On a spline they
    // keep to their circles even in so few voxels.
    EXPECT_GT(energy.absorbed[0], 0.6 * energy.entered[0]);
}
