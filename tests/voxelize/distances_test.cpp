// Distances against every triangle tried one by one, in another way; sides against counted samples.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.h"
#include "support/lattice.h"
#include "voxelize/distances.h"

#include <fstream>
#include <gtest/gtest.h>

namespace eikonal::voxelize {
namespace {

using glm::dvec3;
using glm::ivec3;
using mesh::boxShape;
using mesh::TriangleMesh;

/// The distance to a triangle by its plane where the foot is inside all three sides, else to them.
double distanceTo(const dvec3& x, const dvec3 (&t)[3]) {
    const auto toSide = [&](const dvec3& a, const dvec3& b) {
        const double s = glm::clamp(glm::dot(x - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        return glm::distance(x, a + s * (b - a));
    };
    const dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    bool within = true;
    for (int k = 0; k < 3; ++k)
        within &= glm::dot(glm::cross(normal, t[(k + 1) % 3] - t[k]), x - t[k]) >= 0;
    if (within) return std::abs(glm::dot(normal, x - t[0]));
    return std::min({toSide(t[0], t[1]), toSide(t[1], t[2]), toSide(t[2], t[0])});
}

double distanceTo(const dvec3& x, const TriangleMesh& mesh) {
    double least = std::numeric_limits<double>::max();
    for (const glm::uvec3& f : mesh.triangles) {
        const dvec3 corners[3] = {mesh.points[f.x], mesh.points[f.y], mesh.points[f.z]};
        least = std::min(least, distanceTo(x, corners));
    }
    return least;
}

/// Every voxel's, x fastest.
volume::DenseGrid distancesOf(const TriangleMesh& mesh, const Lattice& lattice, double halfWidth) {
    const volume::BrickGrid bricks = signedDistances(mesh, lattice, halfWidth);
    volume::DenseGrid grid{lattice.size, 1, {}};
    for (int z = 0; z < lattice.size.z; ++z)
        for (int y = 0; y < lattice.size.y; ++y)
            for (int x = 0; x < lattice.size.x; ++x) grid.values.push_back(bricks.at({x, y, z}));
    return grid;
}

struct Deviation {
    double most = 0;   // of the distance within the band [voxel]
    int wrongSide = 0; // where the distance is no rounding
    int band = 0;      // voxels compared
};

/// Compares every `step`-th voxel of the lattice with what `distance` says of its place, signed.
template<typename Distance>
Deviation compare(const volume::DenseGrid& grid, const Lattice& lattice, double halfWidth, int step,
                  const Distance& distance) {
    Deviation found;
    const double h = lattice.voxelSize;
    for (size_t i = 0; i < grid.values.size(); i += static_cast<size_t>(step)) {
        const auto n = static_cast<int>(i);
        const ivec3 voxel(n % grid.size.x, n / grid.size.x % grid.size.y,
                          n / grid.size.x / grid.size.y);
        const double wanted = distance(lattice.low + (dvec3(voxel) + 0.5) * h) / h;
        const double value = grid.values[i] / h;
        found.wrongSide += std::abs(wanted) > 1e-6 && value * wanted < 0;
        found.most =
            std::max(found.most, std::abs(value - glm::clamp(wanted, -halfWidth, halfWidth)));
        found.band += std::abs(wanted) < halfWidth;
    }
    return found;
}

/// Against all triangles and the winding number, for meshes whose shells do not overlap.
Deviation compareWithAll(const TriangleMesh& mesh, const Lattice& lattice, double halfWidth,
                         int step) {
    return compare(distancesOf(mesh, lattice, halfWidth), lattice, halfWidth, step,
                   [&](const dvec3& x) {
                       const double inside = mesh::windingNumber(mesh, x) > 0.5 ? -1 : 1;
                       return inside * distanceTo(x, mesh);
                   });
}

// What a float keeps of 6 voxels, twice over: rounded when stored, and so is the voxel's size.
constexpr double kRounding = 1e-6;

TEST(Distances, AreThoseToTheNearestTriangle) {
    const Lattice lattice = latticeAt(dvec3(-1.3, -1.25, -1.2), 0.0625, ivec3(40), 1);
    const Deviation ball = compareWithAll(mesh::icosphere(1, 4), lattice, 6, 29);
    EXPECT_LT(ball.most, kRounding);
    EXPECT_EQ(ball.wrongSide, 0);
    EXPECT_GT(ball.band, 400);
    // Poles where a hundred needles meet.
    const Deviation poles = compareWithAll(mesh::uvSphere(1, 4000), lattice, 6, 31);
    EXPECT_LT(poles.most, kRounding);
    EXPECT_EQ(poles.wrongSide, 0);
    // Far from the world's origin coordinates keep 1e-16 of their 1e6, 2e-9 of a voxel.
    const Deviation far = compareWithAll(mesh::moved(mesh::icosphere(1, 3), dvec3(1e6)),
                                         latticeAt(dvec3(1e6 - 1.25), 0.0625, ivec3(40), 1), 6, 17);
    EXPECT_LT(far.most, kRounding + 1e-8);
    EXPECT_EQ(far.wrongSide, 0);
}

/// The signed distance to a box by its formula.
double toBox(const dvec3& x, const dvec3& low, const dvec3& high) {
    const dvec3 q = glm::abs(x - 0.5 * (low + high)) - 0.5 * (high - low);
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

TEST(Distances, OfBoxesAndThinSlabsAreExact) {
    // Faces on voxels' middles, between them, and a slab thinner than a voxel.
    for (const auto& [low, high] : {std::pair{dvec3(4.5), dvec3(20.5, 12.5, 15.5)},
                                    {dvec3(4.2, 3.9, 5.1), dvec3(20.7, 12.3, 15.8)},
                                    {dvec3(3, 10.13, 3), dvec3(21, 10.83, 21)},
                                    {dvec3(3, 3, 10.13), dvec3(21, 21, 10.83)}}) {
        const Lattice lattice = latticeAt(dvec3(0), 1, ivec3(25, 24, 23), 1);
        const Deviation found =
            compare(distancesOf(boxShape(low, high), lattice, 6), lattice, 6, 1,
                    [&, a = low, b = high](const dvec3& x) { return toBox(x, a, b); });
        EXPECT_LT(found.most, kRounding);
        EXPECT_EQ(found.wrongSide, 0);
    }
}

TEST(Distances, KnowCavitiesAndWhatLiesInThem) {
    // A ball in a cavity in a box, and a box beside.
    const TriangleMesh mesh =
        mesh::joined(mesh::joined(mesh::moved(mesh::icosphere(3, 2), dvec3(12)),
                                  mesh::turnedInsideOut(boxShape(dvec3(6), dvec3(18)))),
                     mesh::joined(boxShape(dvec3(3), dvec3(21)), boxShape({22, 4, 4}, {26, 8, 8})));
    const Deviation found =
        compareWithAll(mesh, latticeAt(dvec3(0), 1, ivec3(29, 24, 24), 1), 5, 7);
    EXPECT_LT(found.most, kRounding);
    EXPECT_EQ(found.wrongSide, 0);
}

TEST(Distances, SeeOverlappingShellsAsOneSolid) {
    // Twice the same box, boxes within one another, and two that overlap by a third of a voxel or
    // abut: no face within the solid may be felt. Planes cut planes here, where pieces of 1/16
    // voxel are kept or left out as a whole; distances are off by half of that at most.
    const dvec3 low(4.3), high(14.6, 16.2, 15.1);
    const Lattice lattice = latticeAt(dvec3(0), 1, ivec3(24), 1);
    for (const TriangleMesh& mesh :
         {mesh::joined(boxShape(low, high), boxShape(low, high)),
          mesh::joined(boxShape(low, high), boxShape(dvec3(7), dvec3(12))),
          mesh::joined(boxShape(low, {9.2, 16.2, 15.1}), boxShape({8.9, 4.3, 4.3}, high)),
          mesh::joined(boxShape(low, {9, 16.2, 15.1}), boxShape({9, 4.3, 4.3}, high))}) {
        const Deviation found = compare(distancesOf(mesh, lattice, 5), lattice, 5, 1,
                                        [&](const dvec3& x) { return toBox(x, low, high); });
        EXPECT_LT(found.most, 1.0 / 32);
        EXPECT_EQ(found.wrongSide, 0);
    }
}

TEST(Distances, OfFacesThatCrossAreThoseOfTheirUnion) {
    const auto ball = [](const dvec3& x, const dvec3& middle) {
        return glm::distance(x, middle) - 6;
    };
    const dvec3 a(9.1, 11.3, 10.2), b(14.7, 12.1, 12.9);
    const TriangleMesh mesh =
        mesh::joined(mesh::moved(mesh::icosphere(6, 4), a), mesh::moved(mesh::icosphere(6, 4), b));
    const Lattice lattice = latticeAt(dvec3(0), 1, ivec3(25), 1);
    const volume::DenseGrid grid = distancesOf(mesh, lattice, 4);
    // Outside, the union's distance is the lesser one; inside, near the seam, it is larger.
    for (size_t i = 0; i < grid.values.size(); ++i) {
        const auto n = static_cast<int>(i);
        const dvec3 x = dvec3(n % 25, n / 25 % 25, n / 625) + 0.5;
        const double lesser = std::min(ball(x, a), ball(x, b));
        // Facets lie up to 0.01 within the balls, and pieces are kept to 1/32.
        const double slack = 0.01 + 1.0 / 32;
        if (lesser > 0)
            EXPECT_NEAR(grid.values[i], std::min(lesser, 4.0), slack);
        else
            EXPECT_LT(grid.values[i], std::max(lesser, -4.0) + slack);
    }
}

TEST(Distances, HaveTheSideThatCoverageCounts) {
    // One sample a voxel lies at its middle; facets are drawn with corners moved by up to 1/512.
    const TriangleMesh mesh = mesh::joined(
        mesh::joined(mesh::moved(mesh::icosphere(7, 3), dvec3(10.1)),
                     mesh::turnedInsideOut(mesh::moved(mesh::icosphere(4, 3), dvec3(10.1)))),
        mesh::moved(mesh::uvSphere(5, 600), dvec3(18.3, 12.2, 12.9)));
    const Lattice lattice = latticeAt(dvec3(0), 1, ivec3(28, 24, 22), 1);
    const std::vector<std::uint16_t> counts = countsOf(mesh, lattice);
    const volume::DenseGrid grid = distancesOf(mesh, lattice, 3);
    int inside = 0, differing = 0;
    for (size_t i = 0; i < counts.size(); ++i) {
        inside += counts[i];
        differing += (counts[i] > 0) != (grid.values[i] < 0) && std::abs(grid.values[i]) > 0.004;
    }
    EXPECT_GT(inside, 1000);
    EXPECT_EQ(differing, 0);
}

TEST(Distances, OfAScannedMeshAreExact) {
    const std::string path = EIKONAL_SOURCE_DIR "/data/bunny.off";
    if (!std::ifstream(path)) GTEST_SKIP() << "no " << path;
    const TriangleMesh mesh = mesh::readMesh(path);
    const mesh::Box box = mesh::boundingBox(mesh);
    const dvec3 edges = box.max - box.min;
    const double h = std::max({edges.x, edges.y, edges.z}) / 112;
    const Lattice lattice = latticeAt(box.min - 8 * h, h, ivec3(edges / h) + 16, 1);
    const Deviation found = compareWithAll(mesh, lattice, 6, 7919);
    EXPECT_LT(found.most, kRounding);
    EXPECT_EQ(found.wrongSide, 0);
    EXPECT_GT(found.band, 20);
}

} // namespace
} // namespace eikonal::voxelize
