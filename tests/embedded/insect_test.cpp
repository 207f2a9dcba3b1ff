// What is opaque within what is transparent: an insect in amber.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack.h"
#include "stage.h"

using namespace eikonal;
using namespace eikonal::embedded;

namespace {

class Insect : public Embedded {};
INSTANTIATE_TEST_SUITE_P(Embedded, Insect, testing::Values(Boundary::sharp, Boundary::blurred),
                         nameOf);

constexpr double kAmber = 1.54;
const dvec3 kAbsorption(0.15, 0.6, 2.1), kAlbedo(0.35, 0.5, 0.8), kSun(3, 2, 1);
// Level faces lie on quarters of voxels, by which mesh2vol counts what boxes cover.
constexpr double kTop = 20.25 * kVoxel, kBack = 12.25 * kVoxel; // the amber's, the insect's [unit]
const dvec3 kLow(0.4489, 6 * kVoxel, 0.4513), kHigh(1.5509, kBack, 1.5523); // the insect [unit]

/// Amber that goes on beyond the domain's sides, so that all light comes through its upper face or
/// its lower one.
volume::Volume litAmber(Boundary boundary) {
    Stage stage;
    voxelize::Material amber;
    amber.ior = kAmber;
    amber.absorption = kAbsorption;
    // The insect has the amber's index and absorption: blurred voxels are mixed of both, and of an
    // insect that absorbs nothing they would take 0.22 voxels' share less each way.
    voxelize::Material insect = mattOf(kAlbedo, kAmber);
    insect.absorption = kAbsorption;
    stage.objects = {boxOf("amber", {-0.5, 3.5 * kVoxel, -0.5}, {2.5, kTop, 2.5}, amber),
                     boxOf("insect", kLow, kHigh, insect)};
    return stage.make(boundary, {sunAlong({0, -1, 0}, kSun)});
}

/// The insect's size less what blurred edges reach: the smoothing's kernel has four voxels to
/// either side, a look-up one more. A distance's spline feels a crease three off.
double withinEdges(Boundary boundary, double x, double z) {
    const double edge = (boundary == Boundary::sharp ? 4 : 5) * kVoxel;
    return std::min({x - kLow.x, kHigh.x - x, z - kLow.z, kHigh.z - z}) - edge;
}

/// What the layers over the insect's back let through to a ray of that n sin θ, or from it.
Upward throughAmber(Boundary boundary, double sine, const dvec3& below) {
    const std::vector<Layer> layers{{0, 1}, {kTop - kBack, kAmber, kAbsorption}, {0, kAmber}};
    return boundary == Boundary::sharp ? sharpStack(layers, sine, below)
                                       : blurredStack(layers, sine, below, kSoftness);
}

} // namespace

TEST_P(Insect, ShowsWhatTheAmberLeavesOfTheLight) {
    // The sun is overhead; the eye looks aslant. The insect's back is lit through amber, and seen
    // through amber, in its place by Snell's law.
    const Boundary boundary = GetParam();
    const bool sharp = boundary == Boundary::sharp;
    const volume::Volume volume = litAmber(boundary);
    const dvec3 sight = glm::normalize(dvec3(0, -1, 0.8));
    view::Params params = viewAlong(boundary, sight, {1, kTop, 0.72}, 1.1, {11, 11});
    params.aovs = {"position"};
    const view::Look look(scene::Files(volume), params);
    const dvec3 fallen = kSun * throughAmber(boundary, 0, dvec3(1)).own;
    const auto [seen, mirrored, shift] =
        throughAmber(boundary, sight.z, kAlbedo / kPi * fallen / (kAmber * kAmber));
    // Blurred coefficients are taken in the middles of steps: a tenth of a voxel's absorption. And
    // |w|, whose square divides what is seen, is told by linear look-ups: 0.2 %, squared.
    const dvec3 share = sharp ? dvec3(1e-3) : 4e-3 + 0.1 * kVoxel * kAbsorption;
    int told = 0;
    forEachPixel(params, [&](int x, int y) {
        const dvec3 o = originOf(params, x, y), p = o + (o.y - kTop) / -sight.y * sight;
        if (withinEdges(boundary, p.x, p.z + shift) < 0) return;
        expectColour(look, x, y, seen, share);
        view::expectNear(look.position(x, y), {p.x, kBack, p.z + shift},
                         (sharp ? 1e-3 : 0.1) * kVoxel);
        ++told;
    });
    EXPECT_GT(told, 10);

    // What comes down beside it and is mirrored by the amber's lower face goes up beside it.
    const view::Params below = viewAlong(boundary, {0, 1, 0}, {1, 0.4, 1}, 1.5, {15, 15});
    const view::Look black(scene::Files(volume), below);
    told = 0;
    forEachPixel(below, [&](int x, int y) {
        const dvec3 o = originOf(below, x, y);
        if (withinEdges(boundary, o.x, o.z) < 0) return;
        view::expectNear(black.colour(x, y), dvec3(0), 1e-4);
        EXPECT_EQ(black.at("A", x, y), 1);
        ++told;
    });
    EXPECT_GT(told, 20);
}
