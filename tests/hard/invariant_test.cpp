// Hard cases of what a ray keeps, by the shaders' own formulae in double and in float.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "float_walk.h"
#include "support/shader_lib.h"

#include <functional>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

using namespace eikonal::shader_lib;
using eikonal::hard::Drift;
using eikonal::hard::walkInFloat;

namespace {

using Field = std::function<vec4(vec3)>; // (½∇(n²), n)
constexpr double kRadius = 8;            // of the fish-eye's unit circle [voxel]
constexpr int kSteps = 10000;

vec4 fishEye(vec3 x) {
    const vec3 p = x / kRadius;
    const double n = 2 / (1 + glm::dot(p, p));
    return {-n * n * n / kRadius * p, n};
}

/// Layers along y whose index falls from 1.8 to 1.1 and rises again, over some twenty voxels.
vec4 layers(vec3 x) {
    const double u = x.y / 20, n = 1.45 + 0.35 * std::cos(u);
    return {0, -n * 0.35 / 20 * std::sin(u), 0, n};
}

Ray stepBy(const Ray& ray, const Field& field, double tau, bool kicksFirst) {
    if (!kicksFirst) return verletStep(ray, field(verletMiddle(ray, tau)), tau);
    Ray next = ray;
    next.w = halfKick(next.w, field(next.x), tau);
    next.x = next.x + tau * next.w;
    next.w = halfKick(next.w, field(next.x), tau);
    return next;
}

Ray startIn(const Field& field, const vec3& place, const vec3& direction) {
    return {place, field(place).w * glm::normalize(direction)};
}

double drawn(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 65537) / 65536.0;
}

} // namespace

RC_GTEST_PROP(HardInvariants, ARayTurnedRoundRetracesItsStepsInDouble, ()) {
    const bool inLayers = *rc::gen::arbitrary<bool>(), kicksFirst = *rc::gen::arbitrary<bool>();
    const Field field = inLayers ? layers : fishEye;
    const Ray first = startIn(field, {drawn(4, 12), drawn(-3, 3), drawn(-3, 3)},
                              {drawn(-1, 1), drawn(-1, 1), drawn(0.1, 1)});
    Ray ray = first;
    for (int i = 0; i < 2000; ++i) ray = stepBy(ray, field, 0.25, kicksFirst);
    RC_ASSERT(glm::length(ray.x - first.x) > 1e-3);
    ray.w = -ray.w;
    for (int i = 0; i < 2000; ++i) ray = stepBy(ray, field, 0.25, kicksFirst);
    // The scheme is its own inverse: only the rounding of 4000 steps is left, 1e-16 of 100 voxels
    // each, which neighbouring rays part with no faster than in proportion to the way.
    RC_ASSERT(glm::length(ray.x - first.x) < 1e-9);
    RC_ASSERT(glm::length(ray.w + first.w) < 1e-9);
}

RC_GTEST_PROP(HardInvariants, InLayersTheComponentAlongThemIsKept, ()) {
    const bool kicksFirst = *rc::gen::arbitrary<bool>();
    Ray ray = startIn(layers, {0, drawn(-30, 30), 0}, {drawn(0.2, 1), drawn(-1, 1), drawn(-1, 1)});
    const Ray first = ray;
    double worst = 0;
    for (int i = 0; i < kSteps; ++i) {
        ray = stepBy(ray, layers, 0.5, kicksFirst);
        worst = std::max(worst, abs(glm::length(ray.w) - layers(ray.x).w));
    }
    RC_ASSERT(ray.w.x == first.w.x); // n cosθ: nothing is ever added to it
    RC_ASSERT(ray.w.z == first.w.z);
    // (τ/20)² of the index's swing and less, for as long as you like.
    RC_ASSERT(worst < 5e-4);
}

TEST(HardInvariants, InAFishEyeTenThousandStepsKeepTheIndexAndTheAngularMomentum) {
    for (const bool kicksFirst : {false, true})
        for (const double tangent : {0.0, 0.3, -0.8}) {
            Ray ray = startIn(fishEye, {kRadius, 0, 0}, {tangent, 1, 0.5});
            const vec3 momentum = glm::cross(ray.x, ray.w); // n r sinφ and the orbit's plane
            double early = 0, late = 0, turned = 0;
            for (int i = 0; i < kSteps; ++i) {
                ray = stepBy(ray, fishEye, 0.25, kicksFirst);
                const double drift = abs(glm::length(ray.w) - fishEye(ray.x).w);
                double& worst = i < kSteps / 10 ? early : late;
                worst = std::max(worst, drift);
                turned = std::max(turned, glm::length(glm::cross(ray.x, ray.w) - momentum));
            }
            // (τ/a)²/8 of the index, 1.2e-4, twice that where the circle comes near the middle; and
            // no more in the last nine tenths of the way than in the first.
            EXPECT_LT(early, 1e-3) << tangent;
            EXPECT_LT(late, 1.05 * early) << tangent;
            // Kicks along the radius and drifts along w both keep x × w: 10,000 roundings of 10.
            EXPECT_LT(turned, 1e-11) << tangent;
        }
}

TEST(HardInvariants, InFloatTenThousandStepsDriftByRoundingAlone) {
    for (const bool kicksFirst : {false, true})
        for (const double tangent : {0.0, 0.3, -0.8}) {
            const Drift drift = walkInFloat(kRadius, tangent, 0.25, kSteps, kicksFirst);
            // The scheme's own 1e-3 as in double; 10,000 roundings of 6e-8 the same way are 6e-4.
            EXPECT_LT(drift.index, 1e-3 + 6e-4) << tangent;
            // As many of n r sinφ, which is 8.
            EXPECT_LT(drift.angularMomentum, 8 * 6e-4) << tangent;
        }
}
