// Curved viewing rays against media that are solved on paper, and how errors shrink with the step.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

/// n² = n0² − a² r² about the z axis through the middle of x and y: a harmonic oscillator.
constexpr double kIndex = 1.6, kPull = 0.08;

volume::Volume rod() {
    TestVolume scene({17, 17, 40});
    scene.index([](dvec3 p) {
        const double x = p.x - 8.5, y = p.y - 8.5;
        return std::sqrt(kIndex * kIndex - kPull * kPull * (x * x + y * y));
    });
    return scene.take();
}

struct Exit {
    dvec3 place, direction;
};

/// Where a ray along −z that enters at (x, y) from the axis leaves the rod.
Exit rodExit(double x, double y) {
    const double n = std::sqrt(kIndex * kIndex - kPull * kPull * (x * x + y * y));
    const double phase = kPull * 40 / n; // w_z = −n throughout
    const dvec3 w(-kPull * x * std::sin(phase), -kPull * y * std::sin(phase), -n);
    return {{8.5 + x * std::cos(phase), 8.5 + y * std::cos(phase), 0}, glm::normalize(w)};
}

/// Rays along −z through voxel centres, 17 of them across.
Params alongRod(double step, Integrator integrator) {
    Params params = parallel({8.5, 8.5, 100}, {8.5, 8.5, 0}, 17, {17, 17});
    params.step = step;
    params.integrator = integrator;
    return params;
}

double rodError(
    double step, Integrator integrator,
    const std::function<void(Params&)>& modify = [](Params&) {}) {
    Params params = alongRod(step, integrator);
    modify(params);
    const Look look(rod(), params);
    double worst = 0;
    for (int y = 4; y < 13; ++y)
        for (int x = 4; x < 13; ++x)
            worst = std::max(worst, glm::length(look.place(x, y) - rodExit(x - 8, 8 - y).place));
    return worst;
}

/// The Luneburg lens of radius 14 in 32³ voxels: parallel rays meet in a point of its rim.
double luneburgError(double step, Integrator integrator) {
    TestVolume scene(ivec3(32));
    scene.index([](dvec3 p) {
        const double r = glm::length(p - 16.0) / 14;
        return std::sqrt(2 - std::min(r * r, 1.0));
    });
    Params params = parallel({16, 16, 100}, dvec3(16), 32, {32, 32});
    params.step = step;
    params.integrator = integrator;
    const Look look(scene.take(), params);
    double worst = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double impact = std::hypot(x - 15.5, y - 15.5) / 14;
            if (impact > 0.7) continue; // where the lens's kink at the rim is met at grazing
            const dvec3 focus(16, 16, 2), d = look.direction(x, y);
            const dvec3 off = look.place(x, y) - focus;
            worst = std::max(worst, glm::length(off - glm::dot(off, d) * d) / 28);
        }
    return worst;
}

} // namespace

TEST(ViewCurved, AGradedRodSwingsRaysAboutItsAxis) {
    const Look look(rod(), alongRod(0.25, Integrator::verlet));
    for (int y = 4; y < 13; ++y)
        for (int x = 4; x < 13; ++x) {
            const Exit wanted = rodExit(x - 8, 8 - y);
            // (a dτ)²/24 of the phase a step, over 2 radians: 1e-5 of 8 voxels; floats as much.
            expectNear(look.place(x, y), wanted.place, 3e-4);
            expectNear(look.direction(x, y), wanted.direction, 3e-5);
            // The drift of |w| from n: n is read between voxels, where it is off by n''/8.
            EXPECT_LT(look.at("error.V", x, y), 1e-3);
            EXPECT_EQ(look.at("A", x, y), x == 8 && y == 8 ? 0 : 1);
        }
}

TEST(ViewCurved, ALinearIndexSquaredGivesAParabolaInAnyStep) {
    // n² = 1.8 + 0.04 (y − 8): dw/dτ is 0.02 along y, and Verlet's scheme is exact.
    for (const double step : {0.5, 4.0}) {
        TestVolume scene({32, 16, 4});
        scene.index([](dvec3 p) { return std::sqrt(1.8 + 0.04 * (p.y - 8)); });
        Params params = parallel({-40, 8, 2}, {0, 8, 2}, 16, {1, 16});
        params.step = step;
        const Look look(scene.take(), params);
        for (int row = 5; row < 14; ++row) {
            const double y = 15.5 - row, n = std::sqrt(1.8 + 0.04 * (y - 8));
            const double tau = 32 / n; // w_x = n throughout
            const dvec3 wanted(32, y + 0.01 * tau * tau, 2);
            if (wanted.y > 15) continue;
            // Float gradients of n² from n: 1e-7 of 1.8 in 0.04 is 5e-6, of 8 voxels' bending.
            expectNear(look.place(0, row), wanted, 2e-4);
            expectNear(look.direction(0, row), glm::normalize(dvec3(n, 0.02 * tau, 0)), 2e-5);
        }
    }
}

TEST(ViewCurved, ALuneburgLensFocusesOnItsRim) {
    // In voxels 28 a diameter its index is smooth but for the rim, where the gradient jumps: what
    // is left is the rim's kink spread over two voxels. Twice what was measured.
    EXPECT_LT(luneburgError(0.25, Integrator::verlet), 0.006);
}

TEST(ViewCurved, StepsAreOfTheOrderTheyClaim) {
    // The field is smooth and its voxels exact in n², so that only floats, at 2e-5 voxels, bound
    // the errors from below; a step of 8 voxels is 0.4 of the oscillation's radian.
    const double e1 = rodError(1, Integrator::euler), e2 = rodError(0.5, Integrator::euler),
                 e3 = rodError(0.25, Integrator::euler);
    EXPECT_NEAR(std::log2(e1 / e2), 1, 0.15) << e1 << " " << e2;
    EXPECT_NEAR(std::log2(e2 / e3), 1, 0.15) << e2 << " " << e3;
    // Störmer and Verlet's own order is the second, once their field is corrected the fourth.
    const auto plain = [](Params& params) { params.plainSamples = true; };
    const double v4 = rodError(4, Integrator::verlet, plain),
                 v2 = rodError(2, Integrator::verlet, plain),
                 v1 = rodError(1, Integrator::verlet, plain);
    EXPECT_NEAR(std::log2(v4 / v2), 2, 0.1) << v4 << " " << v2;
    EXPECT_NEAR(std::log2(v2 / v1), 2, 0.1) << v2 << " " << v1;
    EXPECT_LT(20 * v1, e1);
    const auto cubic = [](Params& params) { params.interpolation = Interpolation::cubic; };
    for (const Integrator integrator : {Integrator::verlet, Integrator::sharma, Integrator::rk4}) {
        const double s8 = rodError(8, integrator, cubic), s4 = rodError(4, integrator, cubic);
        EXPECT_GE(std::log2(s8 / s4), 3.8) << s8 << " " << s4;
        EXPECT_LT(s4, 2e-4);
    }
}

TEST(ViewCurved, ATighterToleranceIsKept) {
    for (const double tolerance : {1.0, 0.1, 0.01, 1e-3}) {
        const double error = rodError(0, Integrator::adaptive,
                                      [=](Params& params) { params.tolerance = tolerance; });
        EXPECT_LT(error, tolerance);
    }
}

TEST(ViewCurved, EqualKicksAreNotRoundedTheSameWayEveryTime) {
    // n² = 1.8 + 0.003 (y − 24): on a spline each of some 1400 steps kicks w_y by the same 3e-4,
    // which a float beside w_y of up to 0.3 rounds to the same side for long. Of 28 voxels' bending
    // that is 6e-4 voxels if it is lost, and half as much, from the samples' own floats, if the
    // next step has it.
    TestVolume scene({256, 48, 4});
    scene.index([](dvec3 p) { return std::sqrt(1.8 + 0.003 * (p.y - 24)); });
    Params params = parallel({-40, 5, 2}, {0, 5, 2}, 2, {1, 8});
    params.interpolation = Interpolation::cubic;
    params.step = 0.25;
    const Look look(scene.take(), params);
    double squares = 0;
    for (int row = 0; row < 8; ++row) {
        const double y = 5 + 0.125 * (3.5 - row) * 2, square = 1.8 + 0.003 * (y - 24);
        const double tau = 256 / std::sqrt(square);
        const dvec3 off = look.place(0, row) - dvec3(256, y + 0.00075 * tau * tau, 2);
        squares += glm::dot(off, off);
    }
    EXPECT_LT(std::sqrt(squares / 8), 4e-4);
}

TEST(ViewCurved, LightIsGatheredAlongTheCurve) {
    // A ray of the parabola above: its length is ∫ n dτ, and L/n² gains ε ∫ dτ / n.
    TestVolume scene({32, 16, 4});
    scene.index([](dvec3 p) { return std::sqrt(1.8 + 0.04 * (p.y - 8)); });
    scene.constantVector("emission", dvec3(0.1));
    Params params = parallel({-40, 8, 2}, {0, 8, 2}, 1);
    params.step = 0.25;
    const Look look(scene.take(), params);
    const double tau = 32 / std::sqrt(1.8);
    double length = 0, optical = 0, light = 0;
    const int kParts = 1000;
    for (int i = 0; i < kParts; ++i) { // by midpoints: 1e-6 off
        const double t = (i + 0.5) * tau / kParts, n = std::sqrt(1.8 + 0.04 * 0.01 * t * t);
        length += n * tau / kParts;
        optical += n * n * tau / kParts;
        light += 0.1 / n * tau / kParts;
    }
    // Midpoints of a quarter voxel, n read between voxels of curvature 1e-4: 2e-5 of it.
    EXPECT_NEAR(look.at("path_length.V"), length, 1e-4 * length);
    EXPECT_NEAR(look.at("optical_path_length.V"), optical, 1e-4 * optical);
    EXPECT_NEAR(look.at("R"), light, 1e-4 * light);
}

TEST(ViewCurved, RaysOutOfStepsAreCounted) {
    Params params = alongRod(1, Integrator::verlet);
    params.maxSteps = 5;
    params.background = dvec3(1);
    const Look look(rod(), params);
    EXPECT_EQ(look.counter("rays"), 17 * 17);
    EXPECT_EQ(look.counter("trapped"), 17 * 17);
    EXPECT_EQ(look.at("steps.V", 3, 3), 5);
    EXPECT_EQ(look.at("A", 3, 3), 1);
    EXPECT_NEAR(look.at("R", 3, 3), 1, 1e-6); // what it would see going on: n²/n²
    const Look free(rod(), alongRod(1, Integrator::verlet));
    EXPECT_EQ(free.counter("trapped"), 0);
}

TEST(ViewCurved, TwoPicturesAreTheSame) {
    const Look a(rod(), alongRod(1, Integrator::verlet)), b(rod(), alongRod(1, Integrator::verlet));
    EXPECT_EQ(a.picture.pixels, b.picture.pixels);
    EXPECT_EQ(a.stats.counters, b.stats.counters);
}

TEST(ViewCurved, NothingMakesANaN) {
    // Wild but valid: an index from 0.01 to 100 in neighbouring voxels, sharp lobes, no light.
    for (const auto integrator : {Integrator::euler, Integrator::verlet})
        for (const double step : {0.1, 1.0, 1000.0}) {
            TestVolume scene(ivec3(8));
            scene.index([](dvec3 p) {
                const int parity =
                    static_cast<int>(p.x) + static_cast<int>(p.y * 3) + static_cast<int>(p.z * 5);
                return parity % 3 == 0 ? 0.01 : parity % 3 == 1 ? 1 : 100;
            });
            scene.addVector("scattering", [](dvec3 p) { return dvec3(p.x > 4 ? 1e6 : 0); });
            scene.addVector("fluence", [](dvec3 p) { return dvec3(p.y > 4 ? 1e3 : 0); });
            scene.constant("anisotropy", 0.9999);
            scene.addVector("light_direction", [](dvec3 p) { return dvec3(p.z > 4, 0, 0); });
            scene.add("opacity", [](dvec3 p) { return p.z < 1 && p.x < 2 ? 1 : 0; });
            Params params = perspective({20, 4, 4}, dvec3(4), 60, {16, 16});
            params.integrator = integrator;
            params.step = step;
            params.maxSteps = 2000;
            const Look look(scene.take(), params); // which checks every sample
            EXPECT_GT(look.counter("rays"), 0);
        }
}
