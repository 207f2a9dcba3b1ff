// Hard cases of ways there and back: rays turned round, rays that never leave.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard.h"

using namespace eikonal;
using namespace eikonal::hard;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

class HardOrbit : public testing::TestWithParam<Mode> {};
class HardStepLimit : public testing::TestWithParam<Mode> {};
class HardReversal : public testing::TestWithParam<Mode> {};

/// A ball of diamond in air, as large as the box lets it be.
constexpr double kGalleryRadius = 12, kGalleryIndex = 2.42;
TestVolume gallery() {
    return ballIn(32, kGalleryRadius, kGalleryIndex, 1);
}

/// Rays from a point at even angles about `towards`, in the plane of it and `up`.
Params fan(const dvec3& eye, const dvec3& towards, const dvec3& up, double halfDegrees, int rays) {
    return perspective(eye, eye + towards, 2 * halfDegrees, {1, rays}, up);
}

} // namespace

TEST_P(HardReversal, ARayTurnedRoundComesBack) {
    const Mode mode = GetParam();
    always([mode] {
        // Waves of the index half a hundred voxels long and longer, at random angles: differences
        // over two voxels and the straight run between them then miss n by a quarter of n'', 4e-4
        // at most, by which |w| is set anew for the way back.
        dvec3 wave[3];
        double phase[3];
        for (int i = 0; i < 3; ++i) {
            wave[i] = drawnDirection() * drawn(0.05, 0.12);
            phase[i] = drawn(0, 2 * kPi);
        }
        const dvec3 d = drawnDirection(), aim = 16.0 + 8.0 * drawnDirection();
        const auto lookAlong = [&](const dvec3& through, const dvec3& way) {
            Params params = parallel(through - 60.0 * way, through, 1, {1, 1}, across(way));
            mode.set(params);
            return params;
        };
        const auto scene = [&] {
            TestVolume out(ivec3(32));
            out.index([&](dvec3 p) {
                double n = 1.5;
                for (int i = 0; i < 3; ++i) n += 0.04 * std::sin(glm::dot(wave[i], p) + phase[i]);
                return n;
            });
            return out.take();
        };
        const Look there(scene(), lookAlong(aim, d));
        const Look back(scene(), lookAlong(there.place(), -there.direction()));
        // The way there met the domain on the line through `aim`; the way back leaves there.
        const dvec3 off = back.place() - aim;
        EXPECT_LT(glm::length(off - glm::dot(off, d) * d), 1e-3);
        EXPECT_LT(glm::length(back.direction() + d), 1e-3 / 16); // 1e-3 voxel over half the box
        // Where the ray meets the face askew, its end is off by as much more along it.
        const auto slant = [](const dvec3& way, const dvec3& place) {
            int face = 0;
            for (int i = 1; i < 3; ++i)
                if (std::abs(place[i] - 16) > std::abs(place[face] - 16)) face = i;
            return std::max(std::abs(way[face]), 1e-3);
        };
        const double askew =
            1 / slant(d, back.place()) + 1 / slant(there.direction(), there.place());
        // A step's length is counted as n dτ, its way is |w| dτ.
        const double counted = 40 * (there.at("error.V") + back.at("error.V"));
        EXPECT_NEAR(back.at("path_length.V"), there.at("path_length.V"), 1e-3 * askew + counted);
    });
}

INSTANTIATE_TEST_SUITE_P(Modes, HardReversal, testing::ValuesIn(preciseModes()), modeName);

TEST_P(HardOrbit, CirclesOfTheFishEyeAreTrappedAndStayCircles) {
    // From a point on the unit circle, r = a, at an angle ψ to it: a circle of radius a/cosψ about
    // a point a tanψ out.
    const int rays = 9;
    Params params = fan({22, 16, 16}, {0, 0, -1}, {1, 0, 0}, 35, rays);
    params.background = dvec3(1);
    GetParam().set(params);
    const Look look(fishEye(32, 6).take(), params);
    EXPECT_EQ(look.counter("rays"), rays);
    EXPECT_EQ(look.counter("trapped"), rays);
    for (int i = 0; i < rays; ++i) {
        const double tangent = (1 - (2 * i + 1.0) / rays) * std::tan(35 * kPi / 180);
        const dvec3 centre = dvec3(16, 16, 16 + 6 * tangent);
        // Hundreds of turns at six voxels' radius: trilinear gradients let the circle turn and
        // breathe by a few hundredths of its size.
        const dvec3 place = look.place(0, i);
        EXPECT_LT(glm::length(place - 16.0),
                  6 * (std::sqrt(1 + tangent * tangent) + std::abs(tangent)) + 1)
            << centre.z;
        EXPECT_NEAR(place.y, 16, 0.01); // it stays in its plane, one of symmetry
        EXPECT_GT(look.at("steps.V", 0, i), 1000);
        EXPECT_EQ(look.at("A", 0, i), 1);
        EXPECT_GE(look.at("path_length.V", 0, i), 0.01 * look.at("steps.V", 0, i));
    }
}

TEST_P(HardOrbit, TheWhisperingGalleryKeepsWhatRunsAlongItsWall) {
    // A ray inside gets out only if its n r sinφ is below the least n r at the wall, 15 here.
    struct Case {
        double radius;
        bool kept;
    };
    for (const Case& c : {Case{10, true}, {9, true}, {3, false}, {1, false}}) {
        Params params = fan({16 + c.radius, 16, 16}, {0, 0, -1}, {1, 0, 0}, 10, 4);
        GetParam().set(params);
        const Look look(gallery().take(), params);
        EXPECT_EQ(look.counter("trapped"), c.kept ? 4 : 0) << c.radius;
        for (int i = 0; i < 4 && c.kept; ++i)
            EXPECT_LT(glm::length(look.place(0, i) - 16.0), 14); // 12 and the blur of its edge
    }
}

TEST_P(HardStepLimit, AStepLimitIsCountedAndNothingIsLeftOut) {
    for (const int limit : {1, 7, 40}) {
        Params params = fan({22, 16, 16}, {0, 0, -1}, {1, 0, 0}, 30, 5);
        GetParam().set(params);
        params.maxSteps = limit;
        const Look look(fishEye(32, 6).take(), params);
        EXPECT_EQ(look.counter("trapped"), 5);
        for (int i = 0; i < 5; ++i) EXPECT_EQ(look.at("steps.V", 0, i), limit);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, HardOrbit, testing::ValuesIn(conservingModes()), modeName);
INSTANTIATE_TEST_SUITE_P(Modes, HardStepLimit, testing::ValuesIn(allModes()), modeName);

TEST(HardTrap, PhotonsOfTheFishEyeAreCountedAndBookedAsLost) {
    // From a point on the unit circle a ray at an angle ψ to it reaches a (1 + sinψ)/cosψ across
    // its plane, t; turned by φ about the axis it stays in a cube of half edge H while t
    // max(|cosφ|, |sinφ|) < H. The share of directions is that of |sinψ| < (t² − a²)/(t² + a²).
    const double a = 6.4, half = 16;
    double share = 0;
    const int kParts = 1000;
    for (int i = 0; i < kParts; ++i) {
        const double phi = (i + 0.5) / kParts * kPi / 4, t = half / std::cos(phi);
        share += (t * t - a * a) / (t * t + a * a) / kParts;
    }
    lightsim::Params params =
        lightsim::paramsOf({lightsim::lamp({16 + a, 16, 16}, {1, 2, 3})}, 1500);
    params.maxSteps = 1000;
    params.stepMin = 0.5;
    const lightsim::Lit lit(fishEye(32, a).volume(), params); // which checks the books
    const Energy& energy = lit.stats.energy;
    const double photons = lit.counter("photons"), trapped = lit.counter("trapped");
    EXPECT_EQ(lit.counter("photons_left_by_thinning"), 0);
    EXPECT_LE(lit.counter("steps"), photons * 1000);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(energy.emitted[c], 4 * kPi * static_cast<double>(c + 1), 1e-9);
        // 1500 photons: one in 30 of those at the limit; steps of half a voxel where a circle is
        // six and more.
        EXPECT_NEAR(energy.lost[c] / energy.entered[c], share, 0.03);
        EXPECT_NEAR(energy.lost[c] + energy.escaped[c], energy.entered[c],
                    1e-5 * energy.entered[c]); // floats
    }
    EXPECT_NEAR(trapped / photons, share, 0.15); // of photons that weigh 0.5 to 1.6 of the mean
    forEachVoxel(ivec3(32), [&](ivec3 p) { ASSERT_TRUE(std::isfinite(lit.fluence(p))); });
}

TEST(HardTrap, PhotonsOfTheWhisperingGalleryAreBookedAsLost) {
    // From a point at r they stay if n r sinφ is above the least n r at the wall: a share of cosφ.
    double least = 1e9;
    for (double r = kGalleryRadius; r < 16; r += 0.01)
        least = std::min(least, r * edge(1, kGalleryIndex, kGalleryRadius - r, 1.5));
    lightsim::Params params = lightsim::paramsOf({lightsim::lamp({16, 24, 16})}, 1500);
    params.maxSteps = 600;
    const lightsim::Lit lit(gallery().volume(), params);
    const double sine = least / (kGalleryIndex * 8);
    const Energy& energy = lit.stats.energy;
    EXPECT_GT(lit.counter("trapped"), 0);
    // Voxels make the wall uneven: at every bounce n r sinφ moves by up to a voxel or so, and those
    // near the limit get out in the end.
    EXPECT_GT(energy.lost[0] / energy.entered[0], 0.3 * std::sqrt(1 - sine * sine));
    EXPECT_LT(energy.lost[0] / energy.entered[0], 1.05 * std::sqrt(1 - sine * sine));
}
