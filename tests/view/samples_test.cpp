// Linear look-ups of samples with their bias taken off, against plain ones: far better where the
// index is smooth, and no worse where it is not.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/closed.h"
#include "judge/trace.h"
#include "support/look.h"

#include <numbers>

using namespace eikonal;
using namespace eikonal::view;
using glm::dvec3;
using glm::ivec3;

namespace {

constexpr int kVoxels = 64, kPixels = 24;
constexpr dvec3 kMiddle(kVoxels / 2.0);
const dvec3 kTilted(0.1, 0.05, 1); // along no axis, so that no ray keeps to one voxel's phase

// What an error may be above another that is as large, by the rays that happen to be traced.
constexpr double kNoWorse = 1.02;

/// Parallel rays through a cube of voxels.
struct Bundle {
    judge::Medium medium;
    dvec3 through, direction;
    double half; ///< of the picture's height [voxel]
};

Params paramsOf(const Bundle& bundle) {
    return parallel(bundle.through - 4.0 * kVoxels * glm::normalize(bundle.direction),
                    bundle.through, 2 * bundle.half, {kPixels, kPixels});
}

judge::Ray rayOf(const Bundle& bundle, int x, int y) {
    const dvec3 forward = glm::normalize(bundle.direction);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
    const dvec3 up = glm::cross(right, forward);
    const double pixel = 2 * bundle.half / kPixels;
    const dvec3 place = bundle.through + (x + 0.5 - kPixels / 2.0) * pixel * right +
                        (kPixels / 2.0 - y - 0.5) * pixel * up;
    return {place - 4.0 * kVoxels * forward, forward};
}

/// Calls `visit` with each ray, and where it left by unbiased and by plain samples.
template<typename Visit> void follow(const Bundle& bundle, const Visit& visit) {
    std::vector<Look> looks;
    for (const bool plain : {false, true}) {
        TestVolume scene{ivec3(kVoxels)};
        scene.index(bundle.medium.index);
        Params params = paramsOf(bundle);
        params.plainSamples = plain;
        looks.emplace_back(scene.take(), params);
    }
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x)
            visit(rayOf(bundle, x, y), looks[0].place(x, y), looks[1].place(x, y));
}

/// The ratio of two errors' root mean squares.
struct Errors {
    double unbiased = 0, plain = 0;
    int count = 0;

    void add(double ofUnbiased, double ofPlain) {
        unbiased += ofUnbiased * ofUnbiased;
        plain += ofPlain * ofPlain;
        ++count;
    }
    double ratio() const { return std::sqrt(unbiased / plain); }
};

/// By the judge's exits.
double ratioOf(const Bundle& bundle) {
    Errors errors;
    follow(bundle, [&](const judge::Ray& ray, const dvec3& unbiased, const dvec3& plain) {
        const dvec3 exit = judge::trace(bundle.medium, ray, dvec3(0), dvec3(kVoxels), 1e-9).x;
        errors.add(glm::length(unbiased - exit), glm::length(plain - exit));
    });
    return errors.ratio();
}

/// n² of five plane waves of that length and somewhat more, along no axis.
judge::Medium waves(double length) {
    struct Wave {
        dvec3 k;
        double phase;
    };
    std::vector<Wave> all;
    for (const dvec3& direction : {dvec3(1, 0.2, 0.1), dvec3(-0.3, 1, 0.2), dvec3(0.1, -0.4, 1),
                                   dvec3(1, 1, 0.5), dvec3(-1, 0.4, 1)}) {
        const auto i = static_cast<double>(all.size());
        all.push_back({2 * std::numbers::pi / (length * (1 + 0.13 * i)) * glm::normalize(direction),
                       1.7 * i});
    }
    judge::Medium medium;
    medium.name = "waves of " + std::to_string(length) + " voxels";
    medium.index = [=](dvec3 p) {
        double square = 1.5;
        for (const Wave& wave : all) square += 0.01 * std::sin(glm::dot(wave.k, p) + wave.phase);
        return std::sqrt(square);
    };
    medium.force = [=](dvec3 p) {
        dvec3 force(0);
        for (const Wave& wave : all)
            force += 0.005 * std::cos(glm::dot(wave.k, p) + wave.phase) * wave.k;
        return force;
    };
    medium.longestStep = length / 8;
    return medium;
}

} // namespace

TEST(LinearSamples, AreNoWorseThanPlainOnesAtALensesRim) {
    // Rays that cross the rim's kink steeply, whose error is where the lattice happens to cut it,
    // and rays that graze it, whose error is how wide it is smeared.
    const double radius = 25.6;
    const dvec3 centre = kMiddle + dvec3(0.13, 0.09, 0.04);
    const std::pair<double, double> impacts[] = {
        {0, 0.3}, {0.3, 0.6}, {0.6, 0.8}, {0.8, 0.9}, {0.9, 0.95}};
    Errors errors[std::size(impacts)];
    for (const dvec3& direction : {dvec3(0, 0, -1), dvec3(0.3, -0.2, 1), dvec3(1, 1, 1),
                                   dvec3(0.5, 1, -0.2), dvec3(1, 1, 0.1)}) {
        const Bundle bundle{judge::luneburg(centre, radius), centre, direction, 0.95 * radius};
        follow(bundle, [&](const judge::Ray& ray, const dvec3& unbiased, const dvec3& plain) {
            const auto exit = judge::luneburgExit(centre, radius, ray);
            if (!exit) return;
            const dvec3 along = glm::normalize(exit->w);
            const auto off = [&](const dvec3& found) {
                const dvec3 d = found - exit->x;
                return glm::length(d - glm::dot(d, along) * along);
            };
            const double impact =
                glm::length(glm::cross(ray.x - centre, glm::normalize(ray.direction))) / radius;
            for (size_t i = 0; i < std::size(impacts); ++i)
                if (impact >= impacts[i].first && impact < impacts[i].second)
                    errors[i].add(off(unbiased), off(plain));
        });
    }
    for (size_t i = 0; i < std::size(impacts); ++i) {
        EXPECT_GT(errors[i].count, 100);
        EXPECT_LT(errors[i].ratio(), kNoWorse) << "impact from " << impacts[i].first;
    }
}

TEST(LinearSamples, AreNoWorseThanPlainOnesAtEdgesAndInShortWaves) {
    const dvec3 normal = glm::normalize(dvec3(0.6, 0.3, 1));
    std::vector<Bundle> all;
    for (const double sigma : {0.15, 0.3, 0.5}) { // [voxel]
        all.push_back({judge::step(kMiddle, normal, 1, 1.5, sigma), kMiddle, kTilted, 15});
        all.push_back({judge::blob(kMiddle, 20, sigma, 1.2), kMiddle, kTilted, 9.5});
    }
    for (const double length : {2, 3, 4}) all.push_back({waves(length), kMiddle, kTilted, 15});
    for (size_t i = 0; i < all.size(); ++i)
        EXPECT_LT(ratioOf(all[i]), kNoWorse) << i << ": " << all[i].medium.name;
}

TEST(LinearSamples, AreFarBetterThanPlainOnesWhereTheIndexIsSmooth) {
    struct Case {
        Bundle bundle;
        double most; // of the plain ones' error; found: 0.007, 0.033, 0.6, 0.2, 0.13
    };
    const Case cases[] = {
        {{judge::luneburgCore(kMiddle, 46), {30, 31, 0}, kTilted, 20}, 0.02},
        {{judge::layeredExponential(1, 0.6, -10, 12.5), {25, 10, 0}, {0.1, -0.15, 1}, 4.5}, 0.04},
        {{judge::maxwellFishEye(kMiddle, 22.5), {30, 31, 0}, kTilted, 12.5}, 0.65},
        {{judge::blob(kMiddle, 20, 3, 1.2), kMiddle, kTilted, 9.5}, 0.25},
        {{waves(10), kMiddle, kTilted, 15}, 0.15},
    };
    for (const auto& [bundle, most] : cases) EXPECT_LT(ratioOf(bundle), most) << bundle.medium.name;
}
