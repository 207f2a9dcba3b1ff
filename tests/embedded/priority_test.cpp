// Nested and overlapping objects: which of them is where, by what light meets on its way down.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack.h"
#include "stage.h"

#include <set>

using namespace eikonal;
using namespace eikonal::embedded;

namespace {

class Priorities : public Embedded {};
INSTANTIATE_TEST_SUITE_P(Embedded, Priorities, testing::Values(Boundary::sharp, Boundary::blurred),
                         nameOf);

const dvec3 kSun(3, 2, 1), kSky(0.3, 0.2, 0.1), kAlbedo(0.9, 0.6, 0.75);
constexpr double kGlass = 1.5;
const dvec3 kOfGlass(0.3, 0.1, 0.6);

/// A box across the domain's depth, between these corners [voxel].
struct Block {
    std::string name;
    double left, low, right, high;
    int priority;
    double ior;
    dvec3 absorption, emission{0};
};

/// Height above height, sorted so that every left or right side is ten voxels off the next.
std::vector<Block> blocks() {
    return {
        // Lost to the glass, which comes later.
        {"lost", -8, 3, 72, 9, 0, 1.2, {3, 3, 3}},
        // It wins over all but the bubble, though it comes before what it wins over.
        {"winning", 10, 8.25, 36, 18, 2, 1.33, {0.2, 1.1, 0.7}},
        {"glass", -8, -8, 72, 24, 0, kGlass, kOfGlass},
        {"glow", 22, 12, 58, 21.25, 1, 1.7, {1.3, 0.2, 0.5}, {0.4, 0.7, 0.3}},
        // It wins over what glows, at the same priority, by its place.
        {"later", 46, 6.25, 72, 15, 1, 1.6, {0.1, 0.9, 1.4}},
        // Nested in that, and of nothing.
        {"bubble", 46, 7.75, 72, 13.5, 3, 1, {0, 0, 0}},
    };
}

/// The layers below (x, 24), down to the floor at 4 voxels.
std::vector<Layer> layersAt(double x) {
    std::set<double, std::greater<>> heights{24, 4};
    const auto within = [](double a, double low, double high) { return a > low && a < high; };
    for (const Block& block : blocks())
        for (const double y : {block.low, block.high})
            if (within(x, block.left, block.right) && within(y, 4, 24)) heights.insert(y);
    std::vector<Layer> layers{{0, 1}};
    for (auto above = heights.begin(), below = std::next(above); below != heights.end();
         ++above, ++below) {
        const std::vector<Block> all = blocks();
        const Block* wins = nullptr;
        for (const Block& block : all)
            if (within(x, block.left, block.right) &&
                within(0.5 * (*above + *below), block.low, block.high) &&
                (!wins || block.priority >= wins->priority))
                wins = &block;
        layers.push_back({(*above - *below) * kVoxel, wins->ior, wins->absorption, wins->emission});
    }
    layers.push_back({0, kGlass});
    return layers;
}

} // namespace

TEST_P(Priorities, DecideWhatLightAndEyeMeet) {
    const Boundary boundary = GetParam();
    const bool sharp = boundary == Boundary::sharp;
    Stage stage;
    stage.bounds.max = {4, 1.75, 0.75};
    for (const Block& block : blocks()) {
        voxelize::Material material;
        material.ior = block.ior;
        material.absorption = block.absorption;
        material.emission = block.emission;
        stage.objects.push_back(
            boxOf(block.name, kVoxel * dvec3(block.left, block.low, -8 * kVoxel),
                  kVoxel * dvec3(block.right, block.high, 20), material, block.priority));
    }
    voxelize::Material floor = mattOf(kAlbedo, kGlass);
    floor.absorption = kOfGlass;
    stage.objects.push_back(
        boxOf("floor", kVoxel * dvec3(-8), kVoxel * dvec3(72, 4, 20), floor, 9));
    volume::Volume volume = stage.make(boundary);
    view::Params params = viewAlong(boundary, {0, -1, 0}, {2, 1.5, 0.375}, 0.0625, {64, 1});
    params.background = kSky;
    params.cutoff = 1e-6;
    const view::Look unlit(scene::Files(volume), params);
    light(volume, boundary, {sunAlong({0, -1, 0}, kSun)});
    const view::Look lit(std::move(volume), params);
    const double margin = sharp ? 4 : 6;
    int told = 0;
    forEachPixel(params, [&](int x, int y) {
        const double at = originOf(params, x, y).x / kVoxel;
        if (std::min(at, 64 - at) < margin) return;
        for (const Block& block : blocks())
            if (std::min(std::abs(at - block.left), std::abs(at - block.right)) < margin) return;
        const auto stack = [&](bool glows, const dvec3& below) {
            std::vector<Layer> layers = layersAt(at);
            for (Layer& layer : layers) layer.emission *= glows ? 1 : 0;
            return sharp ? sharpStack(layers, 0, below) : blurredStack(layers, 0, below, kSoftness);
        };
        const Upward glow = stack(true, dvec3(0));
        const dvec3 dark = glow.own + glow.mirrored * kSky;
        const dvec3 fallen = kSun * stack(false, dvec3(1)).own;
        const dvec3 seen = stack(false, kAlbedo / kPi * fallen / (kGlass * kGlass)).own;
        // The eye's ray goes straight down. The light on the floor comes from beside it, too: edges
        // are round by a voxel, and send a part of it aside, up to a ninth where most of them are.
        const dvec3 found = unlit.colour(x, y), added = lit.colour(x, y) - found;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], dark[c], sharp ? 1e-5 : 2e-3) << at << ' ' << c;
            EXPECT_NEAR(added[c], seen[c], (sharp ? 0.15 : 0.03) * seen[c]) << at << ' ' << c;
        }
        ++told;
    });
    EXPECT_GE(told, sharp ? 16 : 2);
}
