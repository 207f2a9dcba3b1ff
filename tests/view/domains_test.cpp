// Several domains in one picture, against the same objects in one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "support/boundary.h"
#include "support/glass_volume.h"
#include "view/placed.h"

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

image::Image sky() {
    return sharp::mapOf(
        [](dvec3 d) { return dvec3(1.2 + std::sin(5 * d.x), 1 + 0.8 * d.y, 0.6 + 0.5 * d.z); });
}

Params overThem(const ivec2& size) {
    Params params = sharp::sharply(perspective({20, 30, 120}, {20, 20, 20}, 30, size));
    params.aovs = allAovs();
    params.maxDepth = 32;
    return params;
}

/// Two balls, one behind the other, in one domain.
volume::Volume both() {
    TestVolume scene(ivec3(40, 40, 72));
    const auto put = [&](const std::string& name, const dvec3& middle, double radius,
                         double index) {
        scene.add(
            "sdf." + name, [=](dvec3 p) { return glm::length(p - middle) - radius; }, 1e3);
        scene.constant("ior." + name, index);
        scene.addVector("absorption." + name, [](dvec3) { return dvec3(0.01, 0.03, 0.002); });
    };
    put("a", {20, 20, 52}, 12, 1.5);
    put("b", {20, 22, 18}, 14, 1.33);
    scene.constant("ior", 1);
    return scene.take();
}

std::vector<Placed> apart() {
    return list(Placed{ballAt(ivec3(36), dvec3(18), 12, 1.5), shift({2, 2, 34})},
                Placed{ballAt(ivec3(40), dvec3(20), 14, 1.33), shift({0, 2, -2})});
}

} // namespace

TEST(Domains, RaysGoFromOneToTheNextAsThroughOne) {
    const ivec2 size(32, 32);
    for (const bool swapped : {false, true}) {
        std::vector<Placed> placed = apart();
        if (swapped) std::swap(placed[0], placed[1]);
        const Seen two(std::move(placed), overThem(size), sky());
        const Seen one(list(Placed{both()}), overThem(size), sky());
        ASSERT_EQ(two.plans.size(), 2u);
        EXPECT_FALSE(one.plans.front().several);
        int through = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto differs = [&](const char* channel) {
                    return std::abs(two.at(channel, x, y) - one.at(channel, x, y));
                };
                // Pixels on a rim may go either way.
                const double turned =
                    sharp::degreesBetween(two.vector("exit_direction.", "XYZ", x, y),
                                          one.vector("exit_direction.", "XYZ", x, y));
                if (turned > 1) continue;
                ++through;
                EXPECT_LT(turned, 0.01) << x << " " << y;
                for (const char* channel : {"R", "G", "B"})
                    EXPECT_LT(differs(channel), 2e-3) << x << " " << y << " " << channel;
                EXPECT_LT(differs("transmittance.G"), 1e-3);
                EXPECT_EQ(differs("A"), 0);
            }
        EXPECT_GT(through, size.x * size.y - 12);
    }
}

TEST(Domains, ARunRepeatsByteForByte) {
    const Seen first(apart(), overThem({24, 24}), sky()), again(apart(), overThem({24, 24}), sky());
    EXPECT_EQ(first.picture.pixels, again.picture.pixels);
}

TEST(Domains, WhatIsTurnedAndScaledIsSeenAsItLies) {
    // A prism turned about its edge by so much turns the rays that it deviates with it.
    const auto wedge = [] {
        TestVolume scene(ivec3(24));
        scene.add("sdf", [](dvec3 p) {
            return std::max({(p.x + 0.3 * p.y - 14) / std::hypot(1, 0.3), 6 - p.x,
                             std::abs(p.y - 12) - 9, std::abs(p.z - 12) - 9});
        });
        scene.constant("ior", 1.5);
        return scene.take();
    };
    const double angle = 0.4;
    const glm::dmat4 turned = shift({50, 10, 0}) *
                              glm::rotate(glm::dmat4(1), angle, dvec3(0, 0, 1)) *
                              glm::scale(glm::dmat4(1), dvec3(2)) * shift({-9, -12, -12});
    const dvec3 in(std::cos(angle), std::sin(angle), 0), middle(50, 10, 0);
    Params params = sharp::sharply(parallel(middle - 60.0 * in, middle, 1));
    // Beside it something else, far off.
    const Seen seen(list(Placed{ballAt(ivec3(20), dvec3(10), 6, 1.5), shift({0, 100, 0})},
                         Placed{wedge(), turned}),
                    params);
    const double lean = std::atan(0.3);
    const double out = std::asin(1.5 * std::sin(lean)) - lean; // towards +y of the file
    const dvec3 wanted(std::cos(angle + out), std::sin(angle + out), 0);
    const dvec3 found = seen.vector("exit_direction.", "XYZ", 0, 0);
    EXPECT_LT(
        std::min(sharp::degreesBetween(found, wanted),
                 sharp::degreesBetween(found, {std::cos(angle - out), std::sin(angle - out), 0})),
        0.01);
    EXPECT_GT(sharp::degreesBetween(found, in), 8);
}

TEST(Domains, AnEyeInTheSecondSeesOutOfIt) {
    Params params = sharp::sharply(perspective({20, 22, 18}, {20, 20, 52}, 40, {12, 12}));
    params.maxDepth = 32;
    params.background = dvec3(1);
    const Seen two(apart(), params), one(list(Placed{both()}), params);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) EXPECT_NEAR(two.at("G", x, y), one.at("G", x, y), 5e-3);
}

TEST(Domains, EmptySpaceIsCutOff) {
    const Seen seen(list(Placed{ballAt(ivec3(64), dvec3(40), 10, 1.5)},
                         Placed{ballAt(ivec3(20), dvec3(10), 6, 1.5), shift({100, 0, 0})}),
                    overThem({4, 4}), sky());
    EXPECT_LT(seen.plans[0].scene.size().x, 32);
}

TEST(Domains, OnesInOtherMediaAreRefused) {
    const auto planned = [&](std::vector<Placed> placed) {
        std::vector<scene::Files> files = filesOf(std::move(placed));
        return makePlans(files, overThem({4, 4}), false).size();
    };
    const ivec3 size(24);
    EXPECT_THROW(planned(list(Placed{ballAt(size, dvec3(12), 8, 1.5)},
                              Placed{ballAt(size, dvec3(12), 8, 1.5, 1.33), shift({100, 0, 0})})),
                 DataError);
    EXPECT_EQ(planned(list(Placed{ballAt(size, dvec3(12), 8, 1.5)},
                           Placed{ballAt(size, dvec3(12), 8, 1.5), shift({100, 0, 0})})),
              2u);
}

TEST(Domains, DisperseTogether) {
    // One of them by wavelength: the other, and what passes neither, keeps its colours.
    const auto glass = [](double dispersion) {
        TestVolume scene(ivec3(24));
        scene.add("sdf", [](dvec3 p) { return glm::length(p - 12.0) - 8; });
        scene.constant("ior", 1.5);
        scene.constant("dispersion", dispersion);
        return scene.take();
    };
    Params params = sharp::sharply(parallel({30, 12, 100}, {30, 12, 12}, 30, {40, 20}));
    params.aovs.clear();
    params.background = dvec3(1);
    const Seen seen(list(Placed{glass(0.01)}, Placed{glass(0), shift({40, 0, 0})}), params);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x)
            for (const char* channel : {"R", "G", "B"})
                EXPECT_NEAR(seen.at(channel, x, y), 1, 2e-3);
}
