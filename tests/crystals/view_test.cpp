// Crystals as viewing rays meet them, against Maxwell's equations solved without libcore or
// shaders. SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "judge/crystal.h"
#include "support/crystal_volume.h"
#include "support/glass_volume.h"
#include "support/look.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kO = 1.6584, kE = 1.4864; // calcite at 589 nm

const dvec3 kLow(4, 12, 4), kHigh(44, 32, 44); // a rhomb's stand-in
constexpr double kWall = 6;

double falls(const dvec3& x) { // irradiance on the wall under it
    return 1 + 0.05 * x.x + 0.02 * x.z;
}

/// A box of a crystal over a lit wall.
volume::Volume boxOverWall(double o, const std::optional<volume::Crystal>& crystal) {
    const ivec3 size(48, 40, 48);
    volume::Volume volume = crystalVolume(
        size, {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, o, crystal},
               {"wall", [](dvec3 p) { return p.y - kWall; }, 1, {}, 0, 1}});
    volume::FineGrid light;
    light.detail = 1;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < size.x; ++x) {
                light.voxels.emplace_back(x, y, z);
                light.values.emplace_back(static_cast<float>(falls(dvec3(x, y, z) + 0.5)));
            }
    volume.putFine("irradiance", volume.domain(), light);
    return volume;
}

/// What the eye sees of the wall through the box, as the judge has it.
struct Slab {
    judge::Tensor medium;
    double seen = 0;

    void follow(const dvec3& x, const judge::LightWave& wave, double power) {
        if (power < 1e-7) return;
        const bool down = wave.ray.y < 0;
        const dvec3 end = x + ((down ? kLow.y : kHigh.y) - x.y) / wave.ray.y * wave.ray;
        for (const judge::LightWave& next :
             judge::scattered(wave, {0, down ? -1 : 1, 0}, medium, judge::Tensor{})) {
            if (!next.beyond)
                follow(end, next, power * next.power);
            else if (down)
                seen += power * next.power / kPi *
                        falls(end + (kWall - kLow.y) / next.ray.y * next.ray);
        }
    }
    double lookAlong(const judge::Ray& ray) {
        const dvec3 start = ray.x + (kHigh.y - ray.x.y) / ray.direction.y * ray.direction;
        for (const dvec3& field : {dvec3(1, 0.1, 0.2), dvec3(0)}) {
            const dvec3 across = glm::cross(glm::normalize(ray.direction), dvec3(1, 0.1, 0.2));
            for (const judge::LightWave& next : judge::scattered(
                     judge::isotropicWave(1, ray.direction, field == dvec3(0) ? across : field),
                     {0, -1, 0}, {}, medium))
                if (next.beyond) follow(start, next, 0.5 * next.power);
        }
        return seen;
    }
};

/// A smooth room.
double shines(const dvec3& d) {
    return 1 + 0.6 * d.x - 0.3 * d.y + 0.2 * d.z * d.x;
}

} // namespace

TEST(CrystalView, ARhombShiftsWhatIsUnderItAsMaxwellSays) {
    for (const dvec3& axis : {dvec3(1, 1, 0), dvec3(-1, 1, 0), dvec3(0.3, 0.5, -0.8)}) {
        const volume::Volume volume = boxOverWall(kO, crystalOf(kE, axis));
        for (const dvec3& along : {dvec3(0, -1, 0), dvec3(0.3, -1, 0.2)}) {
            const dvec3 on(24.3, 32, 23.9);
            const judge::Ray ray{on - 6.0 * along, glm::normalize(along)};
            Params params = sharp::sharply(sharp::oneRay(ray));
            params.cutoff = 1e-6;
            const Look look(scene::Files(volume), params);
            const double expected = Slab{{kO, kE, axis}}.lookAlong(ray);
            // A spline's rounding of planes.
            EXPECT_NEAR(look.at("R") / expected, 1, 2e-4);
        }
    }
}

TEST(CrystalView, ADoubleImageIsOffsetByPaper) {
    // 20 mm of calcite cut at 45°, a voxel a mm: the e-ray lands 0.1090 of that aside, towards
    // the side that its axis's sign tells, so that both axes' pictures differ by twice that.
    const double offset = 20 * std::tan(6.224118 * kPi / 180);
    const judge::Ray ray{{24, 38, 24}, {0, -1, 0}};
    double seen[2];
    for (const int side : {0, 1}) {
        const dvec3 axis(side == 0 ? 1 : -1, 1, 0);
        const volume::Volume volume = boxOverWall(kO, crystalOf(kE, axis));
        seen[side] = Look(scene::Files(volume), sharp::sharply(sharp::oneRay(ray))).at("R");
    }
    // n of the e-wave along the face's normal is k's: 1.5707. Each way through leaves T²/(1 − R²)
    // of a mode; R of what goes back and forth lands three offsets aside.
    const double e = std::sqrt(2 / (1 / (kO * kO) + 1 / (kE * kE)));
    const double R = std::pow((e - 1) / (e + 1), 2), T2 = (1 - R) * (1 - R);
    double landed = 0;
    for (int i = 0; i < 6; ++i) landed += T2 * std::pow(R, 2 * i) * offset;
    const double expected = 0.5 * landed * 2 * 0.05 / kPi;
    EXPECT_NEAR(std::abs(seen[0] - seen[1]) / expected, 1, 5e-3);
}

TEST(CrystalView, ABallIsAsMaxwellSays) {
    const dvec3 centre(24.2, 23.9, 24.1);
    const double radius = 18;
    const image::Image map = sharp::mapOf([](dvec3 d) { return dvec3(shines(d)); }, 1024);
    for (const auto& [o, e, axis] :
         {std::tuple(kO, kE, dvec3(1, 1, 0)), std::tuple(1.5443, 1.5534, dvec3(0.2, 0.3, 0.9))}) {
        const volume::Volume volume = crystalVolume(
            ivec3(48), {{"ball", [&](dvec3 p) { return glm::length(p - centre) - radius; }, o,
                         crystalOf(e, axis)}});
        for (const double impact : {0.1, 0.4, 0.7}) {
            const dvec3 d = glm::normalize(dvec3(0.2, -0.4, -1));
            const dvec3 aside = glm::normalize(glm::cross(d, dvec3(0.4, 1, 0.1)));
            const judge::Ray ray{centre + impact * radius * aside - 60.0 * d, d};
            Params params = sharp::sharply(sharp::oneRay(ray));
            params.cutoff = 1e-6;
            const Look look(scene::Files(volume), params, map);
            double expected = 0;
            for (const judge::LeftBall& left :
                 judge::throughBall({o, e, axis}, centre, radius, ray.x, d, 10))
                expected += left.power * shines(left.direction);
            EXPECT_NEAR(look.at("R"), expected, 3e-3) << impact;
        }
    }
}

TEST(CrystalView, EqualIndicesAreGlass) {
    const Look crystal(scene::Files(boxOverWall(1.5, crystalOf(1.5, {1, 2, 0}))),
                       sharp::sharply(parallel({24, 100, 24}, {24, 0, 24}, 30, {9, 9}, {0, 0, 1})));
    const Look glass(scene::Files(boxOverWall(1.5, {})),
                     sharp::sharply(parallel({24, 100, 24}, {24, 0, 24}, 30, {9, 9}, {0, 0, 1})));
    EXPECT_EQ(crystal.picture.pixels, glass.picture.pixels);
}

TEST(CrystalView, PleochroismByPaper) {
    // A plate cut along its axis, light across it: each mode is a plate of its own.
    const double o = 1.644, e = 1.624, sigmaO = 0.1, sigmaE = 0.02;
    const volume::Volume volume = crystalVolume(
        ivec3(48, 40, 48), {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, o,
                             crystalOf(e, {1, 0, 0}, sigmaE), sigmaO}});
    Params params = sharp::sharply(sharp::oneRay({{24, 38, 24}, {0, -1, 0}}));
    params.background = dvec3(1);
    params.cutoff = 1e-6;
    const auto plate = [](double n, double sigma) {
        const double R = std::pow((n - 1) / (n + 1), 2), a = std::exp(-20 * sigma);
        const double through = (1 - R) * (1 - R) * a / (1 - R * R * a * a);
        return through + R * (1 + through * a); // what is reflected sees the same background
    };
    EXPECT_NEAR(Look(scene::Files(volume), params).at("R"),
                0.5 * (plate(o, sigmaO) + plate(e, sigmaE)), 1e-4);
}

TEST(CrystalView, PolarisersFollowMalus) {
    Params params = sharp::sharply(parallel({24, 100, 24}, {24, 0, 24}, 4, {1, 1}, {0, 0, 1}));
    params.background = dvec3(1);
    params.cutoff = 1e-6;
    params.polarizer = 10;
    // Beside everything: one leaves half, two what Malus says.
    const volume::Volume ball = crystalVolume(
        ivec3(48, 40, 48), {{"ball", [](dvec3 p) { return glm::length(p - dvec3(8)) - 4; }, 1.5}});
    EXPECT_NEAR(Look(scene::Files(ball), params).at("R"), 0.5, 1e-6);
    for (const double angle : {10.0, 40.0, 100.0, 190.0}) {
        params.backPolarizer = angle;
        const double c = std::cos((angle - 10) * kPi / 180);
        EXPECT_NEAR(Look(scene::Files(ball), params).at("R"), 0.5 * c * c, 1e-6) << angle;
    }
    // A plate between crossed ones, the phase of its modes not kept: dark where they lie along the
    // polarisers, else half of what parallel ones would leave of each mode.
    const auto plate = [](const dvec3& axis) {
        return crystalVolume(ivec3(48, 40, 48),
                             {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, kO,
                               crystalOf(kE, axis)}});
    };
    params.polarizer = 0;
    params.backPolarizer = 90;
    const auto through =
        [](double n) { // what is reflected goes up, where the background is, crossed too
            const double R = std::pow((n - 1) / (n + 1), 2);
            return (1 - R) * (1 - R) / (1 - R * R);
        };
    EXPECT_NEAR(Look(scene::Files(plate({1, 0, 0})), params).at("R"), 0, 1e-5);
    const double found = Look(scene::Files(plate({1, 0, 1})), params).at("R");
    const double sent = 0.25 * 0.5 * (through(kO) + through(kE));
    // Reflected light of both modes at once comes back at 0° but for the difference of their r.
    EXPECT_GT(found, sent);
    const auto turnedBack = [](double n) { return (n - 1) / (n + 1); };
    const double first = 0.5 * 0.25 * std::pow(turnedBack(kO) - turnedBack(kE), 2);
    const auto later = [&](double n) { // from within, mode by mode
        const double R = turnedBack(n) * turnedBack(n);
        return (1 - R) * (1 - R) * R / (1 - R * R);
    };
    EXPECT_NEAR(found, sent + first + 0.25 * 0.5 * (later(kO) + later(kE)), 2e-4);
}

TEST(CrystalView, AThinPlateInterferes) {
    // Between crossed polarisers at 45°: sin²(δ/2) of half the light, and what was reflected inside
    // once and twice by two and three times the way. 20 voxels of 2 µm, n_e − n_o = 0.005, at 587.6
    // nm.
    const double n = 1.5, off = 0.005;
    const volume::Volume plate = crystalVolume(
        ivec3(48, 40, 48), {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, n,
                             crystalOf(n + off, {1, 0, 1})}});
    Params params = sharp::sharply(parallel({24, 100, 24}, {24, 0, 24}, 4, {1, 1}, {0, 0, 1}));
    params.background = dvec3(1);
    params.cutoff = 1e-6;
    params.polarizer = 0;
    params.backPolarizer = 90;
    params.wavelengths.count = 1;
    for (const double unit : {1e-6, 2e-6, 3.3e-6, 1e-5}) {
        params.unit = unit;
        const double delta = 2 * kPi * off * 20 * unit / 587.6e-9;
        const double R = std::pow((n - 1) / (n + 1), 2), T2 = (1 - R) * (1 - R);
        const auto pass = [&](int ways) { return 0.5 * std::pow(std::sin(0.5 * ways * delta), 2); };
        const double expected = T2 * (pass(1) + R * pass(2) + R * R * pass(3));
        // n_e's own R is 3 % of R more.
        EXPECT_NEAR(Look(scene::Files(plate), params).at("G"), expected, 1e-3) << unit;
    }
    // Parallel ones see what those do not; without a unit the mean over all phases is seen.
    params.unit = 0;
    const double mean = Look(scene::Files(plate), params).at("G");
    EXPECT_NEAR(mean, 0.25 * (1 - 0.04), 5e-3);
}

TEST(CrystalView, WhatIsNotTracedIsRefused) {
    const auto seen = [](volume::Volume volume, const dvec3& eye = {24, 100, 24}) {
        return Look(std::move(volume),
                    sharp::sharply(perspective(eye, {24, 0, 24}, 20, {1, 1}, {0, 0, 1})));
    };
    const volume::Crystal calcite = crystalOf(kE, {1, 1, 0});
    EXPECT_THROW(seen(boxOverWall(kO, calcite), {24, 20, 24}), DataError); // the eye within
    EXPECT_THROW(
        seen(crystalVolume(ivec3(24), {{"cut", [](dvec3 p) { return p.y - 8; }, kO, calcite}})),
        DataError);
    EXPECT_THROW(
        seen(crystalVolume(ivec3(24), {{"opaque", [](dvec3 p) { return glm::length(p - 12.0) - 8; },
                                        kO, calcite, 0, 0.5}})),
        DataError);
    for (const volume::Crystal& bad : {volume::Crystal{1.5F, 0, {0, 2, 0}, {0, 0, 0}},
                                       {0.9F, 0, {0, 1, 0}, {0, 0, 0}},
                                       {1.5F, 0, {0, 1, 0}, {0, -1, 0}},
                                       {NAN, 0, {0, 1, 0}, {0, 0, 0}}})
        EXPECT_THROW(seen(boxOverWall(kO, bad)), DataError);
    seen(boxOverWall(kO, volume::Crystal{1.5F, 0, {0, 0, 0}, {0, 0, 0}})); // none
    volume::Volume grids = boxOverWall(kO, calcite);
    const ivec3 size(48, 40, 48);
    grids.put("axis", {ivec3(0), size - 1},
              {size, 1, std::vector<float>(static_cast<size_t>(size.x) * size.y * size.z, 1)}, {});
    EXPECT_THROW(seen(std::move(grids)), DataError);
    Params blurred = parallel({24, 100, 24}, {24, 0, 24}, 30, {1, 1}, {0, 0, 1});
    blurred.boundary = optics::Boundary::blurred;
    EXPECT_THROW(Look(scene::Files(boxOverWall(kO, calcite)), blurred), DataError);
}
