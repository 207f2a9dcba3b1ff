// Coverage: shapes whose share of each voxel is known on paper, and the strips against the whole.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/lattice.h"

#include <gtest/gtest.h>
#include <random>

namespace eikonal::voxelize {
namespace {

using glm::dvec3;
using glm::ivec3;

/// How much of [0, 1] shifted by `voxel` lies in [from, to].
double overlap(int voxel, double from, double to) {
    return std::max(0.0, std::min(voxel + 1.0, to) - std::max(voxel + 0.0, from));
}

/// Every voxel's count against the box's exact share, for boxes whose faces lie between samples.
void expectBox(const dvec3& from, const dvec3& to, int supersample) {
    const Lattice lattice = latticeAt({-3, 5, 10}, 0.25, {17, 12, 9}, supersample);
    const auto counts =
        countsOf(mesh::boxShape(lattice.low + from * 0.25, lattice.low + to * 0.25), lattice);
    size_t at = 0;
    for (int z = 0; z < lattice.size.z; ++z)
        for (int y = 0; y < lattice.size.y; ++y)
            for (int x = 0; x < lattice.size.x; ++x, ++at) {
                const double share =
                    overlap(x, from.x, to.x) * overlap(y, from.y, to.y) * overlap(z, from.z, to.z);
                ASSERT_EQ(counts[at], share * lattice.most())
                    << "voxel " << x << " " << y << " " << z << ", S " << supersample;
            }
}

class CoverageAt : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Supersample, CoverageAt, testing::Values(1, 2, 4, 8));

// Three extents and three offsets: axes swapped or mirrored would put it elsewhere.
TEST_P(CoverageAt, IsExactForABoxOnVoxelFaces) {
    expectBox({2, 1, 3}, {13, 6, 5}, GetParam());
}

TEST_P(CoverageAt, IsExactForABoxThatFillsTheDomain) {
    expectBox({0, 0, 0}, {17, 12, 9}, GetParam());
}

TEST_P(CoverageAt, IsExactForABoxBetweenSamples) {
    const double part = 1.0 / GetParam();
    expectBox({2 + part, 1 - part, 3}, {13 - part, 6 + part, 5 + part}, GetParam());
}

TEST(Coverage, IsExactForHalvesQuartersAndEighths) {
    expectBox({2.5, 1.25, 3.75}, {13.5, 6.75, 5.25}, 4);
    expectBox({2.125, 1.5, 3.625}, {2.875, 6.75, 3.75}, 8); // thinner than a voxel
}

// Samples lie half-way between multiples of 1/S: with faces on them, each must be owned once.
TEST_P(CoverageAt, OwnsSamplesOnFacesOnce) {
    const double half = 0.5 / GetParam();
    const Lattice lattice = latticeAt({0, 0, 0}, 1, {8, 8, 8}, GetParam());
    const dvec3 low = dvec3(1, 2, 3) + half, high = dvec3(6, 5, 4) + half;
    const auto counts = countsOf(mesh::boxShape(low, high), lattice);
    EXPECT_EQ(volumeOf(counts, lattice), 5 * 3 * 1);
    // A row of abutting boxes: no sample twice, none lost.
    auto row = mesh::boxShape(low, high);
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 from = low, to = high, middle(0);
        middle[axis] = 1;
        from[axis] = high[axis];
        to[axis] = high[axis] + 1;
        const auto both = countsOf(mesh::joined(row, mesh::boxShape(from, to)), lattice);
        const dvec3 extents = to - from;
        EXPECT_EQ(volumeOf(both, lattice), 15 + extents.x * extents.y * extents.z) << axis;
    }
}

// 81,920 faces fall short of the ball by 1e-4; their own volume is what must come out, to within
// the sampling error of some 40,000 boundary columns.
TEST(Coverage, SumsToTheVolumeOfASphere) {
    const mesh::TriangleMesh sphere = mesh::icosphere(1, 6);
    for (int supersample : {1, 2, 4, 8}) {
        const Lattice lattice = latticeAt(dvec3(-1.1), 2.2 / 64, ivec3(64), supersample);
        const double volume = volumeOf(countsOf(sphere, lattice), lattice);
        const double exact = mesh::signedVolume(sphere);
        EXPECT_NEAR(volume / exact, 1, supersample < 4 ? 4e-3 : 1e-3) << supersample;
    }
}

// The definition itself, for a shape with no face along an axis: each sample inside or outside.
TEST(Coverage, CountsTheSamplesInside) {
    const dvec3 centre(0.13, -0.07, 0.21);
    const mesh::TriangleMesh shape = mesh::moved(mesh::icosphere(1, 1), centre);
    const Lattice lattice = latticeAt(dvec3(-1.3, -1.2, -1.1), 0.2, {14, 12, 13}, 4);
    const auto counts = countsOf(shape, lattice);
    size_t at = 0;
    int differing = 0;
    for (int z = 0; z < 13; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 14; ++x, ++at) {
                int inside = 0;
                for (int k = 0; k < 64; ++k) {
                    const dvec3 sample = (dvec3(k % 4, k / 4 % 4, k / 16) + 0.5) / 4.0;
                    const dvec3 place = lattice.low + (dvec3(x, y, z) + sample) * 0.2;
                    inside += mesh::windingNumber(shape, place) > 0.5;
                }
                differing += std::abs(inside - int{counts[at]});
            }
    // Corners are moved by up to 1/512 sample: some 10,000 boundary samples, of which so many lie
    // that close to a face.
    EXPECT_LE(differing, 40);
}

TEST(Coverage, LeavesACavityOut) {
    const mesh::TriangleMesh hollow =
        mesh::joined(mesh::boxShape(dvec3(1), dvec3(9)),
                     mesh::turnedInsideOut(mesh::boxShape(dvec3(3), dvec3(6.5))));
    const Lattice lattice = latticeAt({0, 0, 0}, 1, ivec3(10), 4);
    const auto counts = countsOf(hollow, lattice);
    EXPECT_EQ(volumeOf(counts, lattice), 8 * 8 * 8 - 3.5 * 3.5 * 3.5);
    EXPECT_EQ(counts[4 + 10 * (4 + 10 * 4)], 0);
}

TEST(Coverage, CountsOverlappingShellsOnce) {
    const mesh::TriangleMesh both =
        mesh::joined(mesh::boxShape({1, 1, 1}, {5, 5, 5}), mesh::boxShape({3, 2, 2}, {8, 4, 4}));
    const Lattice lattice = latticeAt({0, 0, 0}, 1, ivec3(9), 4);
    EXPECT_EQ(volumeOf(countsOf(both, lattice), lattice), 64 + 3 * 2 * 2);
}

TEST(Coverage, SeesWhatIsThinnerThanAVoxel) {
    // A sheet of an eighth of a voxel, slightly tilted, in voxels sampled 8 times along an edge.
    mesh::TriangleMesh sheet = mesh::boxShape({2, 2, 7.3}, {30, 30, 7.425});
    for (dvec3& point : sheet.points) point.z += 0.3 * point.x;
    const Lattice lattice = latticeAt({0, 0, 0}, 1, ivec3(32), 8);
    const auto counts = countsOf(sheet, lattice);
    EXPECT_NEAR(volumeOf(counts, lattice) / mesh::signedVolume(sheet), 1, 0.01);
    for (int y = 2; y < 30; ++y)
        for (int x = 2; x < 30; ++x) {
            int column = 0;
            for (int z = 0; z < 32; ++z)
                column += counts[static_cast<size_t>(x + 32 * (y + 32 * z))];
            EXPECT_GT(column, 0) << x << " " << y;
        }
}

/// A ball of many thin, steep and tiny triangles: every corner pushed about.
mesh::TriangleMesh crumpled(int subdivisions) {
    mesh::TriangleMesh mesh = mesh::icosphere(1, subdivisions);
    std::mt19937 random(7);
    for (dvec3& point : mesh.points)
        for (int i = 0; i < 3; ++i)
            point[i] += 0.08 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
    return mesh;
}

TEST(Coverage, IsTheSameInStrips) {
    const mesh::TriangleMesh mesh = crumpled(4);
    const Lattice lattice = latticeAt(dvec3(-1.2, -1.1, -1.15), 0.05, {48, 45, 47}, 4);
    const auto whole = countsOf(mesh, lattice);
    for (int rows : {1, 7, 44})
        EXPECT_EQ(countsOf(mesh, lattice, std::int64_t{48} * 47 * 4 * rows), whole) << rows;
}

TEST(Coverage, IsTheSameTwice) {
    const mesh::TriangleMesh mesh = crumpled(5);
    const Lattice lattice = latticeAt(dvec3(-1.2), 0.06, ivec3(40), 8);
    EXPECT_EQ(countsOf(mesh, lattice), countsOf(mesh, lattice));
}

// A column whose crossings did not cancel would show as a streak behind the mesh.
TEST(Coverage, LeavesNothingBehindTheMesh) {
    const Lattice lattice = latticeAt(dvec3(-1.2), 2.4 / 100, ivec3(100), 8);
    for (const auto& mesh : {crumpled(5), mesh::uvSphere(1, 40000)}) {
        const auto counts = countsOf(mesh, lattice);
        for (size_t i = 0; i < 100 * 100; ++i) {
            EXPECT_EQ(counts[i], 0);
            EXPECT_EQ(counts[counts.size() - 1 - i], 0);
        }
    }
}

TEST(Coverage, CutsAMeshThatReachesBeyondTheDomain) {
    const Lattice lattice = latticeAt({0, 0, 0}, 1, {8, 8, 8}, 4);
    const auto all = countsOf(mesh::boxShape({-1000, -3, -7}, {90, 5000, 20}), lattice);
    EXPECT_EQ(volumeOf(all, lattice), 512);
    EXPECT_EQ(volumeOf(countsOf(mesh::boxShape({9, 9, 9}, {12, 12, 12}), lattice), lattice), 0);
    const auto part = countsOf(mesh::boxShape({-40, 2, -50}, {3.5, 4.25, 6.75}), lattice);
    EXPECT_EQ(volumeOf(part, lattice), 3.5 * 2.25 * 6.75);

    // A ball seen through a window of half its size agrees with the same voxels of the whole,
    // but for samples that the cut sides' new corners move across a face.
    const mesh::TriangleMesh ball = crumpled(4);
    const Lattice whole = latticeAt(dvec3(-1.6), 0.1, ivec3(32), 4);
    const Lattice window = latticeAt(dvec3(-0.8), 0.1, ivec3(16), 4);
    const auto wide = countsOf(ball, whole), narrow = countsOf(ball, window);
    int differing = 0;
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                differing +=
                    std::abs(narrow[static_cast<size_t>(x + 16 * (y + 16 * z))] -
                             wide[static_cast<size_t>(x + 8 + 32 * (y + 8 + 32 * (z + 8)))]);
    EXPECT_LE(differing, 10);
}

TEST(Coverage, KeepsItsPrecisionInTheLongestDomain) {
    const Lattice lattice = latticeAt({0, 0, 0}, 1, {2046, 2, 2046}, 8);
    const mesh::TriangleMesh bar = mesh::boxShape({1.125, 0.25, 3.5}, {2040.875, 1.5, 2045.25});
    EXPECT_EQ(volumeOf(countsOf(bar, lattice), lattice), 2039.75 * 1.25 * 2041.75);
}

} // namespace
} // namespace eikonal::voxelize
