// What the hard cases share: ways to trace a ray, media with an edge, numbers drawn at random.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/lit.h"
#include "support/look.h"

#include <numbers>
#include <rapidcheck/gtest.h>

namespace eikonal::hard {

constexpr double kPi = std::numbers::pi;

/// A way to trace viewing rays; cases run under each of a list of them.
struct Mode {
    std::string name;
    std::function<void(view::Params&)> set;
    double step = 1; ///< [voxel] that its errors are those of; 0: floats alone
};

inline std::ostream& operator<<(std::ostream& out, const Mode& mode) {
    return out << mode.name;
}

inline Mode mode(const std::string& name, view::Integrator integrator, double step) {
    return {name,
            [=](view::Params& params) {
                params.integrator = integrator;
                params.step = step;
            },
            step};
}

/// On splines.
inline Mode cubicMode(const std::string& name, view::Integrator integrator, double step) {
    return {name,
            [=](view::Params& params) {
                params.integrator = integrator;
                params.interpolation = view::Interpolation::cubic;
                params.step = step;
            },
            step};
}

/// As exact as fixed steps of that length, or exact but for floats.
inline Mode adaptiveMode(const std::string& name, double tolerance, double step) {
    return {name,
            [=](view::Params& params) {
                params.integrator = view::Integrator::adaptive;
                params.tolerance = tolerance;
            },
            step};
}

/// Those that keep |w| = n through an edge some voxels wide.
inline std::vector<Mode> conservingModes() {
    return {mode("verlet", view::Integrator::verlet, 1),
            mode("verletFine", view::Integrator::verlet, 0.25),
            cubicMode("verletCubic", view::Integrator::verlet, 1),
            cubicMode("sharma", view::Integrator::sharma, 1),
            cubicMode("rk4", view::Integrator::rk4, 1),
            adaptiveMode("adaptive", 0.01, 1)};
}

/// Those that err by less than 1e-3 of a voxel where the index is smooth.
inline std::vector<Mode> preciseModes() {
    return {mode("verletFine", view::Integrator::verlet, 0.0625),
            cubicMode("sharmaFine", view::Integrator::sharma, 0.0625),
            adaptiveMode("adaptiveFine", 1e-4, 0)};
}

inline std::vector<Mode> allModes() {
    std::vector<Mode> modes = conservingModes();
    modes.push_back(mode("eulerFine", view::Integrator::euler, 0.25));
    return modes;
}

/// For INSTANTIATE_TEST_SUITE_P.
inline std::string modeName(const testing::TestParamInfo<Mode>& info) {
    return info.param.name;
}

/// From `before` to `after` as an error function of that width, σ; `depth` beyond the middle.
inline double edge(double before, double after, double depth, double sigma) {
    return before + 0.5 * (after - before) * std::erfc(-depth / (sigma * std::sqrt(2.0)));
}

/// A ball of index `inside` in `outside`, in the middle of a cube of `size` voxels.
inline TestVolume ballIn(int size, double radius, double inside, double outside,
                         double sigma = 1.5) {
    TestVolume scene{glm::ivec3(size)};
    scene.index(
        [=](glm::dvec3 p) {
            return edge(outside, inside, radius - glm::length(p - 0.5 * size), sigma);
        },
        outside);
    return scene;
}

/// Maxwell's fish-eye about the middle of a cube: every ray is a circle.
inline TestVolume fishEye(int size, double radius) {
    TestVolume scene{glm::ivec3(size)};
    scene.index([=](glm::dvec3 p) {
        const glm::dvec3 d = (p - 0.5 * size) / radius;
        return 2 / (1 + glm::dot(d, d));
    });
    return scene;
}

/// A property as a gtest: it holds for all examples drawn, and a failure tells them.
template<typename Property> void always(const Property& property) {
    rc::detail::checkGTest([&] {
        property();
        RC_ASSERT(!testing::Test::HasFailure());
    });
}

/// A number in [low, high], of 2^16 + 1.
inline double drawn(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 65537) / 65536.0;
}

/// One of a range of many magnitudes.
inline double drawnByMagnitude(double low, double high) {
    return std::exp(drawn(std::log(low), std::log(high)));
}

inline glm::dvec3 drawnDirection() {
    const double z = drawn(-1, 1), angle = drawn(0, 2 * kPi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A direction across d.
inline glm::dvec3 across(const glm::dvec3& d) {
    const glm::dvec3 other = std::abs(d.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(d, other));
}

} // namespace eikonal::hard
