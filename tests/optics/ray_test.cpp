// The ray steps in double: exact where they must be, and of the order they claim.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shader_lib.h"

#include <functional>
#include <gtest/gtest.h>

using namespace eikonal::shader_lib;

namespace {

using Field = std::function<vec4(vec3)>; // (½∇(n²), n)

Ray verlet(Ray ray, const Field& field, double length, int steps) {
    const double tau = length / steps;
    for (int i = 0; i < steps; ++i) ray = verletStep(ray, field(verletMiddle(ray, tau)), tau);
    return ray;
}

Ray kicked(Ray ray, const Field& field, double length, int steps) {
    const double tau = length / steps;
    for (int i = 0; i < steps; ++i) {
        ray.w = halfKick(ray.w, field(ray.x), tau);
        ray.x = ray.x + tau * ray.w;
        ray.w = halfKick(ray.w, field(ray.x), tau);
    }
    return ray;
}

/// Euler's steps are even in s; a ray that stays in the plane z = z₀ of a field that does not
/// change along z covers s with dτ = ds/n, so that steps of n τ are even in τ.
Ray euler(Ray ray, const Field& field, double length, int steps) {
    for (int i = 0; i < steps; ++i) {
        const vec4 sample = field(ray.x);
        ray = eulerStep(ray, sample, sample.w * length / steps);
    }
    return ray;
}

/// n² = n₀² + 2 a · x
vec4 linearField(vec3 x) {
    const vec3 a(0.05, -0.02, 0.01);
    return {a, std::sqrt(1.69 + 2 * glm::dot(a, x))};
}

/// A GRIN rod along z, n² = n₀² (1 − g² (x² + y²)): x and y are oscillators of frequency n₀ g in τ.
constexpr double kN0 = 1.5, kG = 0.2;
vec4 rod(vec3 x) {
    const double k = kN0 * kN0 * kG * kG;
    return {-k * x.x, -k * x.y, 0, kN0 * std::sqrt(1 - kG * kG * (x.x * x.x + x.y * x.y))};
}

const Ray kRodRay{{1, 0.3, 0}, {0.1, 0.2, std::sqrt(kN0* kN0*(1 - kG * kG * 1.09) - 0.05)}};

Ray rodSolution(double tau) {
    const double f = kN0 * kG, c = std::cos(f * tau), s = std::sin(f * tau);
    const Ray r = kRodRay;
    return {{r.x.x * c + r.w.x * s / f, r.x.y * c + r.w.y * s / f, r.w.z * tau},
            {r.w.x * c - r.x.x * f * s, r.w.y * c - r.x.y * f * s, r.w.z}};
}

/// ∫ n² dτ along it: n₀² τ less f² ∫ r² dτ, axis by axis.
double rodOptical(double tau) {
    const double f = kN0 * kG, c = std::cos(f * tau), s = std::sin(f * tau);
    const auto squares = [&](double x, double w) { // ∫ (x cos + w/f sin)² dτ
        const double v = w / f;
        return 0.5 * (x * x + v * v) * tau + 0.5 * (x * x - v * v) * s * c / f + x * v * s * s / f;
    };
    const Ray r = kRodRay;
    return kN0 * kN0 * tau - f * f * (squares(r.x.x, r.w.x) + squares(r.x.y, r.w.y));
}

double errorOf(const Ray& a, const Ray& b) {
    return glm::length(a.x - b.x) + glm::length(a.w - b.w);
}

/// log₂ of the error's ratio as the steps are halved.
double orderOf(const std::function<Ray(int)>& trace, const Ray& exact) {
    return std::log2(errorOf(trace(200), exact) / errorOf(trace(400), exact));
}

struct Traced {
    Ray ray;
    double optical = 0;
};

/// Equal steps of the schemes that look up several times.
Traced staged(const std::function<Step(Ray, double)>& step, double length, int steps) {
    theField = rod;
    Traced traced{kRodRay};
    for (int i = 0; i < steps; ++i) {
        const Step next = step(traced.ray, length / steps);
        traced.optical += opticalOf(traced.ray, next);
        traced.ray = next.end;
    }
    return traced;
}

/// The rod's potential as Verlet steps of tau should see it, U + τ²/24 |∇U|²: the same oscillator,
/// a little softer.
vec4 softRod(vec3 x, double tau) {
    const double k = kN0 * kN0 * kG * kG;
    const vec4 field = rod(x);
    return {(1 - k * tau * tau / 12) * vec3(field), field.w};
}

/// A run of equal Verlet steps with what is due at its ends.
Traced corrected(double length, int steps) {
    const double tau = length / steps, k = kN0 * kN0 * kG * kG;
    const auto force = [&](const Ray& r) { return vec3(softRod(r.x, tau)); };
    const auto bend = [&](const Ray& r) { return -k * vec3(r.w.x, r.w.y, 0); };
    Traced traced{kRodRay};
    Ray& ray = traced.ray;
    const Ray start = ray;
    traced.optical += verletEnd(ray.w, force(ray), tau, start.w);
    ray = toVerlet(ray, force(ray), bend(ray), tau);
    for (int i = 0; i < steps; ++i) {
        const Ray next = verletStep(ray, softRod(verletMiddle(ray, tau), tau), tau);
        traced.optical += verletExcess(ray.w, next.w, tau, start.w);
        ray = next;
    }
    ray = fromVerlet(ray, force(ray), bend(ray), tau);
    traced.optical -= verletEnd(ray.w, force(ray), tau, start.w);
    traced.optical += glm::dot(start.w, ray.x - start.x);
    return traced;
}

/// The orders of position and optical path length, log₂ of the errors' ratio from 40 to 80 steps.
void expectOrder(const std::function<Traced(int)>& trace, double tau, double order) {
    const Traced coarse = trace(40), fine = trace(80);
    const Ray exact = rodSolution(tau);
    const double position = std::log2(errorOf(coarse.ray, exact) / errorOf(fine.ray, exact));
    const double optical = std::log2(std::abs(coarse.optical - rodOptical(tau)) /
                                     std::abs(fine.optical - rodOptical(tau)));
    // f τ/n is 0.09: the next order is some per cent.
    EXPECT_GT(position, order - 0.2);
    EXPECT_GT(optical, order - 0.2);
    EXPECT_LT(errorOf(fine.ray, exact), 2e-5);
}

} // namespace

TEST(RaySteps, VerletIsExactWhereTheSquaredIndexIsLinear) {
    const vec3 a(0.05, -0.02, 0.01);
    const Ray start{{0, 0, 0}, {0.5, 1.2, 0}};
    for (const int steps : {1, 3, 100}) {
        const double tau = 3;
        const Ray end = verlet(start, linearField, tau, steps);
        const Ray other = kicked(start, linearField, tau, steps);
        // The parabola x₀ + w₀ τ + ½ a τ², to double's rounding over a hundred steps.
        const Ray exact{start.x + tau * start.w + 0.5 * tau * tau * a, start.w + tau * a};
        EXPECT_LT(errorOf(end, exact), 1e-13) << steps;
        EXPECT_LT(errorOf(other, exact), 1e-13) << steps;
        // |w| = n holds there as well: 1.3 at the start, by the field at the end.
        EXPECT_NEAR(glm::length(end.w), linearField(end.x).w, 1e-13);
    }
}

TEST(RaySteps, VerletIsOfSecondOrderOnAGrinRod) {
    const double tau = 12; // half a period and more: f τ = 3.6
    const auto drift = [&](int n) { return verlet(kRodRay, rod, tau, n); };
    const auto kick = [&](int n) { return kicked(kRodRay, rod, tau, n); };
    // At these steps, f τ/n = 0.018, the next order is 1e-4 of the error.
    EXPECT_NEAR(orderOf(drift, rodSolution(tau)), 2, 0.01);
    EXPECT_NEAR(orderOf(kick, rodSolution(tau)), 2, 0.01);
    EXPECT_LT(errorOf(drift(400), rodSolution(tau)), 1e-4); // f³τ³/24n² and its like
}

TEST(RaySteps, EulerIsOfFirstOrderOnAGrinRod) {
    const double tau = 12;
    // The next order is f² τ/2n = 0.5 % of the error.
    EXPECT_NEAR(orderOf([&](int n) { return euler(kRodRay, rod, tau, n); }, rodSolution(tau)), 1,
                0.05);
}

TEST(RaySteps, StagesAreOfFourthOrderAndSoAreCorrectedVerletSteps) {
    const double tau = 12;
    expectOrder([&](int n) { return staged(sharmaStep, tau, n); }, tau, 4);
    expectOrder([&](int n) { return staged(rk4Step, tau, n); }, tau, 4);
    expectOrder([&](int n) { return corrected(tau, n); }, tau, 4);
    const auto embedded = [](Ray ray, double h) { return embeddedStep(ray, rod(ray.x), h); };
    expectOrder([&](int n) { return staged(embedded, tau, n); }, tau, 4);
}

TEST(RaySteps, AnEmbeddedStepKnowsItsError) {
    theField = rod;
    // Steps of 0.06 to 0.5 of the oscillator's radian: never less than the error is, nor so much
    // more that the steps would be three times too short.
    for (const double tau : {1.6, 0.8, 0.4, 0.2}) {
        const Step step = embeddedStep(kRodRay, rod(kRodRay.x), tau);
        const Ray exact = rodSolution(tau);
        const double off = glm::length(step.end.x - exact.x) + glm::length(step.end.w - exact.w);
        EXPECT_GT(step.errorX + step.errorW, off) << tau;
        EXPECT_LT(step.errorX + step.errorW, 243 * off) << tau;
    }
}

TEST(RaySteps, TheInterpolantFollowsTheRayWithinAStep) {
    const double tau = 0.4;
    const Ray end = rodSolution(tau);
    for (const double f : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const Ray there = between(kRodRay, end, tau, f), exact = rodSolution(f * tau);
        // A cubic by both ends is off by τ⁴/384 times the fourth derivative, 0.008, at most; its
        // slope by some ten times that over τ.
        EXPECT_NEAR(glm::length(there.x - exact.x), 0, 1e-6) << f;
        EXPECT_NEAR(glm::length(there.w - exact.w), 0, 2e-5) << f;
    }
    EXPECT_LT(errorOf(between(kRodRay, end, tau, 0), kRodRay), 1e-15);
    EXPECT_LT(errorOf(between(kRodRay, end, tau, 1), end), 1e-14);
}

TEST(Spline, WeightsReproduceCubics) {
    for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const vec4 w = splineWeights(t), s = splineSlopes(t);
        EXPECT_NEAR(w.x + w.y + w.z + w.w, 1, 1e-15);
        EXPECT_NEAR(s.x + s.y + s.z + s.w, 0, 1e-15);
        // Coefficients i³ − i are those of the cubic x³: c = f − f''/6.
        const vec4 c(0, 0, 0, 6); // at −1, 0, 1, 2
        EXPECT_NEAR(glm::dot(c, w), t * t * t, 1e-15);
        EXPECT_NEAR(glm::dot(c, s), 3 * t * t, 1e-14);
    }
}

TEST(RaySteps, VerletKeepsItsIndexOverManyTurnsWhereEulerLosesIt) {
    // 100 periods at 40 steps each. Symplectic: |w| − n stays of the order (f dτ)²/8 = 3e-3 of the
    // transverse part; Euler grows by (1 + (f dτ)²)^(n/2), e^49 here, and is lost.
    const double tau = 100 * 2 * 3.141592653589793 / (kN0 * kG);
    const Ray end = verlet(kRodRay, rod, tau, 4000);
    EXPECT_NEAR(glm::length(end.w), rod(end.x).w, 1e-3);
    const Ray lost = euler(kRodRay, rod, tau / 10, 400);
    EXPECT_FALSE(std::abs(glm::length(lost.w) - rod(lost.x).w) < 0.1);
}
