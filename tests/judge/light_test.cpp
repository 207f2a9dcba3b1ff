// The judge's light on floors against what is solved on paper, and against rays at random.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/floor_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <stdexcept>

using namespace judge;

namespace {

/// Fresnel's transmittance of unpolarised light, by the angles.
double transmitted(double incidence, double n) {
    if (incidence < 1e-6) return 4 * n / ((n + 1) * (n + 1));
    const double inside = std::asin(std::sin(incidence) / n);
    const double s = std::sin(incidence - inside) / std::sin(incidence + inside);
    const double p = std::tan(incidence - inside) / std::tan(incidence + inside);
    return 1 - 0.5 * (s * s + p * p);
}

double sum(const Texels& texels) {
    return texels.mean() * static_cast<double>(texels.values.size());
}

} // namespace

TEST(Texels, TakeTheirShareOfATriangle) {
    // What of a triangle lies on the texels, some of it beyond each edge; its area is 8.
    Texels power({0, 0}, {2, 2}, 4);
    layTriangle(power, {-1, -1}, {3, -1}, {-1, 3}, 8);
    EXPECT_NEAR(sum(power), 2, 1e-12); // half of the square
    EXPECT_NEAR(power.at({0.1, 0.1}), 1.0 / 16, 1e-12);
    EXPECT_NEAR(power.at({1.1, 0.9}), 0.5 / 16, 1e-12);
    EXPECT_EQ(power.at({1.6, 1.6}), 0);
    Texels row({0, 0}, {2, 2}, 4);
    layTriangle(row, {-0.4, 0.1}, {0.1, 0.1}, {0.1, 0.2}, 1); // across the left edge
    layTriangle(row, {2.4, 0.1}, {1.9, 0.1}, {1.9, 0.2}, 1);  // and across the right
    EXPECT_NEAR(row.at({0.1, 0.1}), 1 - 0.64, 1e-12);
    EXPECT_NEAR(row.at({1.9, 0.1}), 1 - 0.64, 1e-12);
    EXPECT_NEAR(sum(row), 2 * (1 - 0.64), 1e-12);
}

TEST(Texels, TakeATrianglesPowerWhereItHasNoArea) {
    Texels power({0, 0}, {2, 2}, 4);
    layTriangle(power, {0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}, 3);
    EXPECT_NEAR(power.at({0.1, 0.1}), 3, 1e-12);
    layTriangle(power, {0.5, 1.1}, {1, 1.1}, {0.75, 1.1}, 1);
    EXPECT_NEAR(power.at({0.6, 1.1}), 0.5, 0.1);
    EXPECT_NEAR(sum(power), 4, 1e-12);
}

TEST(Water, FlatItIsSnellsAndFresnels) {
    Water water;
    water.waves.clear();
    water.direction = {0, -1, 0};
    Texels texels({-1, -1}, {1, 1}, 8);
    irradianceUnder(water, texels);
    for (double value : texels.values) EXPECT_NEAR(value, 4 * 1.33 / (2.33 * 2.33), 1e-12);
    water.direction = {-0.6, -0.8, 0};
    irradianceUnder(water, texels);
    for (double value : texels.values)
        EXPECT_NEAR(value, 0.8 * transmitted(std::acos(0.8), 1.33), 1e-12);
    EXPECT_NEAR(irradianceUnderFlat(water), texels.values[0], 1e-12);
    Texels flat = texels;
    irradianceUnder(water, flat, Weighing::flatCosine);
    EXPECT_NEAR(flat.mean(), texels.mean(), 1e-12); // there the cosine is right
}

TEST(Water, ABoxsShadowIsSetAsideBySnell) {
    Water water;
    water.waves.clear();
    water.floor = -0.5;
    water.direction = {-0.6, -0.8, 0};
    // A sheet, so that its shadow is its own shape.
    water.boxLow = {-0.1, 0.2, -0.3}, water.boxHigh = {0.3, 0.2 + 1e-9, 0.2};
    Texels texels({-1, -1}, {1, 1}, 32);
    irradianceUnder(water, texels);
    const double inside = std::asin(0.6 / 1.33);
    const double aside = -0.2 * 0.6 / 0.8 - 0.5 * std::tan(inside);
    const double open = irradianceUnderFlat(water);
    const auto covered = [&](double from, double low, double high) {
        return std::clamp(std::min(from + texels.edge, high) - std::max(from, low), 0.0,
                          texels.edge) /
               texels.edge;
    };
    int edges = 0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            const double dark = covered(-1 + i * texels.edge, -0.1 + aside, 0.3 + aside) *
                                covered(-1 + j * texels.edge, -0.3, 0.2);
            edges += dark > 0 && dark < 1;
            // Patches on the edge are a 64th of a texel.
            EXPECT_NEAR(texels.values[static_cast<size_t>(64 * j + i)], open * (1 - dark),
                        open / 32);
        }
    EXPECT_GT(edges, 40);
    EXPECT_NEAR(sum(texels) * texels.edge * texels.edge, open * (4 - 0.4 * 0.5), 4e-4);
}

TEST(Water, AllThatIsTransmittedComesToTheFloor) {
    Water water;
    // As often over the floor as it is wide, so that what leaves at a side enters at the other.
    const double once = std::numbers::pi;
    water.waves = {{0.02, {2 * once, once}, 0.3}, {0.01, {-once, 3 * once}, 1}};
    Texels texels({-1, -1}, {1, 1}, 64);
    irradianceUnder(water, texels);
    const dvec3 d = glm::normalize(water.direction);
    double power = 0; // a periodic sum is exact to rounding
    constexpr int kPlaces = 64;
    for (int j = 0; j < kPlaces; ++j)
        for (int i = 0; i < kPlaces; ++i) {
            const dvec2 slope = water.slope(dvec2(i, j) * (2.0 / kPlaces));
            const dvec3 up(-slope.x, 1, -slope.y);
            const double across = -glm::dot(d, up);
            power += across * transmitted(std::acos(across / glm::length(up)), water.index);
        }
    EXPECT_NEAR(texels.mean(), power / (kPlaces * kPlaces), 1e-5);
}

TEST(Water, ItsCausticsAreThoseOfRays) {
    Water water;
    water.boxLow = {-0.5, 0.2, -0.3}, water.boxHigh = {-0.1, 0.35, 0.1};
    Texels texels({-1, -1}, {1, 1}, 8), counted = texels;
    irradianceUnder(water, texels);
    const dvec3 d = glm::normalize(water.direction);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    constexpr int kRays = 1500; // each way, over [−1.5, 1.5]²
    for (int j = 0; j < kRays; ++j)
        for (int i = 0; i < kRays; ++i) {
            const dvec2 at = (dvec2(i, j) + dvec2(uniform(random), uniform(random))) * 3.0 /
                                 static_cast<double>(kRays) -
                             1.5;
            const dvec3 x(at.x, water.height(at), at.y);
            // Backwards to the box's layer: it is so steep that both ends tell.
            bool shadowed = false;
            for (int k = 0; k <= 8 && !shadowed; ++k) {
                const double t = (0.2 + 0.15 * k / 8 - x.y) / -d.y;
                const dvec3 p = x - t * d;
                shadowed = p.x > -0.5 && p.x < -0.1 && p.z > -0.3 && p.z < 0.1;
            }
            if (shadowed) continue;
            const dvec3 n = water.normal(at);
            const double incidence = std::acos(-glm::dot(d, n));
            const double inside = std::asin(std::sin(incidence) / water.index);
            const dvec3 along = glm::normalize(d + std::cos(incidence) * n);
            const dvec3 t = std::sin(inside) * along - std::cos(inside) * n;
            const dvec3 end = x + (water.floor - x.y) / t.y * t;
            if (!counted.holds({end.x, end.z})) continue;
            const dvec2 p = (dvec2(end.x, end.z) - counted.low) / counted.edge;
            counted.values[static_cast<size_t>(p.y) * 16 + static_cast<size_t>(p.x)] +=
                -glm::dot(d, n) / n.y * transmitted(incidence, water.index) * 9 /
                (kRays * kRays * counted.edge * counted.edge);
        }
    double most = 0;
    for (size_t i = 0; i < texels.values.size(); ++i) {
        // Some 3900 jittered rays a texel.
        EXPECT_NEAR(texels.values[i], counted.values[i], 0.012);
        most = std::max(most, texels.values[i]);
    }
    EXPECT_GT(most, 1.3); // it is a caustic
    EXPECT_NEAR(texels.mean(), counted.mean(), 3e-4);
}

TEST(Water, TheCosineUnderFlatWaterIsNearlyThatOfEveryRay) {
    // docs/light-methods.md has the figures.
    Texels exact({-1, -1}, {1, 1}, 128), flat = exact;
    irradianceUnder(Water{}, exact);
    irradianceUnder(Water{}, flat, Weighing::flatCosine);
    double squares = 0, most = 0;
    for (size_t i = 0; i < exact.values.size(); ++i) {
        const double off = flat.values[i] / exact.values[i] - 1;
        squares += off * off / static_cast<double>(exact.values.size());
        most = std::max(most, std::abs(off));
    }
    EXPECT_NEAR(std::sqrt(squares), 0.0065, 1e-4);
    EXPECT_NEAR(most, 0.017, 1e-3);
    EXPECT_NEAR(flat.mean() / exact.mean(), 1.0009, 1e-4);
}

TEST(Water, WavesThatLightMeetsTwiceAreRefused) {
    Water water;
    water.waves = {{0.1, {10, 0}, 0}};
    Texels texels({-1, -1}, {1, 1}, 8);
    EXPECT_THROW(irradianceUnder(water, texels), std::invalid_argument);
    water = {};
    water.floor = -0.01;
    EXPECT_THROW(irradianceUnder(water, texels), std::invalid_argument);
}

TEST(BallOverPlane, PatchesBringWhatRaysBring) {
    BallOverPlane scene;
    scene.texels = 16;
    const std::vector<double> counted = irradianceUnder(scene, 2000);
    Texels texels({-1, -1}, {1, 1}, 8);
    irradianceUnder(scene, texels);
    double mean = 0;
    for (size_t i = 0; i < counted.size(); ++i) {
        // Some 2000 jittered rays a texel.
        EXPECT_NEAR(texels.values[i], counted[i], 0.012 * std::max(1.0, counted[i])) << i;
        mean += counted[i] / static_cast<double>(counted.size());
    }
    EXPECT_NEAR(texels.mean(), mean, 2e-4);
}

TEST(LightPatches, FinerOnesChangeNextToNothing) {
    // docs/light-methods.md has the figure.
    const double finer = 1.0 / 4096; // a quarter of the usual [texel]
    const auto change = [](const Texels& a, const Texels& b) {
        double squares = 0;
        for (size_t i = 0; i < a.values.size(); ++i) {
            const double off = a.values[i] - b.values[i], level = 0.1 * b.mean();
            squares += off * off / (b.values[i] * b.values[i] + level * level);
        }
        return std::sqrt(squares / static_cast<double>(a.values.size()));
    };
    Texels ball({-1, -1}, {1, 1}, 64), finerBall = ball, water = ball, finerWater = ball;
    irradianceUnder(BallOverPlane{}, ball);
    irradianceUnder(BallOverPlane{}, finerBall, finer);
    EXPECT_LT(change(ball, finerBall), 5e-4);
    irradianceUnder(Water{}, water);
    irradianceUnder(Water{}, finerWater, Weighing::exact, finer);
    EXPECT_LT(change(water, finerWater), 5e-4);
}

TEST(FloorView, ABallOfNoIndexIsNotSeen) {
    BallOverPlane scene;
    scene.index = 1;
    View view;
    view.width = 64, view.rows = 48, view.strata = 2;
    Floor floor;
    floor.fine = 64;
    const Picture picture = pictureOf(scene, floor, view);
    const double lit = 0.8 / std::numbers::pi / glm::length(dvec3(0.3, 1, 0.2));
    int bodies = 0, floors = 0;
    for (size_t i = 0; i < picture.radiance.size(); ++i) {
        bodies += picture.met[i] == Meets::through;
        floors += picture.met[i] == Meets::floor;
        // Texels on the shadow's edge have it taken away and given back by other patches.
        if (picture.met[i] != Meets::floor) continue;
        EXPECT_NEAR(picture.radiance[i], lit, 0.02 * lit);
    }
    EXPECT_GT(bodies, 300);
    EXPECT_GT(floors, 1000);
    EXPECT_NEAR(picture.radiance[46 * 64 + 32], lit, 1e-3 * lit);
    EXPECT_EQ(picture.radiance[0], 0); // above the floor's end
    // Through its middle the floor is seen as beside it.
    EXPECT_EQ(picture.met[30 * 64 + 32], Meets::through);
    EXPECT_NEAR(picture.radiance[30 * 64 + 32], lit, 0.02 * lit);
}

TEST(FloorView, FlatWaterDimsTheFloorBySnellAndFresnel) {
    Water water;
    water.waves = {{1e-12, {1, 0}, 0}};
    View view;
    view.eye = {0, 2, 0.001}, view.target = {0, 0, 0}, view.fov = 1;
    view.width = view.rows = 8, view.strata = 2;
    Floor floor;
    floor.extent = 1, floor.fine = 32;
    const Picture picture = pictureOf(water, floor, view);
    const double n = 1.33, across = 4 * n / ((n + 1) * (n + 1));
    const double wanted = across / (n * n) * 0.8 / std::numbers::pi * irradianceUnderFlat(water);
    for (double radiance : picture.radiance) EXPECT_NEAR(radiance, wanted, 1e-4 * wanted);
}

TEST(FloorView, WavesShowTheFloorWhereRaysMeetIt) {
    Water water;
    water.boxLow = {-0.5, 0.2, -0.3}, water.boxHigh = {-0.1, 0.3, 0.1};
    View view;
    view.eye = {0.3, 4e4, 1e-3}, view.target = {0.3, 0, 0}, view.fov = 2e-3; // upright rays
    view.width = view.rows = 32, view.strata = 1;
    Floor floor;
    floor.extent = 1.5, floor.fine = 64;
    const Picture picture = pictureOf(water, floor, view);
    Texels light({-1.5, -1.5}, {1.5, 1.5}, 64);
    irradianceUnder(water, light);
    const double pixel = 2 * 4e4 * std::tan(1e-3 * std::numbers::pi / 180) / 32;
    int all = 0, told = 0, dark = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const size_t i = static_cast<size_t>(32 * y + x);
            if (picture.met[i] != Meets::through) continue;
            const dvec2 at(0.3 + (x - 15.5) * pixel, (y - 15.5) * pixel);
            const dvec3 n = water.normal(at);
            const double incidence = std::acos(n.y), inside = std::asin(std::sin(incidence) / 1.33);
            const dvec2 downhill = incidence > 1e-9 ? -glm::normalize(dvec2(n.x, n.z)) : dvec2(0);
            const dvec2 end =
                at + (water.height(at) - water.floor) * std::tan(incidence - inside) * downhill;
            const double wanted = transmitted(incidence, 1.33) / (1.33 * 1.33) * 0.8 /
                                  std::numbers::pi * light.at(end);
            dark += wanted < 0.05;
            ++all;
            told += std::abs(picture.radiance[i] - wanted) < 1e-4 * wanted + 1e-9;
        }
    EXPECT_GT(dark, 4); // beside the box, which hides most of it
    EXPECT_GT(all, 800);
    EXPECT_GT(told, all - 10); // of those on a texel's edge rounding may take the next one
}
