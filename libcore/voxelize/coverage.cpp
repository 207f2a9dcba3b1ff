// How much of each voxel lies inside a mesh, counted on the device.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/coverage.h"

#include "base/error.h"
#include "volume/bricks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <numeric>
#include <span>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

namespace {

using glm::ivec3;

// Triangles per draw: 48 MiB of facets, large enough that a draw's fixed cost does not count.
constexpr size_t kFacetsPerDraw = size_t{1} << 20;

std::int64_t rowBytes(const Lattice& lattice) {
    return std::int64_t{lattice.size.x} * lattice.size.z * 4;
}

int rowsOf(const Lattice& lattice, std::int64_t stripBytes) {
    // Whole bricks.
    const std::int64_t bricks = stripBytes / rowBytes(lattice) / volume::kBrick;
    return static_cast<int>(
        std::min<std::int64_t>(std::max<std::int64_t>(bricks, 1) * volume::kBrick, lattice.size.y));
}

/// Sums up a strip's changes along z, eight by eight columns of voxels at a time.
class Summing {
public:
    Summing(const std::int32_t* changes, int most, Counts& counts)
        : mChanges(changes), mMost(most), mCounts(counts) {}

    void run() {
        std::vector<Uneven> found(static_cast<size_t>(mCounts.bricks.x) * mCounts.bricks.y);
        tbb::parallel_for(tbb::blocked_range<size_t>(0, found.size()), [&](const auto& range) {
            Sums sums;
            for (size_t i = range.begin(); i < range.end(); ++i) {
                const auto n = static_cast<int>(i);
                const ivec3 first(n % mCounts.bricks.x, n / mCounts.bricks.x, 0);
                sumBefore(first, sums);
                store(first, sums, found[i]);
            }
        });
        for (const Uneven& some : found) {
            const size_t begin = mCounts.values.size() / volume::kBrickVoxels;
            for (size_t i = 0; i < some.bricks.size(); ++i)
                mCounts.page[some.bricks[i]] = static_cast<std::int32_t>(begin + i);
            mCounts.values.insert(mCounts.values.end(), some.values.begin(), some.values.end());
        }
    }

private:
    static constexpr int kColumns = volume::kBrick * volume::kBrick;
    /// Per brick along z.
    struct Sums {
        std::vector<std::array<int, kColumns>> before; ///< of each column's changes
        std::vector<char> changes;                     ///< whether some lie within
    };
    struct Uneven {
        std::vector<size_t> bricks;
        std::vector<std::uint16_t> values;
    };

    /// The part of a brick's column of voxels that lies in the strip.
    std::span<const std::int32_t> columnOf(const ivec3& brick, int x, int y) const {
        const ivec3 voxel = volume::kBrick * brick + ivec3(x, y, 0);
        return {mChanges +
                    (static_cast<size_t>(voxel.y) * mCounts.size.x + voxel.x) * mCounts.size.z +
                    voxel.z,
                static_cast<size_t>(std::min(volume::kBrick, mCounts.size.z - voxel.z))};
    }
    template<typename Act> void eachColumn(const ivec3& brick, const Act& act) const {
        const ivec3 edges = glm::min(mCounts.size - volume::kBrick * brick, ivec3(volume::kBrick));
        for (int y = 0; y < edges.y; ++y)
            for (int x = 0; x < edges.x; ++x)
                act(x, y, static_cast<size_t>(volume::kBrick * y + x));
    }
    static bool isZero(std::span<const std::int32_t> changes) {
        if (changes.size() < volume::kBrick)
            return std::all_of(changes.begin(), changes.end(), [](auto x) { return x == 0; });
        std::uint64_t all[volume::kBrick / 2];
        std::memcpy(all, changes.data(), sizeof all);
        return (all[0] | all[1] | all[2] | all[3]) == 0;
    }

    void sumBefore(const ivec3& first, Sums& sums) const {
        const auto deep = static_cast<size_t>(mCounts.bricks.z);
        sums.before.resize(deep);
        sums.changes.assign(deep, 0);
        eachColumn(first, [&](int x, int y, size_t column) {
            int sum = 0;
            for (size_t z = 0; z < deep; ++z) {
                sums.before[z][column] = sum;
                const auto some = columnOf(first + ivec3(0, 0, z), x, y);
                if (isZero(some)) continue;
                sum = std::accumulate(some.begin(), some.end(), sum);
                sums.changes[z] = 1;
            }
        });
    }

    // Shells that overlap count as one solid: inside is where the winding number is not 0.
    std::uint16_t countOf(int sum) const {
        return static_cast<std::uint16_t>(std::clamp(sum, 0, mMost));
    }

    void store(const ivec3& first, const Sums& sums, Uneven& uneven) {
        for (int z = 0; z < mCounts.bricks.z; ++z) {
            const ivec3 brick = first + ivec3(0, 0, z);
            const auto& before = sums.before[static_cast<size_t>(z)];
            const std::uint16_t count = countOf(before[0]);
            bool even = sums.changes[static_cast<size_t>(z)] == 0;
            eachColumn(brick, [&](int, int, size_t column) {
                even = even && countOf(before[column]) == count;
            });
            if (even) {
                mCounts.even[mCounts.brickAt(brick)] = count;
                continue;
            }
            uneven.bricks.push_back(mCounts.brickAt(brick));
            const size_t begin = uneven.values.size();
            uneven.values.resize(begin + volume::kBrickVoxels);
            eachColumn(brick, [&](int x, int y, size_t column) {
                int sum = before[column];
                size_t at = begin + column;
                for (const std::int32_t change : columnOf(brick, x, y)) {
                    uneven.values[at] = countOf(sum += change);
                    at += kColumns;
                }
            });
        }
    }

    const std::int32_t* mChanges; ///< z fastest, then x, y
    int mMost;
    Counts& mCounts;
};

} // namespace

std::vector<gpu::Need> coverageNeeds(const Lattice& lattice, std::int64_t stripBytes) {
    return {{"a strip of " + std::to_string(rowsOf(lattice, stripBytes)) + " rows of voxels",
             rowBytes(lattice) * rowsOf(lattice, stripBytes), true},
            {"the triangles of a draw", kFacetsPerDraw * sizeof(Facet), true}};
}

Coverage::Coverage(gpu::Device& device, const Lattice& lattice, std::int64_t stripBytes)
    : mDevice(device), mLattice(lattice), mRows(rowsOf(lattice, stripBytes)),
      mCrossings(device, "voxelize/crossings.vert.glsl", "voxelize/crossings.frag.glsl", {}),
      mChanges(device, rowBytes(lattice) * mRows, gpu::InPlace::yes),
      mParams(device, sizeof(StripParams)) {
    if (lattice.view() > device.limits().framebuffer)
        throw MemoryError("voxelising draws " + std::to_string(lattice.view()) +
                          " pixels along an edge, the device allows " +
                          std::to_string(device.limits().framebuffer));
}

Counts Coverage::count(FacetSource& mesh, int firstRow, int rows) {
    StripParams params{};
    params.size = ivec4(mLattice.size.x, rows, mLattice.size.z, mLattice.supersample);
    params.place = ivec4(firstRow, mLattice.view(), 0, 0);
    mParams.upload(&params, sizeof params);
    mChanges.clear();
    gpu::barrier();
    mParams.bindUniform(kParamsBlock);
    mChanges.bindStorage(kChangesBuffer);
    std::vector<Facet> facets;
    mesh.seek(firstRow, rows);
    for (mesh.next(facets, kFacetsPerDraw); !facets.empty(); mesh.next(facets, kFacetsPerDraw)) {
        const auto bytes = static_cast<std::int64_t>(facets.size() * sizeof(Facet));
        mFacets = gpu::Buffer(mDevice, bytes, facets.data());
        mFacets.bindStorage(kFacetsBuffer);
        gpu::drawTriangles(mCrossings, static_cast<std::int64_t>(facets.size()) * 3,
                           mLattice.view(), mLattice.view());
    }
    gpu::barrier();
    mDevice.check("voxelize");
    Counts counts(ivec3(mLattice.size.x, rows, mLattice.size.z));
    mChanges.read([&](const void* changes) {
        Summing(static_cast<const std::int32_t*>(changes), mLattice.most(), counts).run();
    });
    return counts;
}

} // namespace eikonal::voxelize
