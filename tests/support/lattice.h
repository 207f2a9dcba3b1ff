// What the voxelising tests share: one device, and lattices made by hand.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/shapes.h"
#include "voxelize/coverage.h"

#include <numeric>

namespace eikonal::voxelize {

inline gpu::Device& testDevice() {
    static gpu::Device device({});
    return device;
}

inline Lattice latticeAt(const glm::dvec3& low, double voxelSize, const glm::ivec3& size,
                         int supersample) {
    Lattice lattice;
    lattice.low = low;
    lattice.voxelSize = voxelSize;
    lattice.size = size;
    lattice.supersample = supersample;
    return lattice;
}

/// The counts of the whole lattice, x fastest, put together from its strips.
inline std::vector<std::uint16_t> countsOf(const mesh::TriangleMesh& mesh, const Lattice& lattice,
                                           std::int64_t stripBytes = kStripBytes) {
    Coverage coverage(testDevice(), lattice, stripBytes);
    FacetSource source(mesh, lattice);
    const glm::ivec3 size = lattice.size;
    std::vector<std::uint16_t> all(static_cast<size_t>(size.x) * size.y * size.z);
    for (int row = 0; row < size.y; row += coverage.rowsPerStrip()) {
        const int rows = std::min(coverage.rowsPerStrip(), size.y - row);
        const Counts strip = coverage.count(source, row, rows);
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const size_t brick = strip.brickAt(glm::ivec3(x, y, z) / volume::kBrick);
                    const glm::ivec3 p = glm::ivec3(x, y, z) % volume::kBrick;
                    all[(static_cast<size_t>(z) * size.y + row + y) * size.x + x] = strip.at(
                        brick,
                        static_cast<size_t>((p.z * volume::kBrick + p.y) * volume::kBrick + p.x));
                }
    }
    return all;
}

/// The volume that the counts stand for [unit³].
inline double volumeOf(const std::vector<std::uint16_t>& counts, const Lattice& lattice) {
    const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
    return samples / lattice.most() * std::pow(lattice.voxelSize, 3);
}

} // namespace eikonal::voxelize
