// Waves of crystals that vary: the shaders' own text in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/varying_crystal.h"
#include "support/shader_lib.h"

#include <gtest/gtest.h>

using namespace eikonal::shader_lib;

namespace {

judge::Tensor crystalAt(const vec3& x) {
    return {1.6 + 0.1 * std::sin(0.05 * x.x + 0.1 * x.z), 1.5 + 0.02 * std::sin(0.1 * x.y),
            glm::normalize(vec3(1, 0.1 * x.y, std::sin(0.1 * x.x)))};
}

struct Dielectric {
    vec3 pure, mixed;
    double o;
};

Dielectric dielectricOf(const vec3& x) {
    const judge::Tensor t = crystalAt(x);
    const double d = t.e * t.e - t.o * t.o;
    const vec3 a = t.axis;
    return {d * a * a, d * vec3(a.y * a.z, a.z * a.x, a.x * a.y), t.o};
}

VaryingCrystal varyingAt(const vec3& x, const vec3& k) {
    const Dielectric here = dielectricOf(x);
    VaryingCrystal found{here.o, here.pure, here.mixed, vec3(0), vec3(0), vec3(0)};
    const double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
        vec3 step(0);
        step[i] = h;
        const Dielectric b = dielectricOf(x - step), f = dielectricOf(x + step);
        found.slopeO[i] = (f.o - b.o) / (2 * h);
        found.slopeT[i] = glm::dot(f.pure - b.pure, vec3(1)) / (2 * h);
        found.slopeKK[i] =
            (glm::dot(k, timesD(f.pure, f.mixed, k)) - glm::dot(k, timesD(b.pure, b.mixed, k))) /
            (2 * h);
    }
    return found;
}

} // namespace

TEST(VaryingCrystalLibrary, ARayKeepsItsHamiltonianAndIsTheJudges) {
    theCrystal = varyingAt;
    for (const bool extraordinary : {false, true}) {
        const vec3 from(1, 2, 3);
        vec3 x = from, k(0.4, -1.4, 0.3);
        k /= std::sqrt(2 * hamiltonianOf(varyingAt(x, k), extraordinary, k) + 1);
        const vec3 begun = k;
        double drift = 0, length = 0;
        for (int i = 0; i < 80; ++i) {
            const Flow first = flowOf(varyingAt(x, k), extraordinary, k);
            const double tau = 0.5 / glm::length(first.x);
            const Flow change = varyingStep(0, extraordinary, x, k, first, tau).change;
            x += change.x;
            k += change.k;
            length += 0.5;
            drift = std::max(drift, std::abs(hamiltonianOf(varyingAt(x, k), extraordinary, k)));
        }
        EXPECT_LT(drift, 1e-8);
        const judge::CrystalRay wanted = judge::throughCrystal(
            crystalAt, extraordinary ? 'e' : 'o', from, begun,
            [&](const vec3& at) { return glm::dot(at - x, glm::normalize(k)); });
        EXPECT_LT(glm::length(wanted.x - x), 1e-5);
        EXPECT_LT(glm::length(wanted.k - k), 1e-6);
        EXPECT_GT(glm::length(glm::normalize(k) - glm::normalize(begun)), 0.02);
    }
}

TEST(VaryingCrystalLibrary, HIsThatOfBothIndices) {
    for (const vec3& x : {vec3(1, 2, 3), vec3(-7, 3, 0.5)}) {
        const vec3 k(0.3, 0.9, -1.1);
        const judge::Tensor t = crystalAt(x);
        const double along = glm::dot(k, t.axis), kk = glm::dot(k, k);
        EXPECT_NEAR(hamiltonianOf(varyingAt(x, k), true, k),
                    0.5 * (along * along / (t.o * t.o) + (kk - along * along) / (t.e * t.e) - 1),
                    1e-14);
        EXPECT_NEAR(hamiltonianOf(varyingAt(x, k), false, k), 0.5 * (kk / (t.o * t.o) - 1), 1e-14);
        EXPECT_NEAR(std::abs(glm::dot(axisOf(varyingAt(x, k).pure, varyingAt(x, k).mixed), t.axis)),
                    1, 1e-14);
    }
    EXPECT_EQ(axisOf(vec3(0), vec3(0)), vec3(0));
}

TEST(VaryingCrystalLibrary, PolarisationTurnsByJones) {
    // Against 2 x 2 matrices of E along f and g in thin slices.
    using Complex = std::complex<double>;
    const auto retardanceAt = [](double l) {
        const double a = 0.9 * l + 0.3 * l * l, size = 0.8 + 0.3 * std::sin(2 * l);
        return size * vec3(std::cos(2 * a), std::sin(2 * a), 0);
    };
    const double whole = 3;
    Complex f(0.8, 0.1), g(-0.3, 0.5);
    const double all = std::norm(f) + std::norm(g);
    f /= std::sqrt(all);
    g /= std::sqrt(all);
    const auto stokesOf = [](Complex a, Complex b) {
        const Complex both = a * std::conj(b);
        return vec3(std::norm(a) - std::norm(b), 2 * both.real(), 2 * both.imag());
    };
    const vec3 begun = stokesOf(f, g);
    const int slices = 200000;
    for (int i = 0; i < slices; ++i) {
        // What is along (c, s) gains the phase |ω| dl on what is across it.
        const vec3 w = retardanceAt((i + 0.5) * whole / slices);
        const double angle = 0.5 * std::atan2(w.y, w.x), c = std::cos(angle), s = std::sin(angle);
        const Complex along = (c * f + s * g) * std::polar(1.0, glm::length(w) * whole / slices),
                      across = -s * f + c * g;
        f = c * along - s * across;
        g = s * along + c * across;
    }
    vec3 found = begun;
    const int pieces = 12;
    const double piece = whole / pieces, gauss = std::sqrt(3.0) / 6 * piece;
    for (int i = 0; i < pieces; ++i)
        found = polarisedOn(found, retardanceAt((i + 0.5) * piece - gauss),
                            retardanceAt((i + 0.5) * piece + gauss), piece);
    EXPECT_LT(glm::length(found - stokesOf(f, g)), 1e-4);
    EXPECT_GT(glm::length(found - begun), 0.5);
    EXPECT_NEAR(glm::length(found), glm::length(begun), 1e-12);
}

TEST(VaryingCrystalLibrary, StokesNumbersFollowTheirVectors) {
    const vec3 d = glm::normalize(vec3(0.3, -0.5, 0.4)), f = acrossOf(d), g = glm::cross(f, d);
    const double a = 0.7;
    const vec3 e = std::cos(a) * f + std::sin(a) * g;
    // Light along e is all s1 by e.
    const vec3 byF(std::cos(2 * a), std::sin(2 * a), 0);
    EXPECT_LT(glm::length(polarisedBy(byF, f, g, e) - vec3(1, 0, 0)), 1e-14);
    const vec3 any(0.2, -0.5, 0.6);
    EXPECT_LT(glm::length(polarisedBy(polarisedBy(any, f, g, e), e, glm::cross(e, d), f) - any),
              1e-14);
}
