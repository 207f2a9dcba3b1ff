// The judge's tracer against rays solved on paper, and against what every ray must keep.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/closed.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace judge;

namespace {

using std::numbers::pi;

const dvec3 kLow(0), kHigh(128, 96, 64); // unlike sides, so that a mixed-up axis shows
const dvec3 kMiddle = 0.5 * (kLow + kHigh);

// One step's error is below 1e-13 of half the box, 64 voxels, some tens of steps add up, and their
// errors of direction grow with the distance to the exit: 1e-11 voxel. The tracer's margin of 2⁸
// pays for what curves more. Directions are per radian, and their errors do not grow so.
constexpr double kNear = 1e-11;
constexpr double kAngle = 1e-12;

void expectNear(const dvec3& found, const dvec3& wanted, double most, const char* what) {
    EXPECT_LT(glm::length(found - wanted), most)
        << what << ": " << found.x << " " << found.y << " " << found.z << ", wanted " << wanted.x
        << " " << wanted.y << " " << wanted.z;
}

void expectExit(const Exit& exit, const Point& point) {
    EXPECT_TRUE(exit.left);
    expectNear(exit.x, point.x, kNear, "position");
    expectNear(exit.direction, glm::normalize(point.w), kAngle, "direction");
    EXPECT_NEAR(exit.opticalLength, point.opticalLength, kNear);
    EXPECT_LT(exit.drift, kAngle);
}

/// The exit, told from a solution in τ: the first sign change of the distance to the box's faces,
/// found by stepping and bisection. Slower than trace() and with nothing of it.
double tauOfExit(const std::function<dvec3(double)>& at, double step) {
    const auto out = [&](double tau) {
        const dvec3 x = at(tau), past = glm::max(kLow - x, x - kHigh);
        return std::max({past.x, past.y, past.z});
    };
    double low = step, high = 2 * step;
    while (out(high) < 0) low = high, high += step;
    for (int i = 0; i < 80; ++i) (out(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
}

const std::vector<Ray> kRays = {
    {{0, 48, 32}, {1, 0, 0}},      {{0, 20.5, 10}, {1, 0.3, 0.2}}, {{0, 90, 60}, {1, -0.7, -0.5}},
    {{30, 96, 32}, {0.4, -1, 0}},  {{128, 50, 1}, {-1, 0.1, 0.4}}, {{70, 0, 64}, {-0.3, 1, -0.8}},
    {{64, 48, 32}, {0.1, 1, 0.3}}, {{10, 48, 0}, {0.2, -0.05, 1}},
};

} // namespace

TEST(Trace, AStraightRayByHand) {
    // n = 2: a box's diagonal plane, by 3-4-5.
    const Exit exit = trace(linearSquared(4, dvec3(0)), {{0, 0, 32}, {3, 4, 0}}, kLow, kHigh);
    expectNear(exit.x, {72, 96, 32}, 1e-12, "position");
    EXPECT_NEAR(exit.pathLength, 120, 1e-12);
    EXPECT_NEAR(exit.opticalLength, 240, 1e-12);
    EXPECT_EQ(exit.x.y, 96) << "not on the face";
    EXPECT_TRUE(exit.left);
}

TEST(Trace, FromOutsideStraightToTheBoxOrPastIt) {
    const Medium glass = linearSquared(2.25, dvec3(0));
    const Exit exit = trace(glass, {{-30, 18, 32}, {1, 0.5, 0}}, kLow, kHigh);
    expectNear(exit.x, {126, 96, 32}, 1e-12, "position"); // enters at y = 33, not refracted
    EXPECT_NEAR(exit.pathLength, 63 * std::sqrt(5.0), 1e-11) << "counted before the box";
    for (const Ray& past :
         {Ray{{-1, 0, 0}, {0, 1, 0}}, Ray{{-1, 5, 5}, {-1, 0, 0}}, Ray{{-10, 90, 5}, {1, 1, 0}}}) {
        const Exit missed = trace(glass, past, kLow, kHigh);
        EXPECT_EQ(missed.pathLength, 0);
        EXPECT_EQ(missed.x, past.x);
        EXPECT_TRUE(missed.left);
    }
}

TEST(Trace, AStartOnAFaceLeavesAtOnceOrGoesIn) {
    const Medium glass = linearSquared(2.25, dvec3(0));
    EXPECT_EQ(trace(glass, {{0, 9, 9}, {-1, 0.2, 0}}, kLow, kHigh).pathLength, 0);
    EXPECT_NEAR(trace(glass, {{0, 9, 9}, {1, 0, 0}}, kLow, kHigh).pathLength, 128, 1e-11);
    // A parabola up from the floor and back to it, within few steps and, of 0.3 voxel, within one.
    const dvec3 a(0, -0.02, 0);
    for (const double slope : {0.02, 0.002}) {
        const Ray ray{{20, 0, 32}, {1, slope, 0}};
        const double tau = *parabolaTau(2, a, ray, 1, 0);
        EXPECT_NEAR(tau, 2 * std::sqrt(2.0) * slope / std::sqrt(1 + slope * slope) / 0.02, 1e-12);
        expectExit(trace(linearSquared(2, a), ray, kLow, kHigh), parabola(2, a, ray, tau));
    }
}

TEST(Trace, RefusesNonsense) {
    const Medium air = linearSquared(1, dvec3(0));
    EXPECT_THROW(trace(air, {{1, 1, 1}, {0, 0, 0}}, kLow, kHigh), std::invalid_argument);
    EXPECT_THROW(trace(air, {{1, 1, 1}, {1, 0, 0}}, kHigh, kLow), std::invalid_argument);
    Medium torn = air;
    torn.force = [](dvec3 x) { return dvec3(x.x > 40 ? std::nan("") : 0); };
    EXPECT_THROW(trace(torn, {{0, 9, 9}, {1, 0, 0}}, kLow, kHigh), std::runtime_error);
}

TEST(Trace, LinearSquaredIsAParabola) {
    const double n0sq = 3;
    const dvec3 a(0.004, -0.006, 0.003);
    for (const Ray& ray : kRays) {
        double tau = 1e9;
        for (int axis = 0; axis < 3; ++axis)
            for (const double face : {kLow[axis], kHigh[axis]}) {
                if (face == ray.x[axis]) continue; // no ray here turns back to its own face
                if (const auto at = parabolaTau(n0sq, a, ray, axis, face)) tau = std::min(tau, *at);
            }
        const Exit exit = trace(linearSquared(n0sq, a), ray, kLow, kHigh);
        expectExit(exit, parabola(n0sq, a, ray, tau));
        EXPECT_NEAR(exit.pathLength, parabolaLength(n0sq, a, ray, tau), kNear);
    }
}

TEST(Trace, GrinRodIsAHarmonicOscillator) {
    // Two and a half swings along 512 voxels.
    const dvec3 low(0), high(64, 64, 512), centre(32, 32, 0);
    const double n0 = 1.6, g = 2 * pi * 2.5 / 512;
    for (const Ray& ray : {Ray{{32, 32, 0}, {0.1, 0, 1}}, Ray{{40, 27, 0}, {0, 0, 1}},
                           Ray{{22, 36, 0}, {-0.1, 0.2, 1}}, Ray{{40, 36, 512}, {0.2, 0.1, -1}}}) {
        const double z = ray.direction.z > 0 ? 512 : 0;
        expectExit(trace(grinRod(n0, g, centre), ray, low, high), grinRodAt(n0, g, centre, ray, z));
    }
}

TEST(Trace, LuneburgCoreIsAnEllipse) {
    const double radius = 120;
    for (const Ray& ray : kRays) {
        const auto at = [&](double tau) { return luneburgCoreAt(kMiddle, radius, ray, tau); };
        const double tau = tauOfExit([&](double t) { return at(t).x; }, 0.5);
        expectExit(trace(luneburgCore(kMiddle, radius), ray, kLow, kHigh), at(tau));
    }
}

TEST(Trace, LuneburgLensBringsParallelRaysToOnePoint) {
    const double radius = 20;
    const Medium lens = luneburg(kMiddle, radius);
    const dvec3 d = glm::normalize(dvec3(2, 0.3, -0.4));
    const dvec3 u = glm::normalize(glm::cross(d, dvec3(0, 0, 1))), v = glm::cross(d, u);
    int met = 0;
    for (double off = 0; off < 1.2; off += 0.0999)
        for (double angle = 0; angle < 6; angle += 0.7) {
            const dvec3 across = radius * off * (std::cos(angle) * u + std::sin(angle) * v);
            const Ray ray{kMiddle + across - 60.0 * d, d};
            const Exit exit = trace(lens, ray, kLow, kHigh);
            const auto wanted = luneburgExit(kMiddle, radius, ray);
            ASSERT_EQ(wanted.has_value(), off < 1);
            if (!wanted) { // past the lens: straight
                expectNear(exit.direction, d, 1e-15, "direction");
                continue;
            }
            ++met;
            expectNear(wanted->x, kMiddle + radius * d, 1e-12, "focus on paper");
            expectNear(exit.direction, glm::normalize(wanted->w), kAngle, "direction");
            // Back along the exit ray: it passed the focus.
            const dvec3 back = exit.x - wanted->x;
            const double after = glm::dot(back, exit.direction);
            expectNear(back, after * exit.direction, kNear, "focus");
            // The closed form counts from the ray's start, trace() from the box's face.
            const dvec3 steps = (kLow - ray.x) / d;
            const double before = std::max({0.0, steps.x, d.y > 0 ? steps.y : 0});
            EXPECT_NEAR(exit.opticalLength, wanted->opticalLength + after - before, kNear);
        }
    EXPECT_GT(met, 80);
}

TEST(Trace, AGrazedRimIsNotSteppedOver) {
    // 1e-6 of the radius inside the rim: a chord of 0.06 voxel, far shorter than a step in air.
    const double radius = 20, off = 1 - 1e-6;
    const Ray ray{kMiddle + dvec3(-60, radius * off, 0), {1, 0, 0}};
    const Exit exit = trace(luneburg(kMiddle, radius), ray, kLow, kHigh);
    const dvec3 wanted = glm::normalize(luneburgExit(kMiddle, radius, ray)->w);
    EXPECT_GT(glm::length(wanted - dvec3(1, 0, 0)), 1e-3);
    // The edge's place is a rounding of 1e-16 over a slope of √(2e-6) there, and more on the way.
    expectNear(exit.direction, wanted, 1e-9, "direction");
}

TEST(Trace, FishEyeIsACircleOverTenTurns) {
    // Errors grow with the square of the turns (the phase of a mistuned oscillator): a hundred
    // times kNear; direction is that over the circle's radius, above 10.
    const double radius = 20;
    const Medium eye = maxwellFishEye(kMiddle, radius);
    for (const dvec3 d : {dvec3(0, 1, 0), dvec3(0.5, 1, 0.2), dvec3(-0.4, 0.9, -0.3)}) {
        const Ray ray{kMiddle + dvec3(12, 0, 0), d};
        const auto [centre, rho] = fishEyeCircle(kMiddle, radius, ray);
        const Exit exit = trace(eye, ray, kLow, kHigh, 1e-13, 10 * 2 * pi * rho);
        EXPECT_FALSE(exit.left);
        expectNear(exit.x, ray.x, 1e-9, "position");
        expectNear(exit.direction, glm::normalize(d), 1e-10, "direction");
        EXPECT_NEAR(exit.opticalLength, 10 * fishEyePeriod(radius), 1e-9);
        EXPECT_LT(exit.drift, kAngle);
        // Half a turn in optical length is at the image; in between all is on the circle.
        expectNear(fishEyeAt(kMiddle, radius, ray, pi * radius).x,
                   fishEyeImage(kMiddle, radius, ray.x), 1e-12, "image");
        for (double turn = 0.05; turn < 1; turn += 0.1) {
            const Exit part = trace(eye, ray, kLow, kHigh, 1e-13, turn * 2 * pi * rho);
            EXPECT_NEAR(glm::length(part.x - centre), rho, kNear);
            const Point point = fishEyeAt(kMiddle, radius, ray, part.opticalLength);
            expectNear(part.x, point.x, kNear, "position");
            expectNear(part.direction, glm::normalize(point.w), kAngle, "direction");
            EXPECT_NEAR(glm::length(point.w), eye.index(point.x), 1e-13);
        }
    }
}

TEST(Trace, ExponentialLayersTurnARay) {
    const double n0sq = 1.2, gain = 0.8, y0 = 10, scale = 15;
    const Medium layers = layeredExponential(n0sq, gain, y0, scale);
    int turned = 0;
    for (const Ray& ray : {Ray{{0, 60, 32}, {1, -0.5, 0}}, Ray{{0, 90, 10}, {1, -0.8, 0.3}},
                           Ray{{0, 30, 32}, {1, 0, 0}}, Ray{{100, 5, 60}, {-1, 0.2, -0.2}}}) {
        const auto at = [&](double tau) {
            return layeredExponentialAt(n0sq, gain, y0, scale, ray, tau);
        };
        const double tau = tauOfExit([&](double t) { return at(t).x; }, 0.5);
        expectExit(trace(layers, ray, kLow, kHigh), at(tau));
        const dvec3 w = at(0).w;
        if (w.y < 0 && at(tau).w.y > 0) {
            ++turned;
            const double low = layeredExponentialTurn(n0sq, gain, y0, scale, w);
            const auto n = [&](double y) { return layers.index({0, y, 0}); };
            EXPECT_NEAR(turningHeight(n, glm::length(layeredInvariant(w)), 0, 96), low, 1e-11);
        }
    }
    EXPECT_EQ(turned, 2);
}

TEST(Trace, LayersKeepSnellsInvariantAndTheRayItsIndex) {
    const auto n = [](double y) { return 1.4 + 0.2 * std::sin(0.15 * y); };
    const auto slope = [](double y) { return 0.03 * std::cos(0.15 * y); };
    const Medium waves = layered("waves", n, slope, 10);
    for (const Ray& ray : kRays) {
        const Exit exit = trace(waves, ray, kLow, kHigh);
        const dvec3 before = n(ray.x.y) * glm::normalize(ray.direction);
        const dvec3 after = n(exit.x.y) * exit.direction;
        expectNear(layeredInvariant(after), layeredInvariant(before), kAngle, "n cosθ");
        EXPECT_LT(exit.drift, kAngle);
    }
}

TEST(Trace, ABlurredPlaneReflectsTotallyAndRefractsBySnell) {
    // Far from the edge, σ = 2 voxels, the index is that of either side to erfc(10): rounding.
    const Medium plane = step({64, 48, 32}, {0, 1, 0}, 1.5, 1, 2);
    const double critical = std::asin(1 / 1.5);
    for (double theta = 0.3; theta < 1.4; theta += 0.1) {
        const dvec3 d(std::sin(theta), std::cos(theta), 0);
        const Exit exit = trace(plane, {{64, 20, 32}, d}, {-2000, 0, 0}, {2000, 96, 64});
        if (theta > critical) {
            expectNear(exit.direction, {d.x, -d.y, 0}, kAngle, "reflected");
            EXPECT_EQ(exit.x.y, 0);
        } else {
            const double s = 1.5 * d.x;
            expectNear(exit.direction, {s, std::sqrt(1 - s * s), 0}, kAngle, "refracted");
            EXPECT_EQ(exit.x.y, 96);
        }
    }
}

TEST(Trace, AnySphericalIndexKeepsBouguersInvariant) {
    const Medium ball = blob(kMiddle, 18, 1.5, 1.5);
    for (const Ray& ray : kRays) {
        const Exit exit = trace(ball, ray, kLow, kHigh);
        const dvec3 before =
            radialInvariant(kMiddle, ray.x, ball.index(ray.x) * glm::normalize(ray.direction));
        const dvec3 after = radialInvariant(kMiddle, exit.x, ball.index(exit.x) * exit.direction);
        // Lengths of tens of voxels times errors of direction.
        expectNear(after, before, kNear, "n r sinφ");
        EXPECT_LT(exit.drift, kAngle);
    }
}

TEST(Trace, ABlurredBallDeflectsAsAbelsIntegralSays) {
    // Tracing adds up forces in time, quadrature integrates over the radius: nothing is shared.
    const double radius = 18, outer = 31.5;
    for (const double index : {1.5, 0.8})
        for (const double sigma : {1.0, 1.5}) {
            const Profile n = blobIndex(radius, sigma, index);
            const Profile slope = blobSlope(radius, sigma, index);
            const Medium ball = blob(kMiddle, radius, sigma, index);
            for (double b = 0; b < 22; b += 1.37) {
                const Ray ray{kMiddle + dvec3(-64, b, 0), {1, 0, 0}};
                const Exit exit = trace(ball, ray, kLow, kHigh);
                const RadialPass pass = radialPass(n, slope, b, outer);
                const Ray wanted = radialExit(kMiddle, ray, pass, outer);
                // Quadrature to 1e-13 of integrands whose own digits fade towards the turning
                // point, to some 1e-12; the exit is 100 voxels on.
                expectNear(exit.direction, wanted.direction, 1e-11, "direction");
                const dvec3 on = exit.x - wanted.x;
                const double after = glm::dot(on, wanted.direction);
                expectNear(on, after * wanted.direction, 1e-9, "position");
                const double before = 64 - std::sqrt(outer * outer - b * b);
                EXPECT_NEAR(exit.opticalLength, before + pass.opticalLength + after, 1e-9) << b;
            }
        }
}

TEST(Trace, ASmallBallIsNotSteppedOver) {
    // Half a voxel wide in a box of 128, whose longest steps in air are 16.
    const double radius = 0.1, sigma = 0.02, outer = 0.3;
    const RadialPass pass =
        radialPass(blobIndex(radius, sigma, 1.5), blobSlope(radius, sigma, 1.5), 0.06, outer);
    EXPECT_GT(pass.deflection, 0.1);
    for (double x = 5; x < 120; x += 9.7) {
        const dvec3 centre(x, 48, 32);
        const Ray ray{{0, 48.06, 32}, {1, 0, 0}};
        const Exit exit = trace(blob(centre, radius, sigma, 1.5), ray, kLow, kHigh);
        const Ray wanted = radialExit(centre, ray, pass, outer);
        expectNear(exit.direction, wanted.direction, 1e-11, "direction"); // as by Abel's integral
    }
}

TEST(Trace, AbelsIntegralOfTheLuneburgLens) {
    // Known on paper: the deflection of a Luneburg lens is asin(b/R), optical length
    // πR/2 + 2√(R² − b²) less what is straight: here from rim to rim, πR/2 + √(R² − b²).
    const double radius = 20;
    const auto n = [&](double r) { return std::sqrt(2 - r * r / (radius * radius)); };
    const auto slope = [&](double r) { return -r / (radius * radius) / n(r); };
    for (double b = 0; b < 20; b += 1.9) {
        const RadialPass pass = radialPass(n, slope, b, radius);
        EXPECT_NEAR(pass.deflection, std::asin(b / radius), 1e-11);
        EXPECT_NEAR(pass.opticalLength, pi * radius / 2 + std::sqrt(radius * radius - b * b), 1e-9);
        const double under = 1 - std::sqrt(1 - b * b / (radius * radius)); // of r⁴ − 2r² + b² = 0
        EXPECT_NEAR(pass.turningRadius, radius * std::sqrt(under), 1e-11);
    }
}

TEST(Trace, AThinningEdgeNearsSnellsLaw) {
    // Against a sharp ball the deflection's error is of first order in σ: halved with it, but for
    // the second order's share, here below a hundredth.
    const double radius = 20;
    for (const double off : {0.2, 0.5, 0.7}) {
        const double wanted = 2 * (std::asin(off) - std::asin(off / 1.5));
        const auto error = [&](double sigma) {
            const Medium ball = blob(kMiddle, radius, sigma, 1.5);
            const Ray ray{kMiddle + dvec3(-64, off * radius, 0), {1, 0, 0}};
            const Exit exit = trace(ball, ray, kLow, kHigh);
            return std::atan2(-exit.direction.y, exit.direction.x) - wanted;
        };
        const double wide = error(radius / 500), thin = error(radius / 1000);
        EXPECT_NEAR(wide / thin, 2, 0.02) << off;
        EXPECT_LT(std::abs(thin), 4e-3 * wanted) << off; // σ/R, and 4 for what is oblique
    }
}

TEST(Trace, BackwardsAlongTheExitToTheStart) {
    const Medium ball = blob(kMiddle, 18, 1.5, 1.5);
    for (const Ray& ray : kRays) {
        if (ray.x == kMiddle) continue; // a way back would go on to a face
        const Exit exit = trace(ball, ray, kLow, kHigh);
        const Exit back = trace(ball, {exit.x, -exit.direction}, kLow, kHigh);
        expectNear(back.x, ray.x, kNear, "position");
        expectNear(back.direction, -glm::normalize(ray.direction), kAngle, "direction");
        EXPECT_NEAR(back.opticalLength, exit.opticalLength, kNear);
    }
}

TEST(Trace, TheToleranceRulesTheError) {
    // A reference whose error does not follow its tolerance has another error somewhere.
    const double radius = 120;
    const Ray ray = kRays[1];
    const auto at = [&](double tau) { return luneburgCoreAt(kMiddle, radius, ray, tau); };
    const Point wanted = at(tauOfExit([&](double t) { return at(t).x; }, 0.5));
    for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
        const Exit exit = trace(luneburgCore(kMiddle, radius), ray, kLow, kHigh, tolerance);
        // In voxels: a step's error is relative to 64 of them, and some ten steps add up.
        EXPECT_LT(glm::length(exit.x - wanted.x), 640 * tolerance) << tolerance;
    }
}

TEST(Media, ForceIsHalfTheGradientOfTheSquaredIndex) {
    const auto n = [](double y) { return 1.4 + 0.2 * std::sin(0.15 * y); };
    const auto slope = [](double y) { return 0.03 * std::cos(0.15 * y); };
    for (const Medium& medium :
         {linearSquared(3, {0.004, -0.006, 0.003}), grinRod(1.6, 0.01, kMiddle),
          luneburg(kMiddle, 25), luneburgCore(kMiddle, 120), maxwellFishEye(kMiddle, 30),
          layeredExponential(1.2, 0.8, 10, 15), layered("waves", n, slope),
          radial("radial waves", kMiddle, n, slope), blob(kMiddle, 18, 1.5, 1.5),
          step(kMiddle, {1, 2, -1}, 1.5, 1, 2)})
        for (const dvec3 x : {dvec3(60, 50, 30), dvec3(81, 47, 33), dvec3(64, 48, 50.5)})
            for (int axis = 0; axis < 3; ++axis) {
                // Fourth-order differences; h⁴ of the sharpest edge, and roundings over h: 1e-9.
                const double h = 1e-3;
                const auto square = [&](double offset) {
                    dvec3 at = x;
                    at[axis] += offset;
                    return medium.index(at) * medium.index(at);
                };
                const double gradient =
                    (8 * (square(h) - square(-h)) - (square(2 * h) - square(-2 * h))) / (12 * h);
                EXPECT_NEAR(medium.force(x)[axis], 0.5 * gradient, 1e-9) << medium.name;
            }
}
