// Several objects: a glass of wine, one boundary where two of them touch or overlap.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/glass_volume.h"

using namespace eikonal;
using namespace eikonal::sharp;
using namespace eikonal::view;

namespace {

constexpr double kGlass = 1.5, kWine = 1.34;
const dvec3 kCentre(31.63, 32.21, 31.87);
const std::vector<dvec3> kViews = {{0.05, -1, 0.1}, {1, 0.37, -0.21}, {-0.4, -1, 0.7}};

/// Bars of the requirements: 0.01° where a direction can be told, energy to 1e-4.
void expectJudges(const judge::Glass& glass, const Voxels& voxels, int least) {
    for (const dvec3& direction : kViews) {
        Params params = along(direction, kCentre, 50, {45, 45});
        params.background = dvec3(1);
        const Look look(volumeOf(glass, voxels), params);
        const auto counts = [&](const judge::Ray& ray) { return tellable(glass, ray); };
        const Off off = offOf(look, params, glass, counts);
        EXPECT_GE(off.rays, least);
        EXPECT_LT(off.degrees, 0.01)
            << off.worst.x.x << " " << off.worst.x.y << " " << off.worst.x.z;
        EXPECT_LT(off.optical, 0.05); // an air gap or a boundary missed were voxels
        int told = 0;
        EXPECT_LT(energyOff(look, params, glass, counts, &told), 1e-4);
        EXPECT_GT(told, 100);
    }
}

judge::Solid boxAround(const dvec3& low, const dvec3& high, double index, int priority) {
    return judge::glassBox(kCentre + low, kCentre + high, index, priority);
}

} // namespace

TEST(SharpObjects, WineInABlockOfGlass) {
    // The wine's box within the glass's: by its priority, or by its place after it.
    for (const int priority : {1, 0})
        expectJudges({{boxAround({-20, -22, -19}, {21, 20, 20}, kGlass, 0),
                       boxAround({-12, -14, -11}, {13, 12, 12}, kWine, priority)}},
                     {}, 200);
}

TEST(SharpObjects, OverlappingByHalf) {
    // Wine poured into the upper half of a block reaches out of it at the top, as meshes made to
    // overlap do; the higher priority wins, whichever comes first.
    const judge::Solid block = boxAround({-20, -20, -20}, {20, 6, 20}, kGlass, 2);
    const judge::Solid wine = boxAround({-20, -5, -20}, {20, 18, 20}, kWine, 1);
    expectJudges({{block, wine}}, {}, 200);
    expectJudges({{wine, block}}, {}, 200);
}

TEST(SharpObjects, TouchingFacesAreOneBoundary) {
    // Face to face in a plane between the lattice's, and on one of its planes.
    for (const double level : {0.0, -kCentre.y + 32.5})
        expectJudges({{boxAround({-20, -20, -20}, {20, level, 20}, kGlass, 0),
                       boxAround({-20, level, -20}, {20, 18, 20}, kWine, 0)}},
                     {}, 200);
}

TEST(SharpObjects, ABallInABall) {
    const judge::Glass glass{{judge::glassBall(kCentre, 24, kGlass, 0),
                              judge::glassBall(kCentre + dvec3(2, -1, 1.5), 14, kWine, 1)}};
    expectJudges(glass, {}, 200);
    // In bands as mesh2vol writes them.
    expectJudges(glass, {.halfWidth = 4}, 200);
}

TEST(SharpObjects, AShellAndWhatFillsIt) {
    // The shell's inner boundary is the wine's, told twice: of the judge's full ball and the ball
    // that wins in it the voxels have a hollow ball and what exactly fills it.
    const double inner = 15.2;
    const judge::Glass glass{
        {judge::glassBall(kCentre, 24, kGlass, 0), judge::glassBall(kCentre, inner, kWine, 1)}};
    Voxels voxels;
    voxels.distances = {[=](dvec3 x) {
        const double r = glm::length(x - kCentre);
        return std::max(r - 24, inner - r);
    }};
    expectJudges(glass, voxels, 200);
    // Whoever comes first where they touch, the boundary is one.
    const judge::Glass wineFirst{
        {judge::glassBall(kCentre, inner, kWine, 1), judge::glassBall(kCentre, 24, kGlass, 0)}};
    Voxels swapped;
    swapped.distances = {{}, voxels.distances[0]};
    expectJudges(wineFirst, swapped, 200);
}

TEST(SharpObjects, ABubbleInTheWineInTheGlass) {
    expectJudges({{judge::glassBall(kCentre, 26, kGlass, 0),
                   judge::glassBall(kCentre + dvec3(1, 2, -1), 20, kWine, 1),
                   judge::glassBall(kCentre + dvec3(-2, 1, 1), 11, 1, 2)}},
                 {}, 200);
}

TEST(SharpObjects, AnEyeInTheWine) {
    const judge::Glass glass{{boxAround({-20, -22, -19}, {21, 20, 20}, kGlass, 0),
                              boxAround({-12, -14, -11}, {13, 12, 12}, kWine, 1)}};
    const dvec3 d = glm::normalize(dvec3(0.2, -1, 0.3));
    Params params = sharply(view::parallel(kCentre, kCentre + d, 12, {21, 21}, {1, 0, 0}));
    params.background = dvec3(1);
    const Look look(volumeOf(glass), params);
    const auto counts = [&](const judge::Ray& ray) { return tellable(glass, ray); };
    const Off off = offOf(look, params, glass, counts);
    EXPECT_GT(off.rays, 200);
    EXPECT_LT(off.degrees, 0.01);                                            // the bar
    EXPECT_LT(energyOff(look, params, glass, counts), 1e-4 * kWine * kWine); // L/n² at the eye
}
