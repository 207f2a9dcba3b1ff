// The judge's ball: Snell, Fresnel and fluence against what is known on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/snell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

using namespace judge;

namespace {

using std::numbers::pi;

double cellVolume(const Grid& grid) {
    return grid.voxel * grid.voxel * grid.voxel;
}

double sum(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
}

} // namespace

TEST(Boundary, FresnelByHand) {
    // Head-on: ((n − 1)/(n + 1))². At Brewster's angle, tan = n, no p is reflected, and s is
    // ((1 − n²)/(1 + n²))².
    const Reflectance front = reflectance(1.5, 1);
    EXPECT_NEAR(front.s, 0.04, 1e-15);
    EXPECT_NEAR(front.p, 0.04, 1e-15);
    const Reflectance brewster = reflectance(1.5, 1 / std::sqrt(1 + 2.25));
    EXPECT_NEAR(brewster.p, 0, 1e-15);
    EXPECT_NEAR(brewster.s, std::pow(1.25 / 3.25, 2), 1e-15);
    EXPECT_NEAR(reflectance(1.5, 0).mean(), 1, 1e-15);
    // From glass, past asin(1/1.5) = 41.8°: all.
    EXPECT_EQ(reflectance(1 / 1.5, std::cos(0.74)).mean(), 1);
    EXPECT_LT(reflectance(1 / 1.5, std::cos(0.72)).mean(), 1);
    // Both ways through a boundary reflect the same.
    const double sinT = 0.6 / 1.5;
    EXPECT_NEAR(reflectance(1.5, 0.8).s, reflectance(1 / 1.5, std::sqrt(1 - sinT * sinT)).s, 1e-15);
}

TEST(Ball, DeflectionsByHand) {
    // off = ½ √3, n = √3: incidence 60°, refraction 30°: straight through turns by 60°.
    const double off = std::sqrt(3.0) / 2, n = std::sqrt(3.0);
    EXPECT_NEAR(ballDeflection(n, off), pi / 3, 1e-14);
    EXPECT_NEAR(ballDeflection(n, off, 0), -pi / 3, 1e-14); // outside, away from the axis
    EXPECT_NEAR(ballDeflection(n, off, 2), pi, 1e-14);      // straight back
    // The rainbow of water, n = 4/3: least deflection of order 2 is 137.97° (Descartes), where
    // cos² of incidence is (n² − 1)/3.
    const double bow = std::sqrt(1 - (16.0 / 9 - 1) / 3);
    EXPECT_NEAR(ballDeflection(4.0 / 3, bow, 2) * 180 / pi, 137.97, 0.005);
    EXPECT_GT(ballDeflection(4.0 / 3, bow + 0.01, 2), ballDeflection(4.0 / 3, bow, 2));
    EXPECT_GT(ballDeflection(4.0 / 3, bow - 0.01, 2), ballDeflection(4.0 / 3, bow, 2));
    EXPECT_THROW(ballDeflection(0.7, 0.8), std::invalid_argument);
    EXPECT_THROW(ballDeflection(1.5, 1.1), std::invalid_argument);
}

TEST(Ball, OrdersShareThePower) {
    for (const double off : {0.0, 0.3, 0.8, 0.99}) {
        for (const bool polarised : {false, true}) {
            const auto share = ballOrders(1.5, off, polarised);
            // What is left after order 3 is T R³ of each polarisation: at most R³.
            const double r = reflectance(1.5, std::sqrt(1 - off * off)).s;
            const double rest = 1 - std::accumulate(share.begin(), share.end(), 0.0);
            EXPECT_GE(rest, -1e-15);
            EXPECT_LE(rest, r * r * r + 1e-15);
        }
    }
    const auto front = ballOrders(1.5, 0);
    EXPECT_NEAR(front[0], 0.04, 1e-15);
    EXPECT_NEAR(front[1], 0.96 * 0.96, 1e-15);
    EXPECT_NEAR(front[2], 0.96 * 0.96 * 0.04, 1e-15);
    EXPECT_NEAR(front[3], 0.96 * 0.96 * 0.0016, 1e-15);
    // At Brewster's angle p goes through whole, s does not: kept apart they let more through.
    const double off = 1.5 / std::sqrt(1 + 2.25);
    EXPECT_GT(ballOrders(1.5, off, true)[1], ballOrders(1.5, off, false)[1] + 1e-3);
}

TEST(Ball, CausticEndsInTheFocus) {
    EXPECT_DOUBLE_EQ(ballFocus(1.5, 20), 30);
    const Caustic cusp = ballCaustic(1.5, 20, 1e-6);
    // It leaves the cusp as off², across as off³.
    EXPECT_NEAR(cusp.along, 30, 1e-9);
    EXPECT_NEAR(cusp.across, 0, 1e-9);
    // Neighbouring rays meet on it: the slope agrees with differences, to h² times a third
    // derivative of some tens.
    for (const double off : {0.1, 0.4, 0.7}) {
        const double h = 1e-5;
        const double slope =
            (ballDeflection(1.5, off + h) - ballDeflection(1.5, off - h)) / (2 * h);
        EXPECT_NEAR(ballDeflectionSlope(1.5, off), slope, 1e-8);
        const Caustic at = ballCaustic(1.5, 20, off);
        const double turn = ballDeflection(1.5, off);
        EXPECT_NEAR(at.along * std::sin(turn) + at.across * std::cos(turn), 20 * off, 1e-12);
    }
}

TEST(Walk, LengthsAddUpAndCellsAreThoseOfTheirMiddles) {
    const Grid grid{{-3, 2, 1}, 0.7, {11, 8, 9}};
    const dvec3 low = grid.low, size = grid.high() - low;
    // Ends on and off the planes, within and without, along axes and diagonals.
    const std::vector<std::pair<dvec3, dvec3>> segments = {{{0.1, 0.2, 0.3}, {0.9, 0.7, 0.8}},
                                                           {{-1, 0.4, 0.4}, {2, 0.5, 0.6}},
                                                           {{0.5, 0.5, 1.5}, {0.5, 0.5, -0.5}},
                                                           {{0, 0, 0}, {1, 1, 1}},
                                                           {{1, 0, 1}, {0, 1, 0}},
                                                           {{0.3, 0.3, 0.3}, {0.3001, 0.3, 0.3}},
                                                           {{-1, -1, 0.5}, {-0.5, 2, 0.5}},
                                                           {{0.05, 1.2, 0.5}, {1.2, 0.02, 0.52}}};
    for (const auto& [a, b] : segments) {
        const dvec3 from = low + a * size, to = low + b * size;
        const dvec3 d = glm::normalize(to - from);
        // The part within the box, by clipping.
        double enter = 0, leave = glm::length(to - from);
        for (int i = 0; i < 3; ++i) {
            if (d[i] == 0) continue;
            const double t0 = (low[i] - from[i]) / d[i], t1 = (low[i] + size[i] - from[i]) / d[i];
            enter = std::max(enter, std::min(t0, t1)), leave = std::min(leave, std::max(t0, t1));
        }
        double t = enter;
        walk(grid, from, to, [&](size_t cell, double length) {
            const dvec3 x = from + (t + length / 2) * d;
            const ivec3 at = glm::clamp(ivec3((x - low) / grid.voxel), ivec3(0), grid.size - 1);
            if (length > 1e-9) {
                EXPECT_EQ(cell, grid.cell(at));
            }
            EXPECT_LE(length, grid.voxel * std::sqrt(3.0) + 1e-12);
            t += length;
        });
        EXPECT_NEAR(t, std::max(enter, leave), 1e-12);
    }
}

TEST(Fluence, PowerIsNeitherMadeNorLost) {
    const Grid grid{{0, 0, 0}, 1, {40, 24, 24}};
    for (const double index : {1.5, 0.75})
        for (const Fresnel fresnel : {Fresnel::None, Fresnel::Unpolarised, Fresnel::Polarised}) {
            BallScene scene{.centre = {14, 12, 12},
                            .radius = 7,
                            .index = index,
                            .direction = {1, 0.2, -0.1},
                            .irradiance = 3};
            scene.extinction = scene.extinctionAround = 0.05;
            scene.fresnel = fresnel;
            scene.photons = 2e4;
            Energy e;
            const auto fluence = ballFluence(scene, grid, &e);
            // Sums of 1e5 terms of one sign.
            EXPECT_NEAR((e.attenuated + e.escaped + e.reflected) / e.entered, 1, 1e-11);
            EXPECT_NEAR(sum(fluence) * cellVolume(grid) * 0.05 / e.attenuated, 1, 1e-11);
            EXPECT_EQ(e.reflected > 0, fresnel != Fresnel::None);
            // The light through a box: irradiance times its area across the light. Photons number
            // some 130 a voxel of it, and only those on the rim can be wrongly in or out.
            const dvec3 d = glm::normalize(scene.direction), size(grid.size);
            const double area = std::abs(d.x) * size.y * size.z + std::abs(d.y) * size.x * size.z +
                                std::abs(d.z) * size.x * size.y;
            EXPECT_NEAR(e.entered / (3 * area), 1, 1e-3);
        }
}

TEST(Fluence, WithoutABoundaryIsBeerAndLamberts) {
    // The ball's index is that around it; light along x in 20 slices.
    const Grid grid{{0, 0, 0}, 1, {20, 20, 20}};
    BallScene scene{.centre = {10, 10, 10}, .radius = 9, .index = 1, .irradiance = 2};
    scene.extinction = scene.extinctionAround = 0.1;
    scene.photons = 2e5;
    const auto fluence = ballFluence(scene, grid);
    for (int x = 0; x < 20; ++x) {
        double slice = 0;
        for (int y = 0; y < 20; ++y)
            for (int z = 0; z < 20; ++z) {
                const double f = fluence[grid.cell({x, y, z})];
                // A cell has 786 photons; a spiral's count errs like the cell's rim, some 28 seeds
                // long: by a few.
                EXPECT_NEAR(f / beerLambertMean(2, 0.1, x, x + 1), 1, 0.02);
                slice += f / 400;
            }
        EXPECT_NEAR(slice / beerLambertMean(2, 0.1, x, x + 1), 1, 1e-3); // the rim of 400 cells
    }
    EXPECT_NEAR(beerLambertMean(2, 0.1, 3, 3 + 1e-9), beerLambert(2, 0.1, 3), 1e-9);
    EXPECT_EQ(beerLambertMean(2, 0, 0, 5), 2);
}

TEST(Fluence, MeetsTheCountOfRaysInsideAndBehind) {
    // Photons in cells against the closed count of rays at points, over the cell by Simpson's
    // rule, whose points are on its corners, too.
    const Grid grid{{0, 0, 0}, 1, {64, 32, 32}};
    // A bubble, too: past its critical angle it reflects outwards, at the sides.
    for (const auto& [index, fresnel] :
         {std::pair(1.5, Fresnel::None), std::pair(1.5, Fresnel::Unpolarised),
          std::pair(1.5, Fresnel::Polarised), std::pair(0.6, Fresnel::Unpolarised)}) {
        BallScene scene{.centre = {16, 16, 16}, .radius = 12, .index = index, .irradiance = 1};
        scene.fresnel = fresnel;
        scene.photons = 2e5;
        const auto fluence = ballFluence(scene, grid);
        int compared = 0;
        double allPhotons = 0, allCounts = 0;
        for (int x = 0; x < 64; x += 7)
            for (int y = 16; y < 30; y += 3) {
                const ivec3 cell(x, y, 17);
                double mean = 0, least = 1e300, most = 0;
                for (int i = 0; i < 27; ++i) {
                    const dvec3 offset = 0.5 * dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
                    const auto weight = [](double o) { return o == 0 ? 4.0 / 6 : 1.0 / 6; };
                    const double f = ballFluenceAt(scene, grid.middle(cell) + offset);
                    mean += f * weight(offset.x) * weight(offset.y) * weight(offset.z);
                    least = std::min(least, f), most = std::max(most, f);
                }
                // Cells that hold an edge, the caustic or much of a slope are no place for points.
                if (most > 1.3 * least) continue;
                ++compared;
                // 442 photons a cell in plain light, whose number errs like the cell's rim, by 3 %;
                // where a bubble spreads twenty over it, by one in six. Shadows have none at all.
                const double error = 0.03 * mean + (mean > 0 ? 3.0 / 442 : 0) + 1e-12;
                EXPECT_NEAR(fluence[grid.cell(cell)], mean, error) << index << " " << x << " " << y;
                allPhotons += fluence[grid.cell(cell)], allCounts += mean;
            }
        EXPECT_GT(compared, 20);
        // Together the cells' errors cancel: tens of cells, each of 3 % or less.
        EXPECT_NEAR(allPhotons / allCounts, 1, 0.005) << index;
    }
}

TEST(Fluence, BrightestOnTheAxisShortOfTheFocus) {
    const Grid grid{{-20, -20.5, -20.5}, 1, {72, 41, 41}}; // an odd number: a row on the axis
    const BallScene scene{.radius = 18, .photons = 2e5};
    const auto fluence = ballFluence(scene, grid);
    int brightest = 40;
    for (int x = 40; x < 72; ++x)
        if (fluence[grid.cell({x, 20, 20})] > fluence[grid.cell({brightest, 20, 20})])
            brightest = x;
    // A cell of the axis takes in all the caustic from where it is half a voxel wide to its cusp.
    double off = 0;
    while (std::abs(ballCaustic(1.5, 18, off + 0.01).across) < 0.5) off += 0.01;
    const double focus = grid.middle({brightest, 20, 20}).x;
    EXPECT_LE(focus, ballFocus(1.5, 18) + 0.5);
    EXPECT_GE(focus, ballCaustic(1.5, 18, off).along - 0.5);
}

TEST(Fluence, BrightestOffTheAxisOnTheCaustic) {
    // A weak ball, whose caustic is wide where it leaves it. Along a row across the light fluence
    // rises towards the caustic from within and drops at once beyond it.
    const Grid grid{{-20, -20.5, -20.5}, 1, {60, 41, 41}};
    const BallScene scene{.radius = 18, .index = 1.25, .photons = 2e5};
    const auto fluence = ballFluence(scene, grid);
    for (double off = 0.7; off < 0.88; off += 0.05) {
        const Caustic caustic = ballCaustic(1.25, 18, off);
        const int x = static_cast<int>(std::floor(caustic.along - grid.low.x));
        const auto at = [&](int y) { return fluence[grid.cell({x, y, 20})]; };
        int edge = 22; // two voxels off the axis, which is bright itself
        for (int y = edge; y < 40; ++y)
            if (at(y) > at(edge)) edge = y;
        // Within a cell, whose size it is known to, and as much for the caustic's slope over it.
        EXPECT_NEAR(grid.middle({x, edge, 20}).y, std::abs(caustic.across), 1) << off;
        EXPECT_GT(at(edge), 1.5 * at(edge - 2)) << off;
        EXPECT_LT(at(edge + 2), 0.1 * at(edge)) << off;
    }
}

TEST(Fluence, InverseSquareOverCells) {
    EXPECT_DOUBLE_EQ(inverseSquare(8, 2), 2);
    EXPECT_DOUBLE_EQ(inverseSquare(8, 2, 0.5), 2 * std::exp(-1.0));
    // From afar the mean over a cube is the middle's value and its Laplacian's share:
    // f + side²/24 ∇²f, ∇²(1/r²) = 2/r⁴; the next term is (side/r)⁴.
    const double r = 50;
    EXPECT_NEAR(inverseSquareMean(1, {0, 0, 0}, {r - 0.5, -0.5, -0.5}, 1),
                1 / (r * r) * (1 + 1 / (12 * r * r)), 1e-10);
    // Near by, more slices change nothing: 8th order at a distance of a side.
    EXPECT_NEAR(inverseSquareMean(1, {0, 0, 0}, {1, -0.5, -0.5}, 1, 0.2, 2),
                inverseSquareMean(1, {0, 0, 0}, {1, -0.5, -0.5}, 1, 0.2, 4), 1e-8);
}

TEST(Fluence, RefusesABallBeyondTheGridAndExtinctionOnPaper) {
    const Grid grid{{0, 0, 0}, 1, {8, 8, 8}};
    EXPECT_THROW(ballFluence({.centre = {4, 4, 7}, .radius = 2}, grid), std::invalid_argument);
    EXPECT_THROW(ballFluenceAt({.extinction = 1}, {3, 0, 0}), std::invalid_argument);
}
