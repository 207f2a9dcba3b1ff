// Coverage to material: what each voxel's share of the objects makes of its values.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/mixer.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

Mixer::Mixer(const Params& params, const std::vector<Grid>& grids, const Lattice& lattice)
    : mParams(params), mSize(lattice.size), mMost(lattice.most()), mOrder(params.objects.size()),
      mCovered(params.objects.size()) {
    std::iota(mOrder.begin(), mOrder.end(), size_t{0});
    std::sort(mOrder.begin(), mOrder.end(), [&](size_t a, size_t b) {
        const int pa = params.objects[a].priority, pb = params.objects[b].priority;
        return pa != pb ? pa > pb : a > b;
    });
    const size_t voxels = static_cast<size_t>(mSize.x) * mSize.y * mSize.z;
    for (Grid grid : grids) {
        Filled made;
        made.grid = grid;
        made.fallback = fallbackOf(params, grid);
        made.dense.size = mSize;
        made.dense.components = componentsOf(grid);
        made.dense.values.resize(voxels * static_cast<size_t>(made.dense.components));
        const auto add = [&](const Material& material) {
            made.values.push_back(valueOf(material, grid));
            made.weights.push_back(weightOf(material, grid));
            made.alone.emplace_back(made.weights.back() > 0 ? made.values.back() : made.fallback);
        };
        for (const Object& object : params.objects) add(object.material);
        add(params.medium);
        mGrids.push_back(std::move(made));
    }
}

void Mixer::mix(const std::vector<std::vector<std::uint16_t>>& counts, int firstRow, int rows) {
    std::vector<Tally> tallies(static_cast<size_t>(mSize.z));
    tbb::parallel_for(0, mSize.z, [&](int z) {
        Tally& tally = tallies[static_cast<size_t>(z)];
        tally.covered.resize(mCovered.size());
        for (int y = 0; y < rows; ++y) {
            const size_t from = (static_cast<size_t>(z) * rows + y) * mSize.x;
            const size_t to = (static_cast<size_t>(z) * mSize.y + firstRow + y) * mSize.x;
            mixRow(counts, from, to, tally);
        }
    });
    for (const Tally& tally : tallies) {
        mOccupied += tally.occupied;
        for (size_t k = 0; k < mCovered.size(); ++k) mCovered[k] += tally.covered[k];
    }
}

/// One row along x: `from` is its first voxel in the strip, `to` in the volume.
void Mixer::mixRow(const std::vector<std::vector<std::uint16_t>>& counts, size_t from, size_t to,
                   Tally& tally) {
    const size_t objects = counts.size();
    std::vector<int> shares(objects + 1); // the medium's last
    for (size_t x = 0; x < static_cast<size_t>(mSize.x); ++x) {
        int left = mMost;
        for (size_t k : mOrder) {
            const int covered = counts[k][from + x];
            tally.covered[k] += covered > 0;
            shares[k] = std::min(covered, left);
            left -= shares[k];
        }
        tally.occupied += left < mMost;
        shares[objects] = left;
        store(to + x, shares);
    }
}

/// The mean of the materials' values by share and weight.
void Mixer::store(size_t voxel, const std::vector<int>& shares) {
    // Nearly every voxel has one material, whose values are at hand.
    size_t only = 0;
    while (only < shares.size() && shares[only] != mMost) ++only;
    for (Filled& grid : mGrids) {
        const glm::vec3 value = only < shares.size() ? grid.alone[only] : meanOf(grid, shares);
        const auto components = static_cast<size_t>(grid.dense.components);
        for (size_t c = 0; c < components; ++c)
            grid.dense.values[voxel * components + c] = value[static_cast<int>(c)];
    }
}

glm::vec3 Mixer::meanOf(const Filled& grid, const std::vector<int>& shares) {
    glm::dvec3 sum(0);
    double weights = 0;
    for (size_t k = 0; k < shares.size(); ++k) {
        const double weight = shares[k] * grid.weights[k];
        sum += weight * grid.values[k];
        weights += weight;
    }
    return weights > 0 ? sum / weights : grid.fallback;
}

size_t Mixer::indexOf(Grid grid) const {
    for (size_t i = 0; i < mGrids.size(); ++i)
        if (mGrids[i].grid == grid) return i;
    throw InternalError("grid '" + nameOf(grid) + "' was not mixed");
}

volume::DenseGrid Mixer::take(Grid grid) {
    return std::move(mGrids[indexOf(grid)].dense);
}

bool Mixer::showsSomething(Grid grid) const {
    const volume::DenseGrid& dense = mGrids[indexOf(grid)].dense;
    const auto none = static_cast<float>(backgroundOf(mParams, grid).x);
    return std::any_of(dense.values.begin(), dense.values.end(),
                       [none](float value) { return value != none; });
}

} // namespace eikonal::voxelize
