// Emission within glass.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack.h"
#include "stage.h"

using namespace eikonal;
using namespace eikonal::embedded;

namespace {

class Glow : public Embedded {};
INSTANTIATE_TEST_SUITE_P(Embedded, Glow, testing::Values(Boundary::sharp, Boundary::blurred),
                         nameOf);

constexpr double kGlass = 1.5;
const dvec3 kAbsorption(0.1, 0.5, 1.7), kEmission(0.9, 0.4, 1.3), kOwn(0.8, 1.1, 0.2);
const dvec3 kSky(0.3, 0.5, 0.2);
constexpr double kTop = 20.25 * kVoxel, kBottom = 4.5 * kVoxel; // of the glass [unit]

/// Glass that goes on beyond the domain's sides.
voxelize::Object glassSheet() {
    voxelize::Material glass;
    glass.ior = kGlass;
    glass.absorption = kAbsorption;
    return boxOf("glass", {-1, kBottom, -1}, {3, kTop, 3}, glass);
}

voxelize::Material glowing(double ior) {
    voxelize::Material material;
    material.ior = ior;
    material.emission = kEmission;
    material.absorption = kOwn;
    return material;
}

/// What an eye sees above layers, and all round the sky.
dvec3 seenOf(Boundary boundary, const std::vector<Layer>& layers, double sine) {
    const Upward up = boundary == Boundary::sharp ? sharpStack(layers, sine, kSky)
                                                  : blurredStack(layers, sine, kSky, kSoftness);
    return up.own + up.mirrored * kSky;
}

/// Sharp: floats, and distances to a ball's facets. Blurred: coefficients are taken in the middles
/// of steps: a fifth of a voxel's change where they jump by up to 1.7 a unit.
dvec3 shareOf(Boundary boundary) {
    return dvec3(boundary == Boundary::sharp ? 3e-4 : 0.03);
}

} // namespace

TEST_P(Glow, ASheetOfAnotherIndexWithinGlass) {
    // Every order of reflection at four boundaries gathers emission again.
    const Boundary boundary = GetParam();
    const double index = 1.75, low = 8.25 * kVoxel, high = 14.5 * kVoxel;
    Stage stage;
    stage.objects = {glassSheet(), boxOf("glow", {-1, low, -1}, {3, high, 3}, glowing(index))};
    const volume::Volume volume = stage.make(boundary);
    const std::vector<Layer> layers{{0, 1},
                                    {kTop - high, kGlass, kAbsorption},
                                    {high - low, index, kOwn, kEmission},
                                    {low - kBottom, kGlass, kAbsorption},
                                    {0, 1}};
    for (const double slope : {0.0, 0.25, 0.6}) {
        const dvec3 sight = glm::normalize(dvec3(slope, -1, 0));
        view::Params params = viewAlong(boundary, sight, {1, kTop, 1}, 0.1, {2, 2});
        params.background = kSky;
        params.cutoff = 1e-6;
        const view::Look look(scene::Files(volume), params);
        const dvec3 wanted = seenOf(boundary, layers, sight.x);
        expectColour(look, 0, 1, wanted, shareOf(boundary));
    }
}

TEST_P(Glow, ABallWithinGlass) {
    // Of the glass's own index, seen straight down: a ray's way in it is a chord, down and, of what
    // the faces mirror, up again.
    const Boundary boundary = GetParam();
    const double radius = 6.3 * kVoxel;
    const dvec3 centre(1.013, 12.6 * kVoxel, 0.987);
    Stage stage;
    stage.objects = {glassSheet(), ballOf("glow", centre, radius, glowing(kGlass))};
    view::Params params = viewAlong(boundary, {0, -1, 0}, {1, kTop, 1}, 1, {16, 16});
    params.background = kSky;
    params.cutoff = 1e-6;
    const view::Look look(stage.make(boundary), params);
    forEachPixel(params, [&](int x, int y) {
        const dvec3 o = originOf(params, x, y);
        const double off = std::hypot(o.x - centre.x, o.z - centre.z);
        const double half = off < radius ? std::sqrt(radius * radius - off * off) : 0;
        const dvec3 wanted = seenOf(boundary,
                                    {{0, 1},
                                     {kTop - centre.y - half, kGlass, kAbsorption},
                                     {2 * half, kGlass, kOwn, kEmission},
                                     {centre.y - half - kBottom, kGlass, kAbsorption},
                                     {0, 1}},
                                    0);
        // Beside the ball's rim a blurred voxel is partly glass.
        if (boundary == Boundary::sharp ? std::abs(off / radius - 1) < 0.02
                                        : off > 0.7 * radius && off < radius + 3 * kVoxel)
            return;
        expectColour(look, x, y, wanted, shareOf(boundary));
    });
}
