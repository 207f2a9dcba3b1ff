// Hard cases of an edge between two indices: the critical angle, and rays that graze layers.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;

namespace {

/// Layers along y: n0 below the edge, n1 above it, one voxel thick. The edge has room for its
/// tails: 6 σ below it and 5 σ above, where 3e-7 of it is left.
struct Layers {
    double n0, n1, sigma;
    int length = 1024;

    double middle() const { return std::ceil(6 * sigma) + 2; }
    double top() const { return middle() + std::ceil(5 * sigma); }
    double indexAt(double y) const { return edge(n0, n1, y - middle(), sigma); }
    volume::Volume volume() const {
        TestVolume scene({length, static_cast<int>(top()), 1});
        scene.index([&](dvec3 p) { return indexAt(p.y); });
        return scene.take();
    }
    double criticalAngle() const { return std::asin(n1 / n0); }
    /// What a ray's w² may gain or lose in crossing the edge by steps of h voxels. Central
    /// differences add up to all of n0² − n1² whatever the interpolation; but between voxels the
    /// gradient runs straight and its slope jumps at each by up to 0.2 (n0² − n1²)/σ³, and a step
    /// across such a jump errs by up to h²/8 of it in ½w²: some of them, of either sign. The rest
    /// is floats of n² and the tails.
    double tolerance(double h) const {
        return 0.1 * std::abs(n0 * n0 - n1 * n1) * h * h / (sigma * sigma * sigma) + 4e-6 * n0 * n0;
    }
};

/// Rays from a point below the edge, at even angles (by their tangents) about one from the normal:
/// the first of them steepest.
struct Fan {
    dvec3 eye{2, 2, 0.5};
    double middle, half; // angle from the normal; tangent of the outermost rays' from the middle
    int rays;

    dvec3 forward() const { return {std::sin(middle), std::cos(middle), 0}; }
    dvec3 up() const { return {-std::cos(middle), std::sin(middle), 0}; }
    dvec3 direction(int i) const {
        return glm::normalize(forward() + (1 - (2 * i + 1.0) / rays) * half * up());
    }
    Params params(const Mode& mode) const {
        Params params =
            perspective(eye, eye + forward(), 2 * std::atan(half) * 180 / kPi, {1, rays}, up());
        mode.set(params);
        return params;
    }
};

/// Above the critical angle a ray returns at the mirrored angle, below it passes by Snell's law.
/// Between the two, where its w² along the normal is below the tolerance, it may do either.
void expectSnell(const Layers& layers, const Look& look, const Fan& fan, int i, double tolerance) {
    const dvec3 in = fan.direction(i), out = look.direction(0, i);
    const double along = layers.n0 * in.x; // n sinθ, the same in every layer
    SCOPED_TRACE(testing::Message()
                 << "n sin = " << along << " towards " << layers.n1 << ", ray " << i);
    const double left = layers.n1 * layers.n1 - along * along;
    if (std::abs(left) < tolerance) return;
    const double n = left > 0 ? layers.n1 : layers.n0;
    EXPECT_NEAR(look.place(0, i).y, left > 0 ? layers.top() : 0, 1e-3); // floats of 30 voxels
    const double normal = std::sqrt(n * n - along * along);
    EXPECT_NEAR(n * out.x, along, tolerance / n);
    // Where the ray nearly grazes, an error of w² shows as its root.
    EXPECT_NEAR(n * out.y, left > 0 ? normal : -normal, tolerance / normal);
}

class HardInterface : public testing::TestWithParam<Mode> {};
class HardPreciseInterface : public testing::TestWithParam<Mode> {};

} // namespace

TEST_P(HardPreciseInterface, TotalReflectionBeginsWithin1e4RadiansOfTheCriticalAngle) {
    for (const Layers& layers :
         {Layers{1.5, 1, 4, 2040}, Layers{2.42, 1, 4, 2040}, Layers{1.33, 1, 3, 2040}}) {
        // Two rays at half of ±2e-4.
        const Fan fan{.middle = layers.criticalAngle(), .half = 2e-4, .rays = 2};
        const Look look(layers.volume(), fan.params(GetParam()));
        EXPECT_EQ(look.counter("trapped"), 0);
        const double apart = 2 * layers.n0 * layers.n1 * std::cos(fan.middle) * 1e-4; // of w²
        const double tolerance = layers.tolerance(GetParam().step);
        EXPECT_LT(tolerance, 0.9 * apart) << "the case says nothing";
        for (int i = 0; i < 2; ++i) expectSnell(layers, look, fan, i, tolerance);
    }
}

TEST_P(HardInterface, SnellsLawHoldsOnBothSidesOfTheCriticalAngle) {
    const Mode mode = GetParam();
    always([mode] {
        Layers layers{drawn(1.15, 2.5), 1, drawn(1.5, 3), 512};
        const double scale = drawn(0.5, 1.5); // n1 = 0.5 to 1.5
        layers.n0 *= scale;
        layers.n1 *= scale;
        const Fan fan{
            .middle = layers.criticalAngle(), .half = std::tan(20 * kPi / 180), .rays = 32};
        const Look look(layers.volume(), fan.params(mode));
        for (int i = 0; i < fan.rays; ++i)
            expectSnell(layers, look, fan, i, layers.tolerance(mode.step));
        EXPECT_EQ(look.counter("trapped"), 0);
    });
}

TEST_P(HardInterface, ARayThatGrazesLayersTurnsAndLeavesOnItsOwnSide) {
    // n² = 1.8 − 2 g y: a ray that rises by 1e-3 turns at w_y²/2g, from 5e-5 to 0.1 voxels up,
    // and is back after 2 w_y w_x / g, on a parabola. It enters through the face.
    for (const double g : {0.02, 1e-3, 1e-4, 1e-5}) {
        SCOPED_TRACE(g);
        TestVolume scene({512, 6, 1});
        scene.index([=](dvec3 p) { return std::sqrt(1.8 - 2 * g * p.y); });
        const dvec3 in = glm::normalize(dvec3(1, 1e-3, 0));
        // Where it meets y = 0 is off by the floats of its direction: 6e-8 of 20 / 1e-3 voxels.
        const dvec3 meets(4, 0, 0.5);
        Params params = parallel(meets - 20.0 * in, meets, 1);
        GetParam().set(params);
        const Look look(scene.take(), params);
        const dvec3 out = look.direction(), place = look.place();
        EXPECT_EQ(look.counter("rays"), 1);
        EXPECT_EQ(look.counter("trapped"), 0);
        const double wx = std::sqrt(1.8) * in.x, wy = std::sqrt(1.8) * in.y;
        // A ray that is back at the face within one step leaves at that step's end: by then it has
        // turned by g h/n² more. A gradient of 1e-5 is three differences of rounded floats: 4 %.
        const double late = g * params.step / 1.8;
        EXPECT_LE(out.y, -0.96 * in.y);
        EXPECT_GE(out.y, -1.04 * in.y - late);
        EXPECT_NEAR(out.x, in.x, 1e-6 + late * (late + in.y)); // n cosθ, in floats
        EXPECT_NEAR(place.y, 0, 1e-4);
        const double range = 2 * wx * wy / g;
        EXPECT_NEAR(place.x - meets.x, range, 0.04 * range + params.step + 0.1);
    }
}

TEST_P(HardInterface, ARayThatGrazesAnEdgeIsTurnedByItsTail) {
    // Towards the edge from 3 σ below it, where its tail is 1e-3 of the step, and farther off.
    for (const double below : {3.0, 3.5, 4.0}) {
        SCOPED_TRACE(below);
        const Layers layers{1.5, 1, 2, 2040};
        Fan fan{.middle = kPi / 2 - 1e-3, .half = 1e-4, .rays = 2};
        fan.eye.y = layers.middle() - below * layers.sigma;
        const Params params = fan.params(GetParam());
        const Look look(layers.volume(), params);
        EXPECT_EQ(look.counter("trapped"), 0);
        for (int i = 0; i < 2; ++i) {
            const dvec3 place = look.place(0, i), out = look.direction(0, i);
            EXPECT_LT(place.y, fan.eye.y);
            EXPECT_LT(out.y, 0);
            // It leaves by the floor or by the far end. Differences over two voxels and the
            // straight run between them see the tail widened by up to a voxel²/2: n''/2 more of
            // index.
            const double y = fan.eye.y;
            const double bend =
                layers.indexAt(y - 1) - 2 * layers.indexAt(y) + layers.indexAt(y + 1);
            EXPECT_NEAR(layers.indexAt(place.y) * out.x, layers.indexAt(y) * fan.direction(i).x,
                        0.5 * std::abs(bend) + 2e-5);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, HardInterface, testing::ValuesIn(conservingModes()), modeName);
INSTANTIATE_TEST_SUITE_P(Modes, HardPreciseInterface, testing::ValuesIn(preciseModes()), modeName);
