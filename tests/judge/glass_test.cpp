// The judge's solids of glass against what is solved on paper: slab, prisms, balls, light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/closed.h"
#include "judge/glass.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace judge;

namespace {

using std::numbers::pi;

// Doubles of places up to 50 voxels and a few boundaries, whose roundings of 1e-14 a slope of some
// tens of radians per radius makes larger.
constexpr double kRounding = 1e-11;

const dvec3 kCentre(31.3, 32.6, 30.9);
constexpr double kRadius = 25;

/// A ray along an askew direction that passes the centre at the distance off · radius, on the side
/// that `azimuth` says.
struct Aimed {
    Ray ray;
    dvec3 along, across;
};
Aimed aimed(double off, double azimuth) {
    const dvec3 d = glm::normalize(dvec3(0.8, -0.3, 0.5));
    const dvec3 u = glm::normalize(glm::cross(d, dvec3(0, 1, 0))), v = glm::cross(d, u);
    const dvec3 across = std::cos(azimuth) * u + std::sin(azimuth) * v;
    return {{kCentre + off * kRadius * across - 80.0 * d, 2.0 * d}, d, across};
}

/// The angle that a direction is turned by towards the axis, in (−π, π], and checks that it is in
/// the plane of incidence.
double turned(const Aimed& from, const dvec3& direction) {
    EXPECT_NEAR(glm::dot(direction, glm::cross(from.along, from.across)), 0, kRounding);
    return std::atan2(-glm::dot(direction, from.across), glm::dot(direction, from.along));
}

/// How far two angles are apart.
double apart(double a, double b) {
    return std::abs(std::remainder(a - b, 2 * pi));
}

const Branch* branchOf(const Tree& tree, const std::string& course) {
    for (const Branch& branch : tree.left)
        if (branch.course == course) return &branch;
    return nullptr;
}

/// Three planes across z, between caps far off: a prism by its sides' outward normals.
Solid prism(const std::vector<Plane>& sides, double index) {
    std::vector<Plane> planes = sides;
    planes.push_back({{0, 0, 1}, 1000});
    planes.push_back({{0, 0, -1}, 1000});
    return glassHull(planes, index);
}

} // namespace

TEST(Glass, ASlabShiftsARay) {
    const double n = 1.5, thick = 10;
    const Glass slab{{glassBox({-1e3, -thick, -1e3}, {1e3, 0, 1e3}, n)}};
    for (double degrees = 0; degrees < 89; degrees += 4) {
        const double angle = glm::radians(degrees), s = std::sin(angle), c = std::cos(angle);
        const Ray ray{{-5 * s, 5 * c, 3}, {s, -c, 0}};
        const Path path = followTransmitted(slab, ray);
        ASSERT_TRUE(path.left);
        EXPECT_LT(glm::length(path.ray.direction - ray.direction), kRounding);
        const dvec3 off = path.ray.x - ray.x;
        const double shift = glm::length(off - glm::dot(off, ray.direction) * ray.direction);
        const double root = std::sqrt(n * n - s * s);
        EXPECT_NEAR(shift, thick * s * (1 - c / root), kRounding) << degrees;
        EXPECT_NEAR(path.pathLength, 5 + thick * n / root, kRounding);
        EXPECT_NEAR(path.opticalLength, 5 + thick * n * n / root, kRounding);
        // All reflections between the faces: T² R^2k through, and together (1 − R)/(1 + R).
        const double reflected = reflectance(n, c).mean();
        const Tree tree = followAll(slab, ray, {.maxDepth = 400, .minThroughput = 1e-17});
        double through = 0;
        for (const Branch& branch : tree.left)
            if (branch.ray.direction.y < 0) through += branch.weight;
        EXPECT_NEAR(through, (1 - reflected) / (1 + reflected), 1e-12); // hundreds of terms
        EXPECT_NEAR(branchOf(tree, "R")->weight, reflected, 1e-15);
    }
}

TEST(Glass, APrismsLeastDeviation) {
    // 60°, 1.5: 2 asin(1.5 sin 30°) − 60° = 37.18°, where the ray is symmetric; more to both sides.
    const double h = std::sqrt(0.75);
    const Glass glass{{prism({{{-h, 0.5, 0}, 10}, {{h, 0.5, 0}, 10}, {{0, -1, 0}, 10}}, 1.5)}};
    const auto deviation = [&](double incidence) {
        const double tilt = incidence - pi / 6; // of the ray above the base's direction
        const dvec3 d(std::cos(tilt), std::sin(tilt), 0);
        const dvec3 side = dvec3(-h, 0.5, 0) * 10.0;
        const Path path = followTransmitted(glass, {side - 20.0 * d, d});
        EXPECT_EQ(path.met.size(), 2u);
        return std::acos(glm::dot(path.ray.direction, d));
    };
    const double incidence = std::asin(0.75), least = 2 * incidence - pi / 3;
    EXPECT_NEAR(glm::degrees(least), 37.18, 0.001); // the number as given
    EXPECT_NEAR(deviation(incidence), least, kRounding);
    EXPECT_GT(deviation(incidence + 0.02), least + 1e-5);
    EXPECT_GT(deviation(incidence - 0.02), least + 1e-5);
}

TEST(Glass, ARightAnglePrismTurnsAllLightByTotalReflection) {
    const double r = std::sqrt(0.5);
    const Glass glass{{prism({{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{r, r, 0}, 10 * r}}, 1.5)}};
    // Into a leg: off the hypotenuse at 45°, past the critical 41.8°, out of the other leg.
    const Ray into{{-5, 3, 1}, {1, 0, 0}};
    const Path path = followTransmitted(glass, into);
    ASSERT_EQ(path.met.size(), 3u);
    EXPECT_EQ(path.met[1].reflected, 1);
    EXPECT_LT(glm::length(path.ray.direction - dvec3(0, -1, 0)), kRounding);
    EXPECT_LT(glm::length(path.ray.x - dvec3(7, 0, 1)), kRounding);
    const Tree tree = followAll(glass, into, {});
    EXPECT_NEAR(branchOf(tree, "TRT")->weight, 0.96 * 0.96, 1e-14);
    // Into the hypotenuse: off both legs and back along itself, shifted.
    const dvec3 back(-r, -r, 0);
    const Path porro = followTransmitted(glass, {dvec3(7, 8, 1), back});
    ASSERT_EQ(porro.met.size(), 4u);
    EXPECT_LT(glm::length(porro.ray.direction + back), kRounding);
}

TEST(Glass, ABallsOrdersAreSnellsAndFresnels) {
    for (const double n : {1.5, 4.0 / 3, 2.42, 1 / 1.5}) {
        const Glass glass{{glassBall(kCentre, kRadius, n > 1 ? n : 1)}, n > 1 ? 1 : 1 / n};
        for (double off = 0.02; off < 0.999; off += 0.0233) {
            const Aimed aim = aimed(off, 20 * off);
            const Tree tree = followAll(glass, aim.ray, {.maxDepth = 9, .minThroughput = 0});
            const auto shares = ballOrders(n, off, false);
            const std::string courses[] = {"R", "TT", "TRT", "TRRT"};
            for (int order = 0; order < 4; ++order) {
                const Branch* branch = branchOf(tree, courses[order]);
                if (order > 0 && off > n) {
                    EXPECT_EQ(branch, nullptr);
                    continue;
                }
                ASSERT_NE(branch, nullptr);
                EXPECT_NEAR(branch->weight, shares[static_cast<size_t>(order)], kRounding);
                EXPECT_LT(apart(turned(aim, branch->ray.direction), ballDeflection(n, off, order)),
                          kRounding);
                EXPECT_NEAR(glm::length(branch->ray.x - kCentre), kRadius, kRounding);
            }
            const Path path = followTransmitted(glass, aim.ray);
            EXPECT_EQ(path.met.size(), off > n ? 1u : 2u);
            EXPECT_LT(
                apart(turned(aim, path.ray.direction), ballDeflection(n, off, off > n ? 0 : 1)),
                kRounding);
        }
    }
}

TEST(Glass, NoPowerIsMadeOrLost) {
    const std::vector<Glass> scenes = {
        {{glassBall(kCentre, kRadius, 1.5)}},
        {{glassBall(kCentre, kRadius, 1)}, 1.5},
        {{glassBox(kCentre - 15.0, kCentre + 14.0, 2.42)}},
        {{glassBox(kCentre - 15.0, kCentre + 14.0, 1.5),
          glassBox(kCentre - 9.0, kCentre + 8.0, 1.34)}},
        {{glassBall(kCentre, kRadius, 1.5), glassBall(kCentre + 9.0, 16, 1.34, -1),
          glassBall(kCentre - 4.0, 8, 1, 3)}},
        {{luneburgBall(kCentre, kRadius, 1.5)}}};
    for (const Glass& glass : scenes)
        for (double off = 0.05; off < 1; off += 0.09) {
            const Ray ray = aimed(off, 9 * off).ray;
            const Tree tree = followAll(glass, ray);
            EXPECT_NEAR(tree.sum() + tree.tooDeep + tree.tooFaint, 1, 1e-14);
            EXPECT_NEAR(radiance(glass, ray, [](dvec3) { return 3.0; }),
                        3 * (tree.sum() + tree.tooDeep), 1e-14);
            for (const Branch& branch : tree.left) {
                EXPECT_GE(branch.weight, 1e-3);
                EXPECT_LE(branch.course.size(), 8u);
            }
            // Followed for longer no more is left over.
            const Tree longer = followAll(glass, ray, {.maxDepth = 12, .minThroughput = 1e-4});
            EXPECT_LE(longer.tooDeep + longer.tooFaint, tree.tooDeep + tree.tooFaint + 1e-14);
        }
}

TEST(Glass, AnEyeInGlassSeesTheSquareOfItsIndex) {
    const Glass glass{{glassBall(kCentre, kRadius, 1.5)}};
    // From the centre every ray leaves at a right angle: 0.96 goes out, 0.04 round again.
    const auto one = [](dvec3) { return 1.0; };
    const Limits longer{.maxDepth = 40, .minThroughput = 1e-18};
    EXPECT_NEAR(radiance(glass, {kCentre, {1, 2, 3}}, one, longer), 2.25, 1e-14);
    const Path path = followTransmitted(glass, {kCentre, {1, 2, 3}});
    EXPECT_NEAR(path.pathLength, kRadius, kRounding);
    EXPECT_NEAR(path.opticalLength, 1.5 * kRadius, kRounding);
    // Looking forward and back differ where light does.
    const auto ahead = [](dvec3 d) { return d.x > 0 ? 1.0 : 0; };
    EXPECT_NEAR(radiance(glass, {kCentre, {1, 0, 0}}, ahead, longer), 2.25 * 0.96 / (1 - 0.0016),
                1e-13);
    // Past the critical angle nothing ever leaves a ball: all its angles are the same.
    const Tree trapped = followAll(glass, {kCentre + dvec3(0, 0.9 * kRadius, 0), {1, 0, 0}});
    EXPECT_TRUE(trapped.left.empty());
    EXPECT_EQ(trapped.tooDeep, 1);
}

TEST(Glass, TouchingSolidsHaveOneBoundaryBetweenThem) {
    // Glass below wine below glass of the first's priority, face to face, as one with a gap below
    // what counts, and overlapping where the higher or the later wins.
    const dvec3 low(-1e3), high(1e3);
    const auto layer = [&](double from, double to, double n, int priority) {
        return glassBox({low.x, from, low.z}, {high.x, to, high.z}, n, priority);
    };
    const std::vector<Glass> scenes = {{{layer(0, 10, 1.5, 0), layer(10, 20, 1.34, 0)}},
                                       {{layer(0, 10 - 1e-12, 1.5, 0), layer(10, 20, 1.34, 0)}},
                                       {{layer(0, 20, 1.5, 0), layer(10, 20, 1.34, 1)}},
                                       {{layer(0, 20, 1.5, 0), layer(10, 20, 1.34, 0)}},
                                       {{layer(10, 20, 1.34, 5), layer(0, 20, 1.5, 2)}},
                                       {{layer(0, 10, 1.5, 1), layer(0, 20, 1.34, 0)}}};
    for (const Glass& glass : scenes)
        for (const double angle : {0.0, 0.5, 1.2}) {
            const double s = std::sin(angle);
            const Path path = followTransmitted(glass, {{0, 30, 0}, {s, -std::cos(angle), 0}});
            ASSERT_EQ(path.met.size(), 3u);
            EXPECT_NEAR(path.met[1].x.y, 10, kRounding);
            EXPECT_NEAR(path.met[1].ratio, 1.5 / 1.34, 1e-15);
            EXPECT_LT(glm::length(path.ray.direction - dvec3(s, -std::cos(angle), 0)), kRounding);
            const auto tangent = [&](double n) { return s / std::sqrt(n * n - s * s); };
            EXPECT_NEAR(path.ray.x.x, 10 * (tangent(1) + tangent(1.34) + tangent(1.5)), kRounding);
        }
}

TEST(Glass, ABallInABallKeepsTheInvariantOfBoth) {
    // n r sinφ is the impact parameter throughout: 2 (θ0 − θ1 + φ1 − φ2).
    const double inner = 15;
    for (const bool overlapping : {true, false}) {
        const Glass glass{
            {glassBall(kCentre, overlapping ? inner : kRadius, overlapping ? 1.34 : 1.5,
                       overlapping ? 2 : 0),
             glassBall(kCentre, overlapping ? kRadius : inner, overlapping ? 1.5 : 1.34)}};
        for (double off = 0.03; off < 0.99; off += 0.05) {
            const Aimed aim = aimed(off, 7 * off);
            const double b = off * kRadius;
            double turn = std::asin(off) - std::asin(off / 1.5);
            // 1.34 · 15 voxels: beyond it the wine reflects totally, beyond 1.5 · 15 it is missed.
            if (b < 1.34 * inner)
                turn += std::asin(b / (1.5 * inner)) - std::asin(b / (1.34 * inner));
            else if (b < 1.5 * inner)
                turn += std::asin(b / (1.5 * inner)) - pi / 2;
            const Path path = followTransmitted(glass, aim.ray);
            EXPECT_LT(apart(turned(aim, path.ray.direction), 2 * turn), kRounding) << off;
        }
    }
}

TEST(Glass, AGradedBallIsBouguers) {
    // Snell in, the quadrature of the deflection of n r sinφ = b inside, Snell out.
    const double rim = 1.5;
    const Profile n = [=](double r) { return rim * std::sqrt(2 - r * r / (kRadius * kRadius)); };
    const Profile slope = [=](double r) { return -rim * rim * r / (kRadius * kRadius * n(r)); };
    const Glass graded{{gradedBall(kCentre, kRadius, n, slope)}};
    const Glass luneburg{{luneburgBall(kCentre, kRadius, rim)}};
    for (double off = 0.04; off < 0.99; off += 0.07) {
        const RadialPass pass = radialPass(n, slope, off * kRadius / rim, kRadius);
        const double wanted = 2 * (std::asin(off) - std::asin(off / rim)) + pass.deflection;
        // Inside a Luneburg lens rays are ellipses about the centre, a quarter turn of phase from
        // rim to rim: the quadrature again, in closed form.
        const double inner = std::asin(off / rim);
        EXPECT_NEAR(pass.deflection, inner, 1e-9);
        for (const Glass& glass : {graded, luneburg}) {
            const Aimed aim = aimed(off, 11 * off);
            const Path path = followTransmitted(glass, aim.ray);
            ASSERT_EQ(path.met.size(), 2u);
            EXPECT_LT(apart(turned(aim, path.ray.direction), wanted), 1e-9); // the quadrature's
            const double outside = 80 - kRadius * std::sqrt(1 - off * off);
            EXPECT_NEAR(path.opticalLength - outside, pass.opticalLength, 1e-7);
            // Both ends are at the same angle: T² through, T² R after one reflection.
            const Tree tree = followAll(glass, aim.ray);
            const auto shares = ballOrders(rim, off, false);
            EXPECT_NEAR(branchOf(tree, "R")->weight, shares[0], kRounding);
            EXPECT_NEAR(branchOf(tree, "TT")->weight, shares[1], kRounding);
        }
    }
}

TEST(Glass, ABallLensFocusesAtHalfNROverNMinusOne) {
    for (const double n : {1.5, 1.7}) {
        const Glass glass{{glassBall(kCentre, kRadius, n)}};
        const Aimed aim = aimed(1e-5, 1);
        const Path path = followTransmitted(glass, aim.ray);
        const dvec3 r = path.ray.x - kCentre;
        const double t = -glm::dot(r, aim.across) / glm::dot(path.ray.direction, aim.across);
        const double focus = glm::dot(r + t * path.ray.direction, aim.along);
        // Spherical aberration is off² of it; roundings are 1e-15 · 50 voxels in 2.5e-4.
        EXPECT_NEAR(focus, ballFocus(n, kRadius), 1e-8);
    }
}

TEST(Glass, ExitsAreOnTheBoxAndLengthsWithinIt) {
    const Glass slab{{glassBox({0, 10, 0}, {40, 20, 40}, 1.5)}, 1.2};
    const Exit through = exitOf(slab, {{20, 90, 20}, {0, -3, 0}}, dvec3(0), dvec3(40));
    EXPECT_LT(glm::length(through.x - dvec3(20, 0, 20)), kRounding);
    EXPECT_NEAR(through.pathLength, 40, kRounding);
    EXPECT_NEAR(through.opticalLength, 30 * 1.2 + 10 * 1.5, kRounding);
    const Exit within = exitOf(slab, {{20, 15, 20}, {0, 1, 0}}, dvec3(0), dvec3(40));
    EXPECT_NEAR(within.pathLength, 25, kRounding);
    EXPECT_NEAR(within.opticalLength, 20 * 1.2 + 5 * 1.5, kRounding);
    const Exit missed = exitOf(slab, {{20, 90, 20}, {1, 0, 0}}, dvec3(0), dvec3(40));
    EXPECT_EQ(missed.x, dvec3(20, 90, 20));
    EXPECT_EQ(missed.pathLength, 0);
    const Exit beside =
        exitOf({{glassBall(dvec3(20), 5, 1.5)}, 1}, {{1, 1, -9}, {0, 0, 1}}, dvec3(0), dvec3(40));
    EXPECT_LT(glm::length(beside.x - dvec3(1, 1, 40)), kRounding);
    EXPECT_NEAR(beside.pathLength, 40, kRounding);
}

TEST(Beams, ASlabsFluenceIsTheSumOfItsReflections) {
    // Straight down and tilted: below T² (1 + R²), above the mirror image, too, and in the slab,
    // where the beam is narrower by cosθ/cosθ_t, as much more. It is too wide for light from its
    // edges to get to the middle in six boundaries.
    const Glass glass{{glassBox({-50, 0, -50}, {50, 2, 50}, 2.42)}};
    for (const double angle : {0.0, 0.4}) {
        const Beam beam{.direction = {std::sin(angle), -std::cos(angle), 0},
                        .photons = 2e6,
                        .limits = {6, 1e-3}};
        const Grid grid{{-4, -4, -4}, 1, {8, 10, 8}};
        BeamBook book;
        const auto fluence = beamFluence(glass, beam, grid, &book);
        EXPECT_NEAR((book.left + book.dropped) / book.met, 1, 1e-9); // a million roundings
        const double r = reflectance(2.42, std::cos(angle)).mean(), t = 1 - r;
        const double sinT = std::sin(angle) / 2.42;
        const double narrow = std::cos(angle) / std::sqrt(1 - sinT * sinT);
        for (int y = 0; y < 10; ++y) {
            double row = 0;
            for (int x = 0; x < 8; ++x)
                for (int z = 0; z < 8; ++z) row += fluence[grid.cell({x, y, z})] / 64;
            double wanted = t * t * (1 + r * r);
            if (y >= 4) wanted = t * (1 + r + r * r + r * r * r) * narrow;
            if (y >= 6) wanted = 1 + r + t * t * r * (1 + r * r);
            // Some 8000 photons to a row, whose number errs like its rim; and the thousandth and
            // less that is dropped.
            EXPECT_NEAR(row, wanted, 0.01) << y;
        }
    }
}

TEST(Beams, ABallsLightIsThatOfTheBallsOwnPhotons) {
    // In the shadow just behind the ball only order 1 counts for much: the inner reflections have
    // 4 % between them and go elsewhere for the most part; without them it is ballFluence's.
    const BallScene scene{.centre = {16, 16, 16},
                          .radius = 12,
                          .direction = {0.2, -1, 0.1},
                          .fresnel = Fresnel::Unpolarised,
                          .photons = 4e5};
    const Grid whole{dvec3(0), 1, ivec3(32)};
    const auto wanted = ballFluence(scene, whole);
    const Glass glass{{glassBall(scene.centre, scene.radius, scene.index)}};
    const Grid slab{{0, 0, 0}, 1, {32, 3, 32}};
    const Beam beam{.direction = scene.direction, .photons = 1.6e6, .limits = {2, 1e-3}};
    const auto found = beamFluence(glass, beam, slab);
    double off = 0, all = 0;
    for (int x = 0; x < 32; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 32; ++z) {
                const dvec3 d = glm::normalize(scene.direction);
                const dvec3 r = whole.middle({x, y, z}) - scene.centre;
                if (glm::length(r - glm::dot(r, d) * d) > 8) continue; // within the bright cone
                const double a = found[slab.cell({x, y, z})], b = wanted[whole.cell({x, y, z})];
                off += std::abs(a - b), all += b;
            }
    // Behind the caustic light is smooth, and a cell's share of a sunflower is exact but for its
    // rim: 1e-3 of some thousand photons, less in sum.
    EXPECT_LT(off / all, 1e-3);
}

TEST(Beams, NothingGradedAndNoCrowds) {
    const Grid grid{dvec3(0), 1, ivec3(4)};
    EXPECT_THROW(beamFluence({{luneburgBall(kCentre, 5, 1.5)}}, {}, grid), std::invalid_argument);
    const Glass crowd{std::vector<Solid>(65, glassBall(kCentre, 1, 1.5))};
    EXPECT_THROW(followAll(crowd, {dvec3(0), {1, 0, 0}}), std::invalid_argument);
}
