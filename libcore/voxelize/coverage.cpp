// How much of each voxel lies inside a mesh, counted on the device.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/coverage.h"

#include "base/error.h"
#include "volume/bricks.h"

#include <algorithm>
#include <cstring>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

namespace {

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

/// Sums the changes along a column: how many sub-samples of each voxel lie inside.
void sumColumn(const std::int32_t* changes, int size, int most, std::uint16_t* counts) {
    constexpr int kRun = 8; // voxels looked at together
    int sum = 0;
    // Shells that overlap count as one solid: inside is where the winding number is not 0.
    const auto count = [&] { return static_cast<std::uint16_t>(std::clamp(sum, 0, most)); };
    for (int z = 0; z < size; z += kRun) {
        const int end = std::min(z + kRun, size);
        if (end - z == kRun) {
            std::uint64_t all[kRun / 2];
            std::memcpy(all, changes + z, sizeof all);
            if ((all[0] | all[1] | all[2] | all[3]) == 0) {
                std::fill_n(counts + z, kRun, count());
                continue;
            }
        }
        for (int i = z; i < end; ++i) {
            sum += changes[i];
            counts[i] = count();
        }
    }
}

} // namespace

std::vector<gpu::Need> coverageNeeds(const Lattice& lattice, std::int64_t stripBytes) {
    return {{"a strip of " + std::to_string(rowsOf(lattice, stripBytes)) + " rows of voxels",
             rowBytes(lattice) * rowsOf(lattice, stripBytes), true},
            {"the triangles of a draw", kFacetsPerDraw * sizeof(Facet), true}};
}

Coverage::Coverage(gpu::Device& device, const Lattice& lattice, std::int64_t stripBytes)
    : mDevice(device), mLattice(lattice), mRows(rowsOf(lattice, stripBytes)),
      mCrossings(device, "voxelize/crossings.vert.glsl", "voxelize/crossings.frag.glsl", {}),
      mChanges(device, rowBytes(lattice) * mRows), mParams(device, sizeof(StripParams)) {
    if (lattice.view() > device.limits().framebuffer)
        throw MemoryError("voxelising draws " + std::to_string(lattice.view()) +
                          " pixels along an edge, the device allows " +
                          std::to_string(device.limits().framebuffer));
}

void Coverage::count(FacetSource& mesh, int firstRow, int rows,
                     std::vector<std::uint16_t>& counts) {
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
    const std::int64_t voxels = std::int64_t{mLattice.size.x} * rows * mLattice.size.z;
    mDownload.resize(static_cast<size_t>(voxels));
    mChanges.download(mDownload.data(), voxels * 4);
    counts.resize(mDownload.size());
    const auto deep = static_cast<size_t>(mLattice.size.z);
    tbb::parallel_for(size_t{0}, mDownload.size() / deep, [&](size_t column) {
        sumColumn(mDownload.data() + column * deep, mLattice.size.z, mLattice.most(),
                  counts.data() + column * deep);
    });
}

} // namespace eikonal::voxelize
