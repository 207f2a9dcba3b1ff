// Several domains that overlap, against the same objects in one.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "support/glass_volume.h"
#include "support/ground_stage.h"
#include "support/lit.h"
#include "view/placed.h"

#include <glm/vector_relational.hpp>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

namespace {

/// Two balls, each partly in the other: where they lie in the world.
const dvec3 kFirst(25, 26, 38), kSecond(27, 28, 24);
constexpr double kRadius = 13;

judge::Solid ball(const dvec3& middle, double index, int priority = 0) {
    return judge::glassBall(middle, kRadius, index, priority);
}

/// A ball in a domain of its own, its voxels so large, turned, and its middle at `middle`.
Placed alone(const dvec3& middle, double index, int priority, double voxelSize, double angle) {
    const double low = 18.3; // the ball's middle from the low corner [voxel]
    judge::Glass glass{{judge::glassBall(dvec3(low), kRadius / voxelSize, index, priority)}};
    sharp::Voxels voxels;
    voxels.size = ivec3(37);
    voxels.voxelSize = voxelSize;
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), angle, glm::normalize(dvec3(1, 2, 3)));
    return {sharp::volumeOf(glass, voxels),
            shift(middle) * turned * shift(-dvec3(low * voxelSize))};
}

Placed together(int firstPriority) {
    sharp::Voxels voxels;
    voxels.size = ivec3(54, 54, 62);
    return {sharp::volumeOf({{ball(kFirst, 1.5, firstPriority), ball(kSecond, 1.33)}}, voxels)};
}

Params overThem(const ivec2& size) {
    Params params = sharp::sharply(perspective({26, 40, 130}, {26, 27, 31}, 22, size));
    params.maxDepth = 16;
    return params;
}

image::Image sky() {
    return sharp::mapOf(
        [](dvec3 d) { return dvec3(1.2 + std::sin(5 * d.x), 1 + 0.8 * d.y, 0.6 + 0.5 * d.z); });
}

/// How many pixels of two pictures are alike in direction to 0.05 degree and in colour to 2 %:
/// turned and scaled voxels are another sampling of the same distances.
int alike(const Seen& found, const Seen& wanted, const ivec2& size) {
    int count = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const double turned =
                sharp::degreesBetween(found.vector("exit_direction.", "XYZ", x, y),
                                      wanted.vector("exit_direction.", "XYZ", x, y));
            const dvec3 off =
                glm::abs(dvec3(found.at("R", x, y), found.at("G", x, y), found.at("B", x, y)) -
                         dvec3(wanted.at("R", x, y), wanted.at("G", x, y), wanted.at("B", x, y)));
            count += turned < 0.05 && glm::all(glm::lessThan(off, dvec3(0.02)));
        }
    return count;
}

} // namespace

TEST(Overlaps, AreSeenAsOneVolumeOfAllTheirObjects) {
    const ivec2 size(32, 32);
    const Seen wanted(list(together(0)), overThem(size), sky());
    const Seen found(list(alone(kFirst, 1.5, 0, 1, 0.4), alone(kSecond, 1.33, 0, 0.9, -0.7)),
                     overThem(size), sky());
    ASSERT_EQ(found.plans.size(), 1u);
    EXPECT_FALSE(found.plans.front().several);
    // Pixels on rims may go either way.
    EXPECT_GT(alike(found, wanted, size), size.x * size.y - 20);
}

TEST(Overlaps, TheLaterWinsUnlessTheEarlierHasPriority) {
    const ivec2 size(32, 32);
    const auto seen = [&](bool swapped, int firstPriority) {
        std::vector<Placed> placed =
            list(alone(kFirst, 1.5, firstPriority, 1, 0), alone(kSecond, 1.33, 0, 1, 0.2));
        if (swapped) std::swap(placed[0], placed[1]);
        return Seen(std::move(placed), overThem(size), sky());
    };
    const Seen second(list(together(0)), overThem(size), sky()),
        first(list(together(1)), overThem(size), sky());
    const int most = size.x * size.y - 20;
    // The two pictures that they are held against differ.
    ASSERT_LT(alike(first, second, size), size.x * size.y - 100);
    EXPECT_GT(alike(seen(false, 0), second, size), most);
    EXPECT_GT(alike(seen(true, 0), first, size), most);
    EXPECT_GT(alike(seen(false, 1), first, size), most);
    EXPECT_GT(alike(seen(true, 1), first, size), most);
}

TEST(Overlaps, AGroundGoesOnRoundThem) {
    GroundStage stage;
    stage.size = ivec3(24);
    stage.placed = shift({-12, -4, -12});
    stage.ground = {0, {0.8, 0.5, 0.2}, 5};
    const std::string lights = "upward:1,1,1";
    Params params = sharp::sharply(parallel({0, 60, 0}, {0, 0, 0}, 64, {64, 64}, {0, 0, -1}));
    const Seen bare(list(Placed{stage.make(lights)}), params);
    // Balls sunk into the ground, one of them across the side of its domain.
    for (const dvec3& middle : {dvec3(0, 4, 0), dvec3(14, 4, 3)}) {
        const Seen seen(list(Placed{ballAt(ivec3(16), dvec3(8), 5, 1.5), shift(middle - 8.0)},
                             Placed{stage.make(lights)}),
                        params);
        ASSERT_EQ(seen.plans.size(), 1u);
        int beside = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const dvec3 at(x - 31.5, 0, y - 31.5);
                if (glm::length(at - dvec3(middle.x, 0, middle.z)) < 5.2) continue;
                ++beside;
                for (const char* channel : {"R", "G", "B"})
                    EXPECT_NEAR(seen.at(channel, x, y), bare.at(channel, x, y), 1e-5)
                        << x << " " << y << " " << channel;
            }
        EXPECT_GT(beside, 64 * 64 - 100);
    }
}

TEST(Overlaps, OpaqueObjectsKeepTheLightThatWasStoredOnThem) {
    const auto lit = [] {
        TestVolume scene(ivec3(32));
        scene.add("sdf", [](dvec3 p) { return glm::length(p - 16.0) - 9; });
        scene.constant("ior", 1);
        scene.constant("opacity", 1);
        scene.constantVector("albedo", {0.9, 0.5, 0.3});
        volume::Volume volume = scene.take();
        lightsim::Params light = lightsim::paramsOf({lightsim::beam({-1, -2, -1})});
        light.outputs = lightsim::Output::irradiance;
        const lightsim::Lit found(volume, light);
        volume.putFine("irradiance", volume.domain(), found.result.irradiance);
        return Placed{std::move(volume)};
    };
    const Params params = sharp::sharply(parallel({16, 60, 70}, dvec3(16), 28, {28, 28}));
    const Seen wanted(list(lit()), params);
    // Something clear beside it, whose voxels are finer.
    const judge::Glass clear{{judge::glassBall(dvec3(10), 6, 1.5)}};
    const Seen seen(
        list(lit(), Placed{sharp::volumeOf(clear, {ivec3(20), 0.7}), shift({24, 6, -6})}), params);
    ASSERT_EQ(seen.plans.size(), 1u);
    ASSERT_FALSE(seen.plans.front().warnings.empty());
    double sum = 0, off = 0;
    for (int y = 0; y < 28; ++y)
        for (int x = 0; x < 28; ++x) {
            if (std::hypot(x - 13.5, y - 13.5) > 8) continue; // the middle of the ball
            sum += wanted.at("R", x, y);
            off += std::abs(seen.at("R", x, y) - wanted.at("R", x, y));
        }
    EXPECT_GT(sum, 20);
    EXPECT_LT(off, 0.01 * sum);
}

TEST(Overlaps, OnesThatCannotBeOneAreRefused) {
    const auto refusal = [&](std::vector<Placed> placed, bool sharply) -> std::string {
        std::vector<scene::Files> files = filesOf(std::move(placed));
        Params params = overThem({4, 4});
        if (!sharply) params.boundary = optics::Boundary::blurred;
        try {
            makePlans(files, params, false);
        } catch (const DataError& error) {
            return error.what();
        }
        return "";
    };
    const auto clear = [] { return Placed{ballAt(ivec3(24), dvec3(12), 8, 1.5)}; };
    const auto beside = [](volume::Volume volume) {
        return Placed{std::move(volume), shift({10, 0, 0})};
    };
    EXPECT_EQ(refusal(list(clear(), beside(clear().volume)), true), "");
    EXPECT_NE(refusal(list(clear(), beside(clear().volume)), false).find("blurred"),
              std::string::npos);
    TestVolume fog(ivec3(24));
    fog.add("sdf.a", [](dvec3 p) { return glm::length(p - 12.0) - 8; });
    fog.constant("ior.a", 1.5);
    fog.constantVector("scattering.medium", dvec3(0.01));
    EXPECT_NE(refusal(list(clear(), beside(fog.take())), true).find("medium"), std::string::npos);
    const auto stage = [](double y) {
        GroundStage made;
        made.ground = {y, dvec3(0.5), 0};
        return made.make();
    };
    EXPECT_EQ(refusal(list(Placed{stage(3)}, Placed{stage(3)}), true), "");
    EXPECT_NE(refusal(list(Placed{stage(3)}, Placed{stage(4)}), true).find("ground"),
              std::string::npos);
    EXPECT_NE(refusal(list(Placed{stage(3), shift({0, 1, 0})}, clear()), true).find("ground"),
              std::string::npos);
}
