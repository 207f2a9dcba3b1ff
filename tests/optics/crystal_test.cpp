// Uniaxial crystals: the shaders' text in double and in float, against paper and an independent
// solve. SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/crystal.h"
#include "optics/crystal_float.h"
#include "support/shader_lib.h"

#include <gtest/gtest.h>
#include <random>

using namespace eikonal::shader_lib;
namespace single = eikonal::shader_lib_float;

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kDegree = kPi / 180;

double square(double x, double y) {
    return x * x + y * y;
}

/// Shares beyond in o and e, and back in o and e.
vec4 sharesOf(const Parts& parts) {
    return {square(parts.on.x, parts.on.y), square(parts.on.z, parts.on.w),
            square(parts.back.x, parts.back.y), square(parts.back.z, parts.back.w)};
}

double sum(const vec4& v) {
    return v.x + v.y + v.z + v.w;
}

class Draw {
public:
    double operator()(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(mEngine);
    }
    vec3 axis() {
        std::normal_distribution<double> normal;
        return glm::normalize(vec3(normal(mEngine), normal(mEngine), normal(mEngine)));
    }
    Uniaxial crystal() { return {(*this)(1.2, 2.8), (*this)(1.2, 2.8), axis()}; }
    /// Isotropic, as the library takes it.
    Uniaxial glass() {
        const double n = (*this)(1, 2.5);
        return {n, n, {0, 1, 0}};
    }
    Uniaxial any() { return (*this)(0, 1) < 0.3 ? glass() : crystal(); }

private:
    std::mt19937 mEngine{7};
};

/// The largest q at which a wave of that mode goes on.
double mostAlong(const Uniaxial& m, bool extraordinary) {
    if (!extraordinary) return m.o;
    const double g = (m.e * m.e - m.o * m.o) / (m.o * m.o);
    const double A = 1 + g * m.axis.z * m.axis.z;
    return std::sqrt(A * m.e * m.e / (1 + g * (1 - m.axis.y * m.axis.y)));
}

/// How far from 1 shares add up in float at most, as they are solved and as they are used.
struct Worst {
    double solved = 0, used = 0;
    void take(const Uniaxial& near, const Uniaxial& beyond, double q, bool e) {
        const single::Sums sums = single::sumsInFloat({near.o, near.e, near.axis},
                                                      {beyond.o, beyond.e, beyond.axis}, q)[e];
        solved = std::max(solved, std::abs(sums.solved - 1));
        used = std::max(used, std::abs(sums.used - 1));
    }
};

} // namespace

TEST(Crystal, WalkOffOfCalciteCutAt45Degrees) {
    const Uniaxial calcite{1.6584, 1.4864, {0, 0, 1}};
    const vec3 k = vec3(std::sqrt(0.5), 0, std::sqrt(0.5)); // its length does not count
    const vec3 ray = rayDirection(calcite, kExtraordinary, k);
    // tan of the ray's angle with the axis is n_o²/n_e² tan of k's.
    const double r = 1.6584 / 1.4864;
    const double expected = std::atan(r * r) / kDegree - 45;
    EXPECT_NEAR(std::acos(ray.z) / kDegree - 45, expected, 1e-10);
    EXPECT_NEAR(expected, 6.2241, 5e-5); // the published figure
    EXPECT_NEAR(glm::length(rayDirection(calcite, kOrdinary, k) - k), 0, 1e-15);
}

TEST(Crystal, RaysAndWaveVectorsAreTheSameThing) {
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const Uniaxial m = draw.crystal();
        const vec3 d = draw.axis();
        const vec3 k = waveVector(m, kExtraordinary, d);
        const double along = glm::dot(k, m.axis);
        EXPECT_NEAR(along * along / (m.o * m.o) + (glm::dot(k, k) - along * along) / (m.e * m.e), 1,
                    1e-13);
        EXPECT_NEAR(glm::length(rayDirection(m, kExtraordinary, k) - d), 0, 1e-13);
        // Appendix A's t ∝ ε k of source 004, in other words: k·t is the ray's index.
        EXPECT_NEAR(glm::length(waveVector(m, kOrdinary, d) - m.o * d), 0, 1e-15);
    }
}

TEST(Crystal, AbsorptionIsThatOfAComplexIndex) {
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const Uniaxial m = draw.crystal();
        const vec3 direction = draw.axis();
        // First order: what is left is of the coefficients' squares, 1e-8 of 1e-4.
        const double o = draw(0, 1e-4), e = draw(0, 1e-4);
        const vec3 k = direction;
        const vec3 ray = rayDirection(m, kExtraordinary, k);
        const double expected = judge::lossAlongRay({m.o, m.e, m.axis}, o, e, direction);
        const double c = glm::dot(ray, m.axis);
        EXPECT_NEAR(extraordinaryLoss(m, c, vec3(o), vec3(e)).x, expected, 1e-8);
    }
    // Along the axis an e-ray is an o-ray; across it, all of it is along it.
    const Uniaxial m{1.6584, 1.4864, {0, 0, 1}};
    EXPECT_DOUBLE_EQ(extraordinaryLoss(m, 1, vec3(2), vec3(5)).x, 2);
    EXPECT_DOUBLE_EQ(extraordinaryLoss(m, 0, vec3(2), vec3(5)).x, 5);
}

TEST(Crystal, NormalIncidenceOnAPlateCutAlongItsAxis) {
    // Each mode is a dielectric of its own index: T = 4n/(n + 1)², and the walk-off is none.
    const Uniaxial air{1, 1, {0, 1, 0}};
    for (const double turn : {0.0, 0.3, 1.2, 1.570796}) {
        const Uniaxial m{1.6584, 1.4864, {std::cos(turn), std::sin(turn), 0}};
        const Crossing c = crossingOf(air, m, 0);
        const auto whole = [](double n) { return 4 * n / ((n + 1) * (n + 1)); };
        const double o = square(c.fromO.on.x, c.fromO.on.y) + square(c.fromE.on.x, c.fromE.on.y);
        const double e = square(c.fromO.on.z, c.fromO.on.w) + square(c.fromE.on.z, c.fromE.on.w);
        EXPECT_NEAR(o, whole(m.o), 1e-12);
        EXPECT_NEAR(e, whole(m.e), 1e-12);
        EXPECT_NEAR(c.k.x, m.o, 1e-15);
        EXPECT_NEAR(c.k.y, m.e, 1e-15);
    }
}

TEST(Crystal, GlassIsFresnels) {
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const Uniaxial near = draw.glass(), beyond = draw.glass();
        const double q = draw(0, 1) * near.o;
        const Crossing c = crossingOf(near, beyond, q);
        const double a = std::sqrt(near.o * near.o - q * q);
        const double under = beyond.o * beyond.o - q * q;
        const vec4 p = sharesOf(c.fromO), s = sharesOf(c.fromE);
        EXPECT_NEAR(p.y + p.w + s.x + s.z, 0, 1e-25);
        if (under < 0) {
            EXPECT_NEAR(p.z, 1, 1e-11);
            EXPECT_NEAR(s.w, 1, 1e-11);
            continue;
        }
        const double b = std::sqrt(under);
        const double rs = (a - b) / (a + b);
        const double n2 = near.o * near.o, m2 = beyond.o * beyond.o;
        const double rp = (m2 * a - n2 * b) / (m2 * a + n2 * b);
        EXPECT_NEAR(s.w, rs * rs, 1e-12);
        EXPECT_NEAR(p.z, rp * rp, 1e-12);
        EXPECT_NEAR(s.y, 1 - rs * rs, 1e-12);
        EXPECT_NEAR(p.x, 1 - rp * rp, 1e-12);
    }
}

TEST(Crystal, SameIndicesFollowGlass) {
    // The waves of o and e have glass's k; with the axis in or across the plane of incidence, its
    // powers, too.
    Draw draw;
    const Uniaxial air{1, 1, {0, 1, 0}};
    for (int i = 0; i < 300; ++i) {
        const double n = draw(1.2, 2.4), q = draw(0, 1), turn = draw(0, 2 * kPi);
        const Uniaxial in{n, n, {std::cos(turn), 0, std::sin(turn)}}, across{n, n, {0, 1, 0}};
        const Crossing glass = crossingOf(air, across, q);
        const Crossing made = crossingOf(air, in, q);
        EXPECT_NEAR(made.k.x, glass.k.x, 1e-14);
        EXPECT_NEAR(made.k.y, glass.k.y, 1e-14);
        // In the plane the o-wave is the one across it.
        EXPECT_NEAR(sharesOf(made.fromE).x, sharesOf(glass.fromE).y, 1e-12);
        EXPECT_NEAR(sharesOf(made.fromO).y, sharesOf(glass.fromO).x, 1e-12);
    }
}

TEST(Crystal, AxisAlongTheNormalByPaper) {
    // p-polarised light on a plate cut across its axis (Yariv and Yeh, §4.4 for k_z; by Z =
    // k_z/n²): the e-wave's k_z is n_o √(1 − q²/n_e²), its H_y/E_x n_o²/k_z.
    const Uniaxial air{1, 1, {0, 1, 0}};
    const Uniaxial m{1.6584, 1.4864, {0, 0, 1}};
    for (double q = 0.05; q < 1; q += 0.05) {
        const Crossing c = crossingOf(air, m, q);
        const double a = std::sqrt(1 - q * q);
        const double kz = m.o * std::sqrt(1 - q * q / (m.e * m.e));
        const double rp = (m.o * m.o * a - kz) / (m.o * m.o * a + kz);
        EXPECT_NEAR(c.k.y, kz, 1e-14);
        EXPECT_NEAR(sharesOf(c.fromO).z, rp * rp, 1e-13);
        EXPECT_NEAR(sharesOf(c.fromO).y, 1 - rp * rp, 1e-13);
    }
}

TEST(Crystal, OneIsTotallyReflectedAndNotTheOther) {
    // From a glass denser than both indices onto calcite whose axis is across the plane of
    // incidence: critical angles are asin(n_e/n) for e, asin(n_o/n) for o.
    const double n = 1.8;
    const Uniaxial glass{n, n, {0, 1, 0}}, m{1.6584, 1.4864, {0, 1, 0}};
    for (const double off : {-1e-6, 1e-6}) {
        const vec4 e = sharesOf(crossingOf(glass, m, m.e + off).fromE);
        EXPECT_EQ(e.y > 0, off < 0);
        EXPECT_NEAR(e.y + e.w, 1, 1e-11);
        const vec4 o = sharesOf(crossingOf(glass, m, m.o + off).fromO);
        EXPECT_EQ(o.x > 0, off < 0);
        EXPECT_NEAR(o.x + o.z, 1, 1e-11);
    }
    const double between = 1.55;
    const Crossing c = crossingOf(glass, m, between);
    EXPECT_NEAR(sharesOf(c.fromE).w, 1, 1e-12);
    EXPECT_GT(sharesOf(c.fromO).x, 0.9);
}

TEST(Crystal, EnergyClosesInDoubleAndInFloat) {
    Draw draw;
    double worst = 0;
    Worst inFloat;
    for (int i = 0; i < 200000; ++i) {
        const Uniaxial near = draw.any(), beyond = draw.any();
        for (const bool e : {false, true}) {
            const double q = draw(0, 1) * mostAlong(near, e);
            const Crossing c = crossingOf(near, beyond, q);
            worst = std::max(worst, std::abs(sum(sharesOf(e ? c.fromE : c.fromO)) - 1));
            inFloat.take(near, beyond, q, e);
        }
    }
    std::printf("energy off by %.2e in double, %.2e in float\n", worst, inFloat.solved);
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(inFloat.solved,
              1e-4); // along a boundary, where roundings count by 1 over a small k_z
    EXPECT_LT(inFloat.used, 1e-6);
}

TEST(Crystal, EnergyClosesInFloatNearTheAxis) {
    // Where k runs nearly along the axis both modes are nearly one.
    Draw draw;
    Worst worst;
    for (int i = 0; i < 50000; ++i) {
        Uniaxial m = draw.crystal();
        const double q = draw(0, 0.9);
        const double off = std::pow(10, draw(-9, -1));
        const vec3 k(q, 0, std::sqrt(m.o * m.o - q * q));
        m.axis = glm::normalize(glm::normalize(k) + off * draw.axis());
        const Uniaxial air{1, 1, {0, 1, 0}};
        for (const bool e : {false, true}) {
            worst.take(air, m, q, e);
            worst.take(m, air, q, e);
        }
    }
    EXPECT_LT(worst.solved, 1e-5);
    EXPECT_LT(worst.used, 1e-6);
}

TEST(Crystal, AgreesWithAnIndependentSolve) {
    Draw draw;
    for (int i = 0; i < 200; ++i) {
        const Uniaxial near = draw.any(), beyond = draw.any();
        const bool fromE = draw(0, 1) < 0.5;
        const double q = draw(0.01, 0.97) * mostAlong(near, fromE);
        const Crossing c = crossingOf(near, beyond, q);
        const vec4 mine = sharesOf(fromE ? c.fromE : c.fromO);
        const judge::Tensor a{near.o, near.e, near.axis}, b{beyond.o, beyond.e, beyond.axis};
        const WavePair arriving = wavesOf(near, q, 1);
        const PlaneWave& in = fromE ? arriving.e : arriving.o;
        const vec3 k(q, 0, in.k.x);
        judge::LightWave wave;
        if (a.isotropic())
            wave = judge::isotropicWave(near.o, k, fromE ? vec3(0, 1, 0) : vec3(-in.k.x, 0, q));
        else
            wave = judge::crystalWave(a, fromE ? 'e' : 'o', k);
        ASSERT_LT(glm::length(wave.k - k), 1e-12);
        vec4 found(0);
        for (const judge::LightWave& out : judge::scattered(wave, {0, 0, 1}, a, b)) {
            const int first = out.beyond ? 0 : 2;
            if (out.mode == 'i') { // its two polarisations together
                EXPECT_NEAR(mine[first] + mine[first + 1], out.power, 1e-10) << i;
                found[first] = mine[first], found[first + 1] = mine[first + 1];
                continue;
            }
            const bool isE = out.mode == 'e';
            EXPECT_NEAR(mine[first + isE], out.power, 1e-10) << i << " " << out.mode;
            found[first + isE] = mine[first + isE];
            EXPECT_NEAR(c.k[first + isE], out.k.z, 1e-10) << i;
            const vec3 ray =
                rayDirection(out.beyond ? beyond : near, isE ? kExtraordinary : kOrdinary, out.k);
            EXPECT_LT(glm::length(ray - out.ray), 1e-10) << i;
        }
        EXPECT_LT(glm::length(found - mine), 1e-10) << i; // and no others
    }
}

TEST(Crystal, IsReciprocal) {
    // What goes from one mode into another goes back as well: the frame turned about y, k reversed.
    Draw draw;
    const auto turned = [](Uniaxial m) {
        m.axis = vec3(-m.axis.x, m.axis.y, -m.axis.z);
        return m;
    };
    for (int i = 0; i < 1000; ++i) {
        const Uniaxial near = draw.any(), beyond = draw.any();
        const double q = draw(0, 0.99) * std::min({near.o, near.e, beyond.o, beyond.e});
        const Crossing there = crossingOf(near, beyond, q);
        const Crossing here = crossingOf(turned(beyond), turned(near), q);
        EXPECT_NEAR(sharesOf(there.fromO).x, sharesOf(here.fromO).x, 1e-10);
        EXPECT_NEAR(sharesOf(there.fromO).y, sharesOf(here.fromE).x, 1e-10);
        EXPECT_NEAR(sharesOf(there.fromE).x, sharesOf(here.fromO).y, 1e-10);
        EXPECT_NEAR(sharesOf(there.fromE).y, sharesOf(here.fromE).y, 1e-10);
    }
}

TEST(Crystal, PolarisationIsKeptAsAVector) {
    Draw draw;
    for (int i = 0; i < 1000; ++i) {
        const double angle = draw(-kPi, kPi), degree = draw(0, 1);
        const vec2 p = std::sqrt(degree) * vec2(std::cos(angle), std::sin(angle));
        const vec3 state = stateOf(p);
        EXPECT_NEAR(state.x + state.y, 1, 1e-14);
        const vec2 back = polarisationOf(3.0 * state);
        EXPECT_NEAR(std::abs(glm::dot(back, p)), degree, 1e-7);
        EXPECT_NEAR(glm::dot(back, back), degree, 1e-7);
    }
    // Light polarised at 45° between two equal waves: Malus' law for what each takes.
    const vec4 sent = sentOn(vec4(stateOf(vec2(std::sqrt(0.5), std::sqrt(0.5))), 0),
                             vec4(0.8, 0, 0.6, 0), vec4(-0.6, 0, 0.8, 0));
    EXPECT_NEAR(sent.x, 0.02, 1e-15); // (0.2)²/2
    EXPECT_NEAR(sent.y, 0.98, 1e-15);
}
