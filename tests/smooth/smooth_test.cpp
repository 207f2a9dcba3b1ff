// The Gaussian against its closed form, and what smoothing leaves alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth/smooth.h"

#include "base/error.h"
#include "smooth/kernel.h"
#include "support/device.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace eikonal;
using glm::ivec3;

namespace {

volume::DenseGrid filled(ivec3 size, const std::function<double(ivec3)>& value) {
    volume::DenseGrid grid;
    grid.size = size;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                grid.values.push_back(static_cast<float>(value({x, y, z})));
    return grid;
}

float at(const volume::DenseGrid& grid, ivec3 p, int component = 0) {
    const auto voxel = (static_cast<size_t>(p.z) * grid.size.y + p.y) * grid.size.x + p.x;
    return grid.values[voxel * static_cast<size_t>(grid.components) + component];
}

volume::DenseGrid smoothed(volume::DenseGrid grid, double sigma, int width,
                           std::int64_t slabBytes = std::int64_t{1} << 40) {
    smooth::Plan plan;
    plan.size = grid.size;
    plan.weights = smooth::gaussianWeights(sigma, width);
    plan.items.push_back({"a", {}, std::move(grid)});
    Stats stats;
    return smooth::run(device(), std::move(plan), stats, {}, slabBytes).at(0).values;
}

/// The weight k voxels off the centre, independently of kernel.cpp.
double weightOf(int k, double sigma, int width) {
    double sum = 0;
    for (int i = -width / 2; i <= width / 2; ++i) sum += std::exp(-i * i / (2 * sigma * sigma));
    return std::abs(k) > width / 2 ? 0 : std::exp(-k * k / (2 * sigma * sigma)) / sum;
}

struct Shape {
    double sigma;
    int width;
};
const Shape kShapes[] = {{1.5, 9}, {0.7, 5}, {3, 19}, {1.5, 3}, {2, 1}};

} // namespace

TEST(SmoothKernel, WeightsAreAGaussianThatSumsToOne) {
    for (const auto& [sigma, width] : kShapes) {
        const auto weights = smooth::gaussianWeights(sigma, width);
        ASSERT_EQ(weights.size(), static_cast<size_t>(width / 2 + 1));
        double sum = weights[0];
        for (size_t k = 1; k < weights.size(); ++k) {
            sum += 2 * weights[k];
            // Two ways to write one quotient in double: a few roundings apart.
            EXPECT_NEAR(weights[k], weightOf(static_cast<int>(k), sigma, width), 1e-15);
        }
        EXPECT_NEAR(sum, 1, 1e-15); // as above
    }
}

TEST(SmoothKernel, SigmaIsTheStandardDeviation) {
    // Truncated to 3 sigma either side, a Gaussian loses 2 · 3 φ(3) / (2 Φ(3) − 1) = 2.7 % of its
    // variance; with the taps at whole voxels the half tap at either end brings some of it back.
    for (const double sigma : {1.5, 3.0, 12.0}) {
        smooth::Params params;
        params.sigma = sigma;
        const auto weights = smooth::gaussianWeights(sigma, params.width());
        double variance = 0;
        for (size_t k = 1; k < weights.size(); ++k)
            variance += 2 * weights[k] * static_cast<double>(k * k);
        EXPECT_LT(variance, sigma * sigma);
        EXPECT_GT(variance, 0.97 * sigma * sigma) << sigma;
    }
    // And at 6 sigma either side it loses 2 · 6 φ(6) = 7e-8 of it.
    double variance = 0;
    const auto weights = smooth::gaussianWeights(2, 25);
    for (size_t k = 1; k < weights.size(); ++k)
        variance += 2 * weights[k] * static_cast<double>(k * k);
    EXPECT_NEAR(variance, 4, 4 * 1e-7);
}

TEST(SmoothKernel, FoldingKeepsTheSumAndCutsTheReach) {
    const auto weights = smooth::gaussianWeights(5, 31);
    const auto folded = smooth::foldedWeights(weights, 4);
    ASSERT_EQ(folded.size(), 4u);
    EXPECT_EQ(folded[2], weights[2]);
    // The same numbers in another order: a few roundings apart.
    EXPECT_NEAR(folded[0] + 2 * (folded[1] + folded[2] + folded[3]), 1, 1e-15);
    EXPECT_EQ(smooth::foldedWeights(weights, 16), weights);
}

TEST(SmoothParams, TheWidthIsTheNextOddFromSixSigma) {
    const std::pair<double, int> cases[] = {{0, 1}, {0.1, 1}, {0.5, 3},
                                            {1, 7}, {1.5, 9}, {1.51, 11}};
    for (const auto& [sigma, width] : cases) {
        smooth::Params params;
        params.sigma = sigma;
        EXPECT_EQ(params.width(), width) << sigma;
    }
}

TEST(SmoothParams, WrongOnesAreUsageErrors) {
    const auto refused = [](const std::function<void(smooth::Params&)>& spoil) {
        smooth::Params params;
        spoil(params);
        EXPECT_THROW(params.check(), UsageError);
    };
    EXPECT_NO_THROW(smooth::Params().check());
    refused([](auto& p) { p.sigma = -1; });
    refused([](auto& p) { p.sigma = std::nan(""); });
    refused([](auto& p) { p.sigma = INFINITY; });
    refused([](auto& p) { p.kernel = 4; });
    refused([](auto& p) { p.kernel = 0; });
    refused([](auto& p) { p.kernel = -1; });
    refused([](auto& p) { p.automaticGrids = false; });
    refused([](auto& p) { p.grids = {"ior", ""}; });
}

TEST(Smooth, ADeltaBecomesTheProductOfThreeGaussians) {
    const ivec3 size(23, 21, 25), centre(11, 10, 12);
    for (const auto& [sigma, width] : kShapes) {
        const auto out = smoothed(filled(size, [&](ivec3 p) { return p == centre; }), sigma, width);
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const ivec3 d = ivec3(x, y, z) - centre;
                    const double wanted = weightOf(d.x, sigma, width) *
                                          weightOf(d.y, sigma, width) * weightOf(d.z, sigma, width);
                    // Each axis rounds weights and sums to float a few times, relative to the
                    // values there, which are at most 1 per axis: 2e-7 absolute in all.
                    ASSERT_NEAR(at(out, {x, y, z}), wanted, 2e-7)
                        << sigma << " at " << x << " " << y << " " << z;
                }
    }
}

TEST(Smooth, ADeltaInACornerIsClampedThere) {
    // The corner voxel answers for all before it: along each axis it has the weights of 0 and all
    // behind, 1/2 + w(0)/2 at the corner itself.
    const int last = 11;
    for (const int corner : {0, last}) {
        const auto out =
            smoothed(filled(ivec3(12), [&](ivec3 p) { return p == ivec3(corner); }), 1.5, 9);
        const auto axis = [&](int x) {
            double sum = 0;
            for (int k = std::abs(x - corner); k <= 4; ++k) sum += weightOf(k, 1.5, 9);
            return sum;
        };
        for (int x = 0; x < 12; ++x) {
            // Float, as for the delta inside.
            EXPECT_NEAR(at(out, {x, corner, corner}), axis(x) * std::pow(axis(corner), 2), 4e-7);
            EXPECT_NEAR(at(out, {corner, x, corner}), axis(x) * std::pow(axis(corner), 2), 4e-7);
            EXPECT_NEAR(at(out, {corner, corner, x}), axis(x) * std::pow(axis(corner), 2), 4e-7);
        }
    }
}

TEST(Smooth, AConstantStaysToTheLastBit) {
    for (const float value : {1.0f, 1.3333334f, 0.1f, -7.7e-30f, 3e38f}) {
        for (const auto& [sigma, width] : kShapes) {
            const auto in = filled({17, 9, 12}, [&](ivec3) { return value; });
            EXPECT_EQ(smoothed(in, sigma, width).values, in.values) << value;
        }
    }
}

TEST(Smooth, ARampStaysOneAwayFromTheEdges) {
    const ivec3 size(24, 20, 22);
    const auto ramp = [](ivec3 p) { return 1 + 0.01 * p.x - 0.02 * p.y + 0.005 * p.z; };
    const auto in = filled(size, ramp);
    const auto out = smoothed(in, 1.5, 9);
    for (int z = 4; z < size.z - 4; ++z)
        for (int y = 4; y < size.y - 4; ++y)
            for (int x = 4; x < size.x - 4; ++x)
                // Values near 1: three axes of a few float roundings of 6e-8 each.
                ASSERT_NEAR(at(out, {x, y, z}), ramp({x, y, z}), 5e-7);
}

TEST(Smooth, TheSumIsKeptAwayFromTheEdges) {
    const ivec3 size(30);
    const auto in = filled(size, [](ivec3 p) {
        const ivec3 d = glm::abs(p - 15);
        return std::max({d.x, d.y, d.z}) < 8 ? 0.3 + 0.01 * (p.x * 7 % 5) : 0.0;
    });
    const auto out = smoothed(in, 1.5, 9);
    double before = 0, after = 0;
    for (const float v : in.values) before += v;
    for (const float v : out.values) after += v;
    // The float weights sum to 1 only within half a unit in the last place each, 5 · 3e-8 an axis.
    EXPECT_NEAR(after, before, 5e-7 * before);
}

TEST(Smooth, ResultsStayWithinTheRangeOfTheInput) {
    // Or the next stage would refuse an opacity of 1 + 1e-7. Not by a tolerance: exactly.
    const ivec3 size(40, 13, 11);
    const auto in = filled(size, [](ivec3 p) {
        const int noise = (p.x * 73 + p.y * 179 + p.z * 283) % 101;
        return noise < 40 ? 0 : noise < 80 ? 1 : noise / 101.0;
    });
    for (const auto& [sigma, width] : {Shape{1.5, 9}, {0.4, 3}, {30, 181}, {2000, 12001}})
        for (const float v : smoothed(in, sigma, width).values) {
            ASSERT_GE(v, 0) << sigma;
            ASSERT_LE(v, 1) << sigma;
        }
}

TEST(Smooth, AMirroredVolumeGivesTheMirroredResult) {
    const ivec3 size(13, 16, 11);
    const auto noise = [](ivec3 p) { return ((p.x * 31 + p.y * 17 + p.z * 7) % 23) / 23.0; };
    const auto out = smoothed(filled(size, noise), 1.5, 9);
    const auto mirrored =
        smoothed(filled(size, [&](ivec3 p) { return noise(size - 1 - p); }), 1.5, 9);
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                ASSERT_EQ(at(out, {x, y, z}), at(mirrored, size - 1 - ivec3(x, y, z)));
}

TEST(Smooth, SlabsChangeNoBit) {
    const ivec3 size(10, 9, 40);
    const auto noise =
        filled(size, [](ivec3 p) { return ((p.x * 31 + p.y * 17 + p.z * 13) % 29) / 29.0; });
    const auto whole = smoothed(noise, 1.5, 9);
    // Nine planes are the thinnest slab, which makes one plane at a time.
    for (const int planes : {1, 9, 10, 17, 39, 40})
        EXPECT_EQ(smoothed(noise, 1.5, 9, planes * 10 * 9 * 4).values, whole.values) << planes;
}

TEST(Smooth, VolumesThinnerThanTheKernelClampAtBothEnds) {
    // Along x, where only two voxels are: a tap before reads the first, one behind the second.
    const auto out = smoothed(filled({2, 1, 1}, [](ivec3 p) { return p.x; }), 1.5, 9);
    double behind = 0;
    for (int k = 1; k <= 4; ++k) behind += weightOf(k, 1.5, 9);
    EXPECT_NEAR(at(out, {0, 0, 0}), behind, 1e-7);     // float
    EXPECT_NEAR(at(out, {1, 0, 0}), 1 - behind, 1e-7); // float
}

TEST(Smooth, VectorsAreThreeScalars) {
    const ivec3 size(12, 10, 11);
    volume::DenseGrid vectors;
    vectors.size = size;
    vectors.components = 3;
    const auto value = [](ivec3 p, int c) { return ((p.x * 5 + p.y * 3 + p.z * 7 + c * 11) % 13); };
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int c = 0; c < 3; ++c)
                    vectors.values.push_back(static_cast<float>(value({x, y, z}, c)));
    const auto out = smoothed(vectors, 1.5, 9);
    for (int c = 0; c < 3; ++c) {
        const auto alone = smoothed(filled(size, [&](ivec3 p) { return value(p, c); }), 1.5, 9);
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    ASSERT_EQ(at(out, {x, y, z}, c), at(alone, {x, y, z}));
    }
}

TEST(Smooth, CountsWhatItDid) {
    smooth::Plan plan;
    plan.size = ivec3(8);
    plan.weights = smooth::gaussianWeights(1.5, 9);
    for (const char* name : {"a", "b"})
        plan.items.push_back({name, {}, filled(plan.size, [](ivec3 p) { return p.x; })});
    Stats stats;
    std::vector<double> progress;
    const auto out =
        smooth::run(device(), plan, stats, [&](double done) { progress.push_back(done); });
    EXPECT_EQ(out.size(), 2u);
    ASSERT_EQ(stats.passes.size(), 1u);
    EXPECT_EQ(stats.passes[0].name, "smooth");
    EXPECT_GT(stats.passes[0].cpuMs, 0);
    ASSERT_EQ(stats.counters.size(), 1u);
    EXPECT_EQ(stats.counters[0].second, 2 * 512);
    EXPECT_GE(stats.gpuPeakBytes, 2u * 512 * 4);
    EXPECT_EQ(progress, (std::vector<double>{0.5, 1}));
}
