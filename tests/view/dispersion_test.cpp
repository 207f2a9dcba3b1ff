// Viewing rays by wavelength, against Snell's law on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "support/glass_volume.h"
#include "support/look.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

constexpr double kF = 486.1, kD = 587.6, kC = 656.3; // Fraunhofer's lines [nm]

struct GlassKind {
    double index, dispersion;
};
constexpr GlassKind kBk7{1.5168, 0.0042}, kSf10{1.72828, 0.01342};

double lawOf(const GlassKind& glass, double nanometres) {
    const double um = nanometres / 1000;
    return glass.index + glass.dispersion * (1 / (um * um) - 1 / (0.5876 * 0.5876));
}

/// Of 60°, its edge along z: two faces that lean towards each other above the domain's middle.
volume::Volume prism(const GlassKind& glass) {
    TestVolume scene(ivec3(48, 48, 12));
    scene.add("sdf", [](dvec3 p) {
        const double y = p.y - 24.3, x = p.x - 24.1;
        return std::max(0.5 * y + std::sqrt(0.75) * x, 0.5 * y - std::sqrt(0.75) * x) - 6;
    });
    scene.constant("ior", glass.index);
    scene.constant("dispersion", glass.dispersion);
    return scene.take();
}

/// How far a prism of 60° turns a ray of that wavelength which passes it symmetrically [degree].
double turnOf(const GlassKind& glass, double nanometres) {
    // Within, a ray along x is 30° off either face's normal.
    const double n = lawOf(glass, nanometres);
    const double before = std::asin(n * 0.5);
    const double aslant = before - std::numbers::pi / 6; // upward
    Params params =
        parallel(dvec3(24.1, 22, 6) - 60.0 * dvec3(std::cos(aslant), std::sin(aslant), 0),
                 {24.1, 22, 6}, 1, {1, 1});
    params.wavelengths.list = {nanometres};
    const Look look(prism(glass), sharp::sharply(params));
    const dvec3 in(std::cos(aslant), std::sin(aslant), 0);
    return sharp::degreesBetween(in, look.direction());
}

double leastTurn(const GlassKind& glass, double nanometres) {
    const double turn = 2 * std::asin(lawOf(glass, nanometres) * 0.5) - std::numbers::pi / 3;
    return turn * 180 / std::numbers::pi;
}

} // namespace

TEST(Dispersion, APrismTurnsEachLineBySnellsLaw) {
    for (const GlassKind& glass : {kBk7, kSf10})
        for (const double line : {kF, kD, kC})
            EXPECT_NEAR(turnOf(glass, line), leastTurn(glass, line), 0.002) << line;
    // By hand: the spread from F to C of the one glass is 3.4 times the other's.
    const auto spread = [](const GlassKind& glass) {
        return turnOf(glass, kF) - turnOf(glass, kC);
    };
    EXPECT_NEAR(spread(kBk7), leastTurn(kBk7, kF) - leastTurn(kBk7, kC), 0.002);
    EXPECT_GT(spread(kSf10), 3 * spread(kBk7));
}

namespace {

/// n by height [voxel] and Cauchy's B by height, layered.
double heightIndex(double y) {
    return 1.3 + 0.01 * y + 0.02 * std::sin(0.2 * y);
}
double heightDispersion(double y) {
    return 0.004 + 0.0005 * y;
}

volume::Volume layers() {
    TestVolume scene(ivec3(40, 24, 6));
    scene.index([](dvec3 p) { return heightIndex(p.y); });
    scene.add("dispersion", [](dvec3 p) { return heightDispersion(p.y); });
    return scene.take();
}

} // namespace

TEST(Dispersion, LayersKeepWhatRunsAlongThem) {
    // Through layers n cos θ is constant, θ to the layers. Blurred, index and dispersion both vary.
    for (const optics::Integrator integrator :
         {optics::Integrator::verlet, optics::Integrator::sharma})
        for (const double line : {400.0, kF, kC, 1064.0}) {
            const dvec3 in = glm::normalize(dvec3(1, 0.2, 0));
            Params params = parallel(dvec3(0, 6, 3) - 40.0 * in, {0, 6, 3}, 1, {1, 1});
            params.wavelengths.list = {line};
            params.integrator = integrator;
            params.interpolation = integrator == optics::Integrator::verlet
                                       ? optics::Interpolation::linear
                                       : optics::Interpolation::cubic;
            params.step = 0.5;
            const Look look(layers(), params);
            const auto n = [line](double y) {
                return lawOf({heightIndex(y), heightDispersion(y)}, line);
            };
            const double along = n(6) * in.x / n(look.place().y);
            // What the plain index would make of it is 1e-3 or more off.
            EXPECT_NEAR(look.direction().x, along, 3e-5) << line;
            EXPECT_GT(std::abs(heightIndex(6) * in.x / heightIndex(look.place().y) - along), 3e-4);
        }
}

TEST(Dispersion, AHiddenPrismBendsAllButOneLine) {
    // Two glasses of the same index at 587.6 nm side by side, as in prisms that see straight ahead.
    const auto glasses = [] {
        TestVolume scene(ivec3(48, 24, 6));
        scene.add("sdf", [](dvec3 p) { return (p.x - 24 + 0.5 * (p.y - 12)) / std::sqrt(1.25); });
        scene.add(
            "ior", [](dvec3) { return 1.6; }, 1.6);
        scene.add(
            "dispersion", [](dvec3) { return 0.012; }, 0.004);
        return scene.take();
    };
    for (const double line : {kF, kD, kC}) {
        Params params = parallel({-30, 12, 3}, {0, 12, 3}, 1, {1, 1});
        params.wavelengths.list = {line};
        const Look look(glasses(), sharp::sharply(params));
        const double before = lawOf({1.6, 0.012}, line), after = lawOf({1.6, 0.004}, line);
        const double incidence = std::atan(0.5); // to the normal
        const double wanted = std::asin(before / after * std::sin(incidence)) - incidence;
        const double found = std::atan2(-look.direction().y, look.direction().x);
        EXPECT_NEAR(found, wanted, 3e-5) << line;
    }
}

namespace {

/// A ball of glass before a striped background, of next to no dispersion, coloured.
volume::Volume colouredBall(double dispersion) {
    TestVolume scene(ivec3(24));
    scene.add("sdf", [](dvec3 p) { return glm::length(p - 12.2) - 9; });
    scene.constant("ior", 1.5);
    scene.constant("dispersion", dispersion);
    scene.constantVector("absorption", {0.02, 0.1, 0.005});
    return scene.take();
}

image::Image stripes() {
    return sharp::mapOf([](dvec3 d) {
        return dvec3(1.5 + std::sin(9 * d.x), 1 + 0.9 * std::sin(7 * d.y),
                     0.5 + 0.4 * std::cos(8 * d.z));
    });
}

Look lookAt(volume::Volume volume, const optics::Wavelengths& wavelengths, int samples,
            const ivec2& size) {
    Params params = parallel({12, 14, 80}, {12, 12, 12}, 20, size);
    params.wavelengths = wavelengths;
    params.samples = samples;
    params.aovs = {"exit_direction"};
    return {std::move(volume), sharp::sharply(params), stripes()};
}

} // namespace

TEST(Dispersion, WhiteAddsUpAgain) {
    const ivec2 size(24, 24);
    const Look plain = lookAt(colouredBall(0), {}, 1, size);
    EXPECT_FALSE(plain.plan.scene.disperses);
    for (const int count : {2, 8}) {
        const Look parts = lookAt(colouredBall(1e-9), {count, {}}, 1, size);
        EXPECT_TRUE(parts.plan.scene.disperses);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                expectNear(parts.colour(x, y), plain.colour(x, y), 1e-4);
                expectNear(parts.direction(x, y), plain.direction(x, y), 1e-6);
                EXPECT_NEAR(parts.at("A", x, y), plain.at("A", x, y), 1e-6);
            }
    }
}

TEST(Dispersion, FewShiftedLinesLookLikeMany) {
    // By eight parts and four samples pixels differ from 64 parts' by what a pixel's pattern
    // leaves; blocks of them by less.
    const ivec2 size(32, 32);
    const Look few = lookAt(colouredBall(0.01), {8, {}}, 4, size),
               many = lookAt(colouredBall(0.01), {64, {}}, 4, size);
    const Look mono = lookAt(colouredBall(0.01), {1, {}}, 4, size);
    const auto blocksOff = [&](const Look& look) {
        double sum = 0;
        for (int y = 0; y < size.y; y += 4)
            for (int x = 0; x < size.x; x += 4) {
                dvec3 off(0);
                for (int j = 0; j < 4; ++j)
                    for (int i = 0; i < 4; ++i)
                        off += (look.colour(x + i, y + j) - many.colour(x + i, y + j)) / 16.0;
                sum += glm::dot(off, off) / 64;
            }
        return std::sqrt(sum);
    };
    EXPECT_LT(blocksOff(few), 0.1 * blocksOff(mono));
    // Paths are those of 587.6 nm, however many parts there are.
    for (int x = 0; x < size.x; x += 3)
        expectNear(few.direction(x, 16), mono.direction(x, 16), 1e-6);
}

TEST(Dispersion, IsNotTracedWhereNothingRefractsOrOneLineIsAskedFor) {
    TestVolume even(ivec3(8));
    even.constant("ior", 1.5);
    even.constant("dispersion", 0.01);
    const auto planOf = [](volume::Volume volume, int count) {
        Params params = parallel({4, 4, 30}, dvec3(4), 4);
        params.wavelengths.count = count;
        return Look(std::move(volume), params).plan;
    };
    EXPECT_FALSE(planOf(even.take(), 8).scene.disperses);
    EXPECT_FALSE(planOf(colouredBall(0.01), 1).scene.disperses);
    EXPECT_TRUE(planOf(colouredBall(0.01), 8).scene.disperses);
}

TEST(Dispersion, AnIndexBelowNothingIsRefused) {
    Params params = parallel({12, 12, 80}, dvec3(12), 4);
    EXPECT_THROW(Look(colouredBall(-0.5), params), DataError);
    params.wavelengths.count = 1; // it is not looked at
    EXPECT_NO_THROW(Look(colouredBall(-0.5), params));
}
