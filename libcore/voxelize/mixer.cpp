// Coverage to material: what each voxel's share of the objects makes of its values.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/mixer.h"

#include "base/error.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <tbb/parallel_for.h>

namespace eikonal::voxelize {

/// The counts of a brick's voxels.
class Mixer::Brick {
public:
    Brick(const std::vector<Counts>& counts, const glm::ivec3& brick)
        : mCounts(counts), mBrick(counts.front().brickAt(brick)),
          mSize(
              glm::min(counts.front().size - volume::kBrick * brick, glm::ivec3(volume::kBrick))) {}

    const glm::ivec3& size() const { return mSize; }
    int at(size_t object, size_t voxel) const { return mCounts[object].at(mBrick, voxel); }
    /// Whether an object's count is the same in all of them.
    bool isEven(size_t object) const { return mCounts[object].isEven(mBrick); }

private:
    const std::vector<Counts>& mCounts;
    size_t mBrick;
    glm::ivec3 mSize;
};

Mixer::Mixer(const Params& params, const std::vector<Grid>& grids, const Lattice& lattice)
    : mParams(params), mSize(lattice.size), mMost(lattice.most()), mOrder(params.objects.size()),
      mCovered(params.objects.size()) {
    std::iota(mOrder.begin(), mOrder.end(), size_t{0});
    std::sort(mOrder.begin(), mOrder.end(), [&](size_t a, size_t b) {
        const int pa = params.objects[a].priority, pb = params.objects[b].priority;
        return pa != pb ? pa > pb : a > b;
    });
    for (Grid grid : grids) {
        Filled made;
        made.grid = grid;
        made.fallback = fallbackOf(params, grid);
        made.bricks = volume::BrickGrid(mSize, glm::ivec3(0), 0, componentsOf(grid));
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

void Mixer::mix(const std::vector<Counts>& counts, int firstRow) {
    const glm::ivec3 bricks = counts.front().bricks;
    const int deep = (mSize.y + volume::kBrick - 1) / volume::kBrick;
    std::vector<Slab> slabs(static_cast<size_t>(bricks.y) * bricks.z);
    tbb::parallel_for(size_t{0}, slabs.size(), [&](size_t i) {
        slabs[i].covered.resize(mCovered.size());
        slabs[i].values.resize(mGrids.size());
        const int y = static_cast<int>(i) % bricks.y, z = static_cast<int>(i) / bricks.y;
        size_t place = (static_cast<size_t>(z) * deep + firstRow / volume::kBrick + y) * bricks.x;
        for (int x = 0; x < bricks.x; ++x, ++place)
            mixBrick(Brick(counts, glm::ivec3(x, y, z)), place, slabs[i]);
    });
    for (const Slab& slab : slabs) takeIn(slab);
}

void Mixer::mixBrick(const Brick& brick, size_t place, Slab& slab) {
    Shares& shares = slab.shares;
    shares.samples.assign(mCovered.size() + 1, 0);
    shares.takers.clear();
    bool even = true;
    for (size_t k : mOrder) {
        const bool own = brick.isEven(k);
        even = even && own;
        if (!own || brick.at(k, 0) > 0) shares.takers.push_back(k);
    }
    shares.sorted = shares.takers;
    std::sort(shares.sorted.begin(), shares.sorted.end());
    shares.sorted.push_back(mCovered.size());
    const glm::ivec3 size = brick.size();
    if (even) {
        tally(brick, 0, std::int64_t{size.x} * size.y * size.z, shares, slab);
        for (size_t g = 0; g < mGrids.size(); ++g) {
            volume::BrickGrid& grid = mGrids[g].bricks;
            store(shares, g, grid.even.data() + place * static_cast<size_t>(grid.components));
        }
        return;
    }
    std::vector<size_t> begin;
    for (size_t g = 0; g < mGrids.size(); ++g) {
        begin.push_back(slab.values[g].size());
        slab.values[g].resize(begin.back() + volume::kBrickVoxels *
                                                 static_cast<size_t>(mGrids[g].bricks.components));
    }
    slab.uneven.push_back(place);
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto voxel =
                    static_cast<size_t>((z * volume::kBrick + y) * volume::kBrick + x);
                tally(brick, voxel, 1, shares, slab);
                for (size_t g = 0; g < mGrids.size(); ++g)
                    store(shares, g,
                          slab.values[g].data() + begin[g] +
                              voxel * static_cast<size_t>(mGrids[g].bricks.components));
            }
}

/// Counts `times` voxels like this one, and shares its samples out, what is left to the medium.
void Mixer::tally(const Brick& brick, size_t voxel, std::int64_t times, Shares& shares,
                  Slab& slab) const {
    int left = mMost;
    for (size_t k : shares.takers) {
        const int covered = brick.at(k, voxel);
        slab.covered[k] += covered > 0 ? times : 0;
        shares.samples[k] = std::min(covered, left);
        left -= shares.samples[k];
    }
    slab.occupied += left < mMost ? times : 0;
    shares.samples.back() = left;
}

/// The mean of the materials' values by share and weight.
void Mixer::store(const Shares& shares, size_t grid, float* out) const {
    // Nearly every voxel has one material, whose values are at hand.
    const Filled& filled = mGrids[grid];
    const auto only = std::find_if(shares.sorted.begin(), shares.sorted.end(),
                                   [&](size_t k) { return shares.samples[k] == mMost; });
    const glm::vec3 value =
        only != shares.sorted.end() ? filled.alone[*only] : meanOf(filled, shares);
    for (int c = 0; c < filled.bricks.components; ++c) out[c] = value[c];
}

void Mixer::takeIn(const Slab& slab) {
    mOccupied += slab.occupied;
    for (size_t k = 0; k < mCovered.size(); ++k) mCovered[k] += slab.covered[k];
    for (size_t g = 0; g < mGrids.size(); ++g) {
        volume::BrickGrid& grid = mGrids[g].bricks;
        const size_t begin =
            grid.values.size() / volume::kBrickVoxels / static_cast<size_t>(grid.components);
        for (size_t i = 0; i < slab.uneven.size(); ++i)
            grid.page[slab.uneven[i]] = static_cast<std::int32_t>(begin + i);
        grid.values.insert(grid.values.end(), slab.values[g].begin(), slab.values[g].end());
    }
}

glm::vec3 Mixer::meanOf(const Filled& grid, const Shares& shares) {
    glm::dvec3 sum(0);
    double weights = 0;
    for (size_t k : shares.sorted) {
        const double weight = shares.samples[k] * grid.weights[k];
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

volume::BrickGrid Mixer::take(Grid grid) {
    return std::move(mGrids[indexOf(grid)].bricks);
}

bool Mixer::showsSomething(Grid grid) const {
    const volume::BrickGrid& bricks = mGrids[indexOf(grid)].bricks;
    const auto none = static_cast<float>(backgroundOf(mParams, grid).x);
    const auto shows = [none](float value) { return value != none; };
    const auto components = static_cast<size_t>(bricks.components);
    for (size_t i = 0; i < bricks.even.size(); ++i)
        if (bricks.page[i / components] < 0 && shows(bricks.even[i])) return true;
    return std::any_of(bricks.values.begin(), bricks.values.end(), shows);
}

} // namespace eikonal::voxelize
