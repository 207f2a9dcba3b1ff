// Crystals that vary in space, against Hamilton's equations in long doubles, closed forms of liquid
// crystals and stressed plates, and crystals that do not vary.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/atomic_file.h"
#include "base/error.h"
#include "judge/varying_crystal.h"
#include "support/crystal_volume.h"
#include "support/glass_volume.h"
#include "support/look.h"
#include "support/photoelastic.h"
#include "support/scratch.h"
#include "support/tool.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr double kPi = 3.141592653589793;
const ivec3 kSize(40, 36, 40);
const dvec3 kLow(4, 6, 4), kHigh(36, 30, 36);

using Part = std::function<dvec3(dvec3)>;

/// A box whose crystal is given by grids; those that are left out are not there.
volume::Volume boxOf(const Part& axis, const Part& ordinary, const Part& extraordinary,
                     const Part& absorption = {}, const Part& absorptionE = {}) {
    volume::Volume volume = crystalVolume(
        kSize, {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, 1.5, {}}});
    if (axis) putField(volume, "axis.box", kSize, 3, axis);
    if (ordinary) putField(volume, "ior.box", kSize, 1, ordinary);
    if (extraordinary) putField(volume, "ior_extraordinary.box", kSize, 1, extraordinary);
    if (absorption) putField(volume, "absorption.box", kSize, 3, absorption);
    if (absorptionE) putField(volume, "absorption_extraordinary.box", kSize, 3, absorptionE);
    return volume;
}

Part one(double value) {
    return [=](dvec3) { return dvec3(value); };
}

Params down(double x = 20, double z = 20, double slant = 0) {
    const dvec3 along(slant, -1, 0.7 * slant);
    Params params = sharp::sharply(sharp::oneRay({dvec3(x, 34, z), glm::normalize(along)}));
    params.cutoff = 1e-6;
    return params;
}

/// Parallel polarised light down on the middle of the box, from a bright surrounding.
Params crossed(double first, double second) {
    Params params = sharp::sharply(parallel({20, 100, 20}, {20, 0, 20}, 2, {1, 1}, {0, 0, 1}));
    params.background = dvec3(1);
    params.cutoff = 1e-6;
    params.polarizer = first;
    params.backPolarizer = second;
    params.wavelengths.count = 1;
    return params;
}

/// A medium whose indices vary and whose axis turns.
judge::Tensor turning(const dvec3& x, bool bends) {
    const dvec3 p = (x - dvec3(20, 18, 20)) / 20.0;
    const double o = bends ? 1.62 + 0.05 * p.x - 0.04 * p.y * p.z : 1.62;
    return {o, 1.50 + 0.03 * p.z + 0.02 * p.x * p.y,
            glm::normalize(dvec3(1 + 0.4 * p.y, 0.8 + 0.5 * p.x, 0.3 - 0.9 * p.z + 0.4 * p.y))};
}

} // namespace

TEST(VaryingCrystal, RaysTurnAsHamiltonSays) {
    for (const bool bends : {true, false}) {
        const auto at = [=](const dvec3& x) { return turning(x, bends); };
        const volume::Volume volume = boxOf(
            [&](dvec3 x) {
                return (int(x.x) % 2 == 0 ? 1.0 : -1.0) * at(x).axis;
            }, // of either sign
            [&](dvec3 x) { return dvec3(at(x).o); }, [&](dvec3 x) { return dvec3(at(x).e); });
        for (const char mode : {'o', 'e'})
            for (const double slant : {0.0, 0.35}) {
                Params params = down(19.3, 20.6, slant);
                const judge::Ray ray{params.camera.eye,
                                     glm::normalize(params.camera.target - params.camera.eye)};
                const dvec3 entry = ray.x + (kHigh.y - ray.x.y) / ray.direction.y * ray.direction;
                // Light that is polarised as the wave is goes there first.
                judge::LightWave inside;
                dvec3 best(1, 0, 0);
                double most = 0;
                const dvec3 right = glm::normalize(glm::cross(ray.direction, params.camera.up));
                const dvec3 up = glm::cross(right, ray.direction);
                for (int degrees = 0; degrees < 180; degrees += 5) {
                    const double a = degrees * kPi / 180;
                    const dvec3 field = std::cos(a) * right + std::sin(a) * up;
                    for (const judge::LightWave& w :
                         judge::scattered(judge::isotropicWave(1, ray.direction, field), {0, -1, 0},
                                          {}, at(entry)))
                        if (w.mode == mode && w.power > most) {
                            most = w.power;
                            inside = w;
                            params.polarizer = degrees;
                        }
                }
                const judge::CrystalRay end = judge::throughCrystal(
                    at, mode, entry, inside.k, [](const dvec3& x) { return kLow.y - x.y; }, 0.1);
                EXPECT_LT(end.drift, 1e-9);
                judge::LightWave arrives =
                    judge::crystalWave(at(end.x), mode, glm::normalize(end.k));
                dvec3 left(0);
                for (const judge::LightWave& w :
                     judge::scattered(arrives, {0, -1, 0}, at(end.x), {}))
                    if (w.beyond) left = w.ray;
                const dvec3 out = end.x + end.x.y / -left.y * left;
                const Look look(scene::Files(volume), params);
                EXPECT_LT(glm::length(look.place() - out), 1e-4) << mode << slant << bends;
                EXPECT_LT(glm::length(look.direction() - left), 1e-5) << mode << slant << bends;
                if (mode == 'e' || bends) { // which is not the way of what does not vary
                    EXPECT_GT(glm::length(left - ray.direction), 0.01);
                }
            }
    }
}

TEST(VaryingCrystal, AxesAreTheWorlds) {
    // A volume that lies askew, and one that is placed so: all is as upright, but turned.
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.6, glm::normalize(dvec3(1, 2, -0.5)));
    const auto turned = [&](const dvec3& v) { return dvec3(turn * glm::dvec4(v, 0)); };
    const auto boxPlaced = [&](const glm::dmat4& placed) {
        volume::Volume volume = crystalVolume(
            kSize, {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); }, 1.62, {}}}, 1,
            placed);
        putField(volume, "axis.box", kSize, 3,
                 [&](dvec3 x) { return dvec3(placed * glm::dvec4(turning(x, false).axis, 0)); });
        putField(volume, "ior_extraordinary.box", kSize, 1,
                 [&](dvec3 x) { return dvec3(turning(x, false).e); });
        return volume;
    };
    Params params = down(19.3, 20.6, 0.2);
    params.polarizer = 40;
    const Look upright(scene::Files(boxPlaced(glm::dmat4(1))), params);
    params.camera.eye = turned(params.camera.eye);
    params.camera.target = turned(params.camera.target);
    params.camera.up = turned(params.camera.up);
    const volume::Volume straight = boxPlaced(glm::dmat4(1));
    scene::Files placed(straight);
    placed.place(turn);
    for (const Look& look : {Look(scene::Files(boxPlaced(turn)), params), Look(placed, params)}) {
        EXPECT_LT(glm::length(look.direction() - turned(upright.direction())), 1e-5);
        EXPECT_LT(glm::length(look.place() - turned(upright.place())), 1e-3);
    }
    EXPECT_GT(glm::length(upright.direction() - dvec3(0, -1, 0)), 0.01);
}

TEST(VaryingCrystal, ATwistedNematicCellIsAsGoochAndTarrySay) {
    // Gooch and Tarry 1975 (J. Phys. D 8:1575): T between the polarisers of a cell twisted by θ
    // whose first director is along the first one. Of an index near 1, so that little is reflected.
    const double n = 1.001, off = 0.008, thickness = kHigh.y - kLow.y;
    for (const double degrees : {90.0, 60.0}) {
        const double twist = degrees * kPi / 180;
        const Part director = [=](dvec3 x) {
            const double a = twist * (kHigh.y - x.y) / thickness;
            return dvec3(-std::cos(a), 0, std::sin(a));
        };
        const volume::Volume cell = boxOf(director, one(n), one(n + off));
        for (const double unit : {3e-7, 1e-6, 3e-6, 1e-5, 3e-5}) {
            Params params = crossed(0, degrees);
            params.unit = unit;
            // Half the retardation and the twist make a turn of X.
            const double half = kPi * off * thickness * unit / 587.6e-9;
            const double X = std::hypot(half, twist);
            // Of light along the director that comes out along the last one.
            const double expected =
                0.5 * (std::pow(std::cos(X), 2) + std::pow(half / X * std::sin(X), 2));
            EXPECT_NEAR(Look(scene::Files(cell), params).at("G"), expected, 1e-3) << unit;
            params.backPolarizer = degrees + 90;
            EXPECT_NEAR(Look(scene::Files(cell), params).at("G"), 0.5 - expected, 1e-3) << unit;
        }
        // Both indices more or less together along the way: the same, by steps.
        Params params = crossed(0, degrees);
        params.unit = 3e-6;
        const auto more = [=](double x) {
            return [=](dvec3 p) { return dvec3(x + 2e-5 * (p.y - 18)); };
        };
        const Look stepped(scene::Files(boxOf(director, more(n), more(n + off))), params);
        EXPECT_NEAR(stepped.at("G"), Look(scene::Files(cell), params).at("G"), 1e-4);
    }
}

TEST(VaryingCrystal, ACompressedDiscIsAsFrochtSays) {
    // A plate cut from the middle of a disc of radius 24 that two forces compress along z: the
    // stresses of Frocht 1948 (Photoelasticity II, §4.2), n along σ1 less n along σ2 is C (σ1 −
    // σ2).
    const double n = 1.001, R = 24, thickness = kHigh.y - kLow.y;
    const auto stressAt = [=](const dvec3& at) { return discStress({at.x - 20, at.z - 20}, R); };
    const double C = 0.02; // so that n_e − n_o is below 0.01 everywhere
    const volume::Volume plate = boxOf(
        [&](dvec3 x) {
            const glm::dvec2 first = stressAt(x).first;
            return dvec3(first.x, 0, first.y);
        },
        one(n), [&](dvec3 x) { return dvec3(n + C * stressAt(x).difference); });
    for (const double turned : {0.0, 30.0, 45.0})
        for (const glm::dvec2 at : {glm::dvec2(20, 20), {24.3, 17.2}, {13, 25.5}, {28.7, 26}}) {
            Params params = crossed(turned, turned + 90);
            params.camera.eye = {at.x, 100, at.y};
            params.camera.target = {at.x, 0, at.y};
            params.unit = 8e-6;
            const PlaneStress here = stressAt({at.x, 0, at.y});
            const double half = kPi * C * here.difference * thickness * params.unit / 587.6e-9;
            const double angle = std::atan2(here.first.y, -here.first.x) - turned * kPi / 180;
            const double expected = 0.5 * std::pow(std::sin(2 * angle) * std::sin(half), 2);
            EXPECT_NEAR(Look(scene::Files(plate), params).at("G"), expected, 1e-3)
                << turned << " " << at.x << " " << half;
        }
}

TEST(VaryingCrystal, WhatDoesNotVaryIsAsByMetadata) {
    const dvec3 axis = glm::normalize(dvec3(0.3, 0.5, -0.8));
    const auto near = [](const Part& value, const dvec3& other) { // but in a corner, of no ray's
        return [=](dvec3 x) { return x.x < 8 && x.z < 8 ? other : value(x); };
    };
    const auto uniform = [&](double e, double sigmaO, double sigmaE) {
        return crystalVolume(kSize, {{"box", [](dvec3 p) { return boxDistance(p, kLow, kHigh); },
                                      1.5, crystalOf(e, axis, sigmaE), sigmaO}});
    };
    const auto turned = [&](dvec3) { return axis; };
    for (const double e : {1.42, 1.506}) {
        Params params = crossed(20, 95);
        params.camera.eye = {45, 100, 50};
        params.camera.target = {20, 18, 20};
        params.unit = e > 1.5 ? 4e-6 : 0;
        const double sigmaE = e > 1.5 ? 0.01 : 0.05;
        const Look plain(scene::Files(uniform(e, 0.01, sigmaE)), params);
        const Look grids(scene::Files(boxOf(turned, one(1.5), one(e), one(0.01), one(sigmaE))),
                         params);
        EXPECT_EQ(plain.picture.pixels, grids.picture.pixels);
        const volume::Volume volume =
            boxOf(near(turned, {1, 0, 0}), near(one(1.5), dvec3(1.51)), near(one(e), dvec3(1.515)),
                  one(0.01), e > 1.5 ? Part() : near(one(sigmaE), dvec3(0.3)));
        const Look varying(scene::Files(volume), params);
        EXPECT_GT(plain.at("G"), 0.05);
        EXPECT_NEAR(varying.at("G"), plain.at("G"), 2e-4);
        EXPECT_NEAR(varying.at("optical_path_length.V"), plain.at("optical_path_length.V"), 1e-3);
    }
}

TEST(VaryingCrystal, ModesAreAbsorbedByGrids) {
    const double n = 1.001, d = kHigh.y - kLow.y;
    Params params = down();
    params.background = dvec3(1);
    const volume::Volume volume = boxOf([](dvec3) { return dvec3(1, 0, 0); }, one(n),
                                        [=](dvec3 x) { return dvec3(n + 0.05 + 1e-4 * x.z); },
                                        [](dvec3 x) { return dvec3(0.1 + 0.002 * (x.y - 18)); },
                                        [](dvec3 x) { return dvec3(0.02 + 0.001 * (x.y - 18)); });
    const double R = std::pow(0.052 / 2.054, 2); // of the e-wave, both ways
    const double expected = 0.5 * (std::exp(-0.1 * d) + (1 - 2 * R) * std::exp(-0.02 * d) +
                                   R * (1 + std::exp(-0.04 * d)));
    EXPECT_NEAR(Look(scene::Files(volume), params).at("R"), expected, 2e-4);
}

TEST(VaryingCrystal, WhatIsIsotropicIsGlass) {
    // No axis, or one index: an object whose index varies, or none.
    const Part bent = [](dvec3 x) { return dvec3(1.5 + 0.002 * x.x); };
    const volume::Volume glass = boxOf({}, bent, {});
    const Look expected(scene::Files(glass), down());
    EXPECT_EQ(Look(scene::Files(boxOf(one(0), bent, one(1.7))), down()).picture.pixels,
              expected.picture.pixels);
    EXPECT_EQ(Look(scene::Files(boxOf([](dvec3) { return dvec3(0, 1, 0); }, bent, bent)), down())
                  .picture.pixels,
              expected.picture.pixels);
}

TEST(VaryingCrystal, WhatIsNotTracedIsRefused) {
    const Part axis = [](dvec3 x) { return x.y < 18 ? dvec3(1, 0, 0) : dvec3(0, 0, 1); };
    const auto refused = [](volume::Volume volume, const std::string& word) {
        try {
            Look(std::move(volume), down());
            ADD_FAILURE() << word;
        } catch (const DataError& error) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused(boxOf(axis, one(1.5), {}), "none of 'ior_extraordinary'");
    refused(boxOf({}, one(1.5), one(1.6)), "none of 'axis'");
    refused(boxOf({}, one(1.5), {}, {}, one(0.1)), "none of 'axis'");
    refused(boxOf([](dvec3 x) { return dvec3(0, x.y < 18 ? 1 : 1.002, 0); }, one(1.5), one(1.6)),
            "has the length 1.002");
    refused(boxOf(one(0.1), one(1.5), one(1.6)), "has the length");
    refused(boxOf(axis, one(1.5), [](dvec3 x) { return dvec3(x.y < 18 ? 1.2 : 0.9); }),
            "expected 1 or more");
    refused(boxOf(axis, one(1.5), one(0.9)), "expected 1 or more");
    refused(boxOf(axis, one(1.5), one(1.5), {}, one(0.1)), "absorbs by its axis");
    volume::Volume stray = boxOf(axis, one(1.5), one(1.6));
    putField(stray, "axis", kSize, 3, axis);
    refused(std::move(stray), "'axis.NAME'");
    volume::Volume nobody = boxOf(axis, one(1.5), one(1.6));
    putField(nobody, "axis.ball", kSize, 3, axis);
    refused(std::move(nobody), "named as an object");
    Params blurred = down();
    blurred.boundary = optics::Boundary::blurred;
    EXPECT_THROW(Look(boxOf(axis, one(1.5), one(1.6)), blurred), DataError);
}

class VaryingCrystalFiles : public ScratchTest {};

TEST_F(VaryingCrystalFiles, BadOnesAreRefusedInOneLine) {
    const Part axis = [](dvec3 x) { return x.y < 18 ? dvec3(1, 0, 0) : dvec3(0, 0, 1); };
    const auto write = [&](const volume::Volume& volume) {
        AtomicFile out(at("bad.vdb"));
        volume.write(out, {"tester", "1", "tester"});
        out.commit();
    };
    write(boxOf(axis, one(1.5), {}));
    refused(65, {"bad.vdb", "none of 'ior_extraordinary'"},
            "render bad.vdb -o out.exr --eye 0,0,90 --target 0,0,0 --fov 20 --size 4x4", folder);
    write(boxOf(one(0.5), one(1.5), one(1.6)));
    refused(65, {"bad.vdb", "grid 'axis'", "has the length 0.866"},
            "lightsim bad.vdb -o out.vdb --light directional:0,-1,0", folder);
    write(boxOf(axis, one(1.5), one(0.9)));
    refused(65, {"bad.vdb", "ior_extraordinary", "expected 1 or more"},
            "render bad.vdb -o out.exr --eye 0,0,90 --target 0,0,0 --fov 20 --size 4x4", folder);
}
