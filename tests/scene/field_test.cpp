// The index field as rays sample it, against fields whose values and derivatives are known.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/program.h"
#include "scene/field.h"
#include "scene/scene.h"
#include "scene/shared.h"
#include "scene/voxel_textures.h"
#include "support/test_volume.h"
#include "volume/make_bricks.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <random>

using namespace eikonal;
using namespace eikonal::scene;
using glm::dvec3;
using glm::ivec3;
using glm::vec4;

namespace {

using Square = std::function<double(dvec3)>; // n² at a point [voxel]

volume::DenseGrid gridOf(ivec3 size, const Square& square) {
    volume::DenseGrid grid{size, 1, {}};
    forEachVoxel(size, [&](ivec3 p) {
        grid.values.push_back(static_cast<float>(std::sqrt(square(dvec3(p)))));
    });
    return grid;
}

struct Found {
    vec4 field; // ½∇(n²), n
    vec4 mean;  // the force, from two look-ups half a voxel off along w; indexAt's n
    vec4 bend;  // (w·∇)½∇(n²)
};

Scene sceneOf(const volume::DenseGrid& grid) {
    Scene scene;
    scene.domain = {ivec3(0), grid.size - 1};
    const auto isEven = [&](size_t brick) {
        const volume::BrickGrid bricks(grid.size, ivec3(0), 0);
        const ivec3 low = bricks.voxelOf(brick);
        bool even = true;
        forEachVoxel(glm::min(grid.size - low, ivec3(volume::kBrick)),
                     [&](ivec3 p) { even &= at(grid, low + p) == at(grid, low); });
        return even;
    };
    scene.index.grid =
        volume::makeBricks(grid.size, ivec3(0), 1, isEven, [&](const ivec3& p, float* out) {
            *out = static_cast<float>(at(grid, p));
        });
    const auto [least, most] = std::minmax_element(grid.values.begin(), grid.values.end());
    scene.index.least = *least;
    scene.index.most = *most;
    return scene;
}

std::vector<Found> probe(const volume::DenseGrid& grid, const FieldOptions& options,
                         const std::vector<dvec3>& points, const dvec3& w, bool paged = false) {
    std::vector<vec4> in;
    for (const dvec3& p : points) {
        in.emplace_back(p, 0);
        in.emplace_back(w, 0);
    }
    Scene scene = sceneOf(grid);
    scene.layout = layoutOf(scene, paged ? 0 : 1 << 24);
    EXPECT_EQ(scene.layout.paged, paged);
    const Field field(device(), scene.index, scene.layout, options);
    const gpu::Program program(
        device(), "transport/probe.comp.glsl",
        {{"FIELD", fieldSwitch(true, options.interpolation)}, {"DISPERSION", 0}, {"PAGED", paged}});
    TransportParams transport{};
    transport.halfSize = vec4(0.5f * glm::vec3(grid.size), 0);
    const gpu::Buffer transportBlock(device(), sizeof transport, &transport);
    transportBlock.bindUniform(kTransportBlock);
    gpu::Texture table;
    if (paged) {
        table = makeVoxelTable(device(), scene.layout);
        table.bindSampler(kVoxelBlocksUnit);
    }
    const glm::uvec4 values(points.size(), 0, 0, 0);
    const gpu::Buffer params(device(), sizeof values, &values);
    const gpu::Buffer source(device(), static_cast<std::int64_t>(in.size() * sizeof(vec4)),
                             in.data());
    std::vector<Found> found(points.size());
    const auto bytes = static_cast<std::int64_t>(found.size() * sizeof(Found));
    const gpu::Buffer target(device(), bytes);
    params.bindUniform(0);
    source.bindStorage(0);
    target.bindStorage(1);
    field.bind();
    program.dispatch({static_cast<int>(points.size()), 1, 1});
    gpu::barrier();
    target.download(found.data(), bytes);
    return found;
}

std::vector<dvec3> pointsIn(ivec3 size, int count, double inset) {
    std::mt19937 random(7);
    const auto along = [&](int n) {
        return inset - 0.5 + (n - 2 * inset) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<dvec3> points;
    for (int i = 0; i < count; ++i) points.push_back({along(size.x), along(size.y), along(size.z)});
    return points;
}

/// Cubic in every coordinate, with mixed terms, and its derivatives.
double cubicSquare(dvec3 p) {
    const dvec3 q = (p - 5.0) / 10.0;
    return 2 + 0.4 * q.x - 0.3 * q.y * q.z + 0.5 * q.x * q.x * q.y - 0.3 * q.z * q.z * q.z;
}

dvec3 cubicForce(dvec3 p) {
    const dvec3 q = (p - 5.0) / 10.0;
    return dvec3(0.4 + q.x * q.y, -0.3 * q.z + 0.5 * q.x * q.x, -0.3 * q.y - 0.9 * q.z * q.z) /
           20.0;
}

const dvec3 kAlong(0.6, -1.1, 0.5);

dvec3 cubicBend(dvec3 p) {
    const double h = 1e-4; // of a quadratic: exact but for rounding, 1e-16/h
    return (cubicForce(p + h * kAlong) - cubicForce(p - h * kAlong)) / (2 * h);
}

FieldOptions cubic() {
    return {Interpolation::cubic, true, 0};
}

} // namespace

TEST(Field, ASplineHasEveryCubicsValueAndGradientUpToTheFaces) {
    const ivec3 size(12, 11, 13);
    const auto grid = gridOf(size, cubicSquare);
    const auto points = pointsIn(size, 4000, 0);
    const auto found = probe(grid, cubic(), points, kAlong);
    for (size_t i = 0; i < points.size(); ++i) {
        const dvec3 force = cubicForce(points[i]);
        // Floats of n are 6e-8 off, U by n times that; a spline's coefficients spread samples'
        // errors by 3 an axis at most, and its slope takes differences of them: 2e-6 at worst.
        EXPECT_NEAR(found[i].field.w, std::sqrt(cubicSquare(points[i])), 1e-6);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[i].field[c], force[c], 2e-6);
            // An eighth of the force's second derivative along the way, 9e-4 in z.
            EXPECT_NEAR(found[i].mean[c], force[c], 2e-4);
            // Differences over a voxel of a quadratic are exact, of the slopes above.
            EXPECT_NEAR(found[i].bend[c], cubicBend(points[i])[c], 2e-5);
        }
    }
}

TEST(Field, ASplinesGradientIsThatOfItsValueEvenAtAJump) {
    const ivec3 size(10);
    const auto grid = gridOf(size, [](dvec3 p) { return p.x + 0.3 * p.y < 5 ? 1 : 2.25; });
    const double h = 0.01; // [voxel]
    const auto points = pointsIn(size, 1000, 0.6);
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 step(0);
        step[axis] = h;
        std::vector<dvec3> before = points, after = points;
        for (dvec3& p : before) p -= step;
        for (dvec3& p : after) p += step;
        const auto here = probe(grid, cubic(), points, kAlong);
        const auto low = probe(grid, cubic(), before, kAlong);
        const auto high = probe(grid, cubic(), after, kAlong);
        for (size_t i = 0; i < points.size(); ++i) {
            const auto square = [](const Found& f) {
                return static_cast<double>(f.field.w) * static_cast<double>(f.field.w);
            };
            const double slope = (square(high[i]) - square(low[i])) / (4 * h);
            // Floats of n², 2e-7 over 0.04, and h times the jumps of the third derivative, up to 2.
            EXPECT_NEAR(here[i].field[axis], slope, 3e-4);
        }
    }
}

TEST(Field, ASplinePassesThroughItsSamples) {
    const ivec3 size(9, 8, 7);
    std::mt19937 random(3);
    volume::DenseGrid grid{size, 1, {}};
    std::vector<dvec3> voxels;
    forEachVoxel(size, [&](ivec3 p) {
        grid.values.push_back(1.0f + 0.001f * static_cast<float>(random() % 1000));
        voxels.push_back(dvec3(p));
    });
    const auto found = probe(grid, cubic(), voxels, kAlong);
    for (size_t i = 0; i < voxels.size(); ++i)
        EXPECT_NEAR(found[i].field.w, grid.values[i], 2e-6); // floats of coefficients up to 3
}

TEST(Field, UnbiasedSamplesAreRightOnAverageOverACellAndPlainOnesAreNot) {
    const ivec3 size(12, 11, 13);
    const auto grid = gridOf(size, cubicSquare);
    std::vector<dvec3> points;
    const int n = 16; // the midpoint rule is exact for linear pieces' products up to 1/n² of them
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                points.push_back(dvec3(4, 5, 6) + (dvec3(x, y, z) + 0.5) / double(n));
    const auto worst = [&](const FieldOptions& options) {
        const auto found = probe(grid, options, points, kAlong);
        dvec3 off(0);
        for (size_t i = 0; i < points.size(); ++i)
            off += dvec3(glm::vec3(found[i].field)) - cubicForce(points[i]);
        off /= static_cast<double>(points.size());
        return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
    };
    // Plain: a quarter of the third derivative, 5e-4 a voxel³ here, in z.
    EXPECT_GT(worst({Interpolation::linear, false, 0}), 1e-4);
    EXPECT_LT(worst({Interpolation::linear, true, 0}), 2e-6);
}

TEST(Field, ARaysEndsSeeTheIndexItselfNotItsWaveringMean) {
    const ivec3 size(12, 11, 13);
    const auto grid = gridOf(size, [](dvec3 p) { // n is a quadratic
        const dvec3 q = (p - 5.0) / 10.0;
        const double n = 1.4 + 0.2 * q.x + 0.3 * q.x * q.x - 0.2 * q.y * q.y + 0.1 * q.z * q.y;
        return n * n;
    });
    const auto points = pointsIn(size, 2000, 1);
    const auto found = probe(grid, {}, points, kAlong);
    double exact = 0, mean = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const dvec3 q = (points[i] - 5.0) / 10.0;
        const double n = 1.4 + 0.2 * q.x + 0.3 * q.x * q.x - 0.2 * q.y * q.y + 0.1 * q.z * q.y;
        exact = std::max(exact, std::abs(static_cast<double>(found[i].mean.w) - n));
        mean = std::max(mean, std::abs(static_cast<double>(found[i].field.w) - n));
    }
    EXPECT_GT(mean, 4e-4);  // up to n''/12, 5e-4 and 3e-4 along x and y
    EXPECT_LT(exact, 2e-5); // the second derivatives are differences of forces over n
}

TEST(Field, AConstantIndexHasNoGradientAtAll) {
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
        const auto grid = gridOf(ivec3(5), [](dvec3) { return 1.69; });
        for (const Found& found :
             probe(grid, {interpolation, true, 0.7}, pointsIn(ivec3(5), 500, 0), kAlong))
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(found.field[c], 0);
                EXPECT_EQ(found.bend[c], 0);
                EXPECT_FLOAT_EQ(found.field.w, 1.3f);
            }
    }
}

TEST(Field, ShortAxesGoOnAsTheirSamplesSay) {
    // One voxel is constant, two or three are a line, whatever the interpolation.
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic})
        for (const int count : {1, 2, 3}) {
            const ivec3 size(count, 6, 6);
            const auto grid = gridOf(size, [](dvec3 p) { return 2 + 0.1 * p.x; });
            const auto points = pointsIn(size, 300, 0);
            const auto found = probe(grid, {interpolation, true, 0}, points, kAlong);
            for (size_t i = 0; i < points.size(); ++i) {
                EXPECT_NEAR(found[i].field.x, count == 1 ? 0 : 0.05, 1e-6) << count;
                EXPECT_NEAR(found[i].field.y, 0, 1e-6);
                const double x = count == 1 ? 0 : points[i].x;
                EXPECT_NEAR(found[i].mean.w, std::sqrt(2 + 0.1 * x),
                            2e-4); // n is linear here, not n²
            }
        }
}

TEST(Field, TheIndexStaysAboveZeroBeyondASteepFace) {
    // From 3 to 1 in the last voxel: n² = 9, 1, and −7 on a straight line.
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
        const ivec3 size(6);
        const auto grid = gridOf(size, [](dvec3 p) { return p.x > 4.5 ? 1 : 9; });
        for (const Found& found :
             probe(grid, {interpolation, true, 0.3}, pointsIn(size, 1000, 0), kAlong)) {
            EXPECT_GT(found.field.w, 0.2);
            EXPECT_GT(found.mean.w, 0);
        }
    }
}

TEST(Field, LinearSamplesByBlocksAreThoseOfOneBox) {
    // A ball's blurred edge, which also passes through a face; most blocks are even.
    const ivec3 size(61, 50, 43);
    const auto grid = gridOf(size, [](dvec3 p) {
        const double inside = 6 - glm::length(p - dvec3(20, 21, 3));
        return 1.69 - 0.3 * std::clamp(0.25 * inside, -1.0, 1.0);
    });
    for (const double tau : {0.0, 0.7}) {
        const FieldOptions options{Interpolation::linear, true, tau};
        const auto points = pointsIn(size, 20000, -0.9); // into the margin
        const auto box = probe(grid, options, points, kAlong);
        const auto blocks = probe(grid, options, points, kAlong, true);
        for (size_t i = 0; i < points.size(); ++i)
            for (int c = 0; c < 4; ++c) {
                // The samples are the same; where between them a point lies is rounded apart.
                ASSERT_NEAR(blocks[i].field[c], box[i].field[c], 4e-6) << points[i].x;
                ASSERT_NEAR(blocks[i].mean[c], box[i].mean[c], 4e-6);
            }
    }
    Scene scene = sceneOf(grid);
    const VoxelLayout paged = layoutOf(scene, 0);
    EXPECT_LT(3 * paged.texelCount(), 2 * layoutOf(scene).texelCount());
}
