// The tolerance octree (Sun et al. 2008, §4.2, §5.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/octree.h"

#include "scene/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace eikonal::lightsim {

namespace {

using glm::ivec3;
using scene::placeOf;
using volume::kBrick;

/// What index and extinction range over.
struct Range {
    float leastIndex, mostIndex, leastExtinction, mostExtinction; ///< the latter [1/voxel]

    void join(const Range& other) {
        leastIndex = std::min(leastIndex, other.leastIndex);
        mostIndex = std::max(mostIndex, other.mostIndex);
        leastExtinction = std::min(leastExtinction, other.leastExtinction);
        mostExtinction = std::max(mostExtinction, other.mostExtinction);
    }
};

/// The nodes of 2^k voxels, of one level.
struct Level {
    ivec3 nodes{0};
    std::vector<Range> ranges; ///< x fastest
};

/// Calls `visit(x, y, z)` for all nodes, slices in parallel.
template<typename Visit> void forEachNode(ivec3 nodes, const Visit& visit) {
    tbb::parallel_for(0, nodes.z, [&](int z) {
        for (int y = 0; y < nodes.y; ++y)
            for (int x = 0; x < nodes.x; ++x) visit(x, y, z);
    });
}

/// What the octree is made of, along rows of voxels.
class Source {
public:
    explicit Source(const Plan& plan)
        : mPlan(plan), mMedium(plan.scene.medium()),
          mDims(plan.attenuates && !plan.scene.sharp &&
                (mMedium.absorption.varies() || mMedium.scattering.varies())) {}

    bool varies() const { return mPlan.bends || mDims; }

    void indices(int y, int z, float* out) const {
        const scene::Index& index = mPlan.scene.index;
        // Of light that is bent most, where it matters.
        if (mPlan.bends)
            (index.dispersed.page.empty() ? index.grid : index.dispersed).copyRow(y, z, out);
    }

    /// σ_t of the channel that dims most [1/voxel].
    void extinctions(int y, int z, float* out) const {
        if (!mDims) return;
        const ivec3 size = mPlan.scene.size();
        for (int x = 0; x < size.x; ++x) {
            const bool begins = x == 0 || ((x - mPlan.scene.domain.firstBrick().x) % kBrick) == 0;
            out[x] = begins || !isEven({x, y, z}) ? extinctionAt({x, y, z}) : out[x - 1];
        }
    }

private:
    bool isEven(const ivec3& voxel) const {
        for (const scene::Values* values : {&mMedium.absorption, &mMedium.scattering})
            if (values->varies() && !values->isEven(values->grid.brickOf(voxel))) return false;
        return true;
    }

    float extinctionAt(const ivec3& voxel) const {
        float most = 0;
        for (int c = 0; c < mPlan.tracedChannels(); ++c)
            most =
                std::max(most, mMedium.absorption.at(voxel, c) + mMedium.scattering.at(voxel, c));
        return most * static_cast<float>(mPlan.scene.voxelSize());
    }

    const Plan& mPlan;
    const scene::Region& mMedium;
    bool mDims;
};

/// Nodes of two voxels an edge. Beyond the volume the nearest voxel answers: it adds nothing.
Level pairsOf(const Source& source, ivec3 size) {
    Level level{(size + 1) / 2, {}};
    level.ranges.resize(placeOf(level.nodes, 0, 0, level.nodes.z));
    tbb::parallel_for(0, level.nodes.z, [&](int z) {
        std::vector<float> n(static_cast<size_t>(size.x), 0.0f), sigma = n;
        for (int y = 0; y < level.nodes.y; ++y) {
            Range* row = level.ranges.data() + placeOf(level.nodes, 0, y, z);
            for (int k = 0; k < 4; ++k) {
                const int j = std::min(2 * y + k % 2, size.y - 1);
                const int i = std::min(2 * z + k / 2, size.z - 1);
                source.indices(j, i, n.data());
                source.extinctions(j, i, sigma.data());
                for (int x = 0; x < size.x; ++x) {
                    const auto at = static_cast<size_t>(x);
                    const Range one{n[at], n[at], sigma[at], sigma[at]};
                    if (k == 0 && x % 2 == 0)
                        row[x / 2] = one;
                    else
                        row[x / 2].join(one);
                }
            }
        }
    });
    return level;
}

/// Each node widened by its 26 neighbours: the field within a node depends on samples up to three
/// voxels beyond its faces, on the third by little; two are looked at, since three would take a
/// third more steps for a quarter less error.
Level widened(Level level) {
    const ivec3 last = level.nodes - 1;
    for (int axis = 0; axis < 3; ++axis) {
        Level wider{level.nodes, std::vector<Range>(level.ranges.size())};
        forEachNode(level.nodes, [&](int x, int y, int z) {
            ivec3 step(0);
            step[axis] = 1;
            const ivec3 here(x, y, z), low = glm::max(here - step, ivec3(0)),
                                       high = glm::min(here + step, last);
            Range range = level.ranges[placeOf(level.nodes, x, y, z)];
            range.join(level.ranges[placeOf(level.nodes, low.x, low.y, low.z)]);
            range.join(level.ranges[placeOf(level.nodes, high.x, high.y, high.z)]);
            wider.ranges[placeOf(level.nodes, x, y, z)] = range;
        });
        level = std::move(wider);
    }
    return level;
}

/// The next coarser level.
Level halved(const Level& level) {
    Level coarse{(level.nodes + 1) / 2, {}};
    coarse.ranges.resize(placeOf(coarse.nodes, 0, 0, coarse.nodes.z));
    const ivec3 last = level.nodes - 1;
    forEachNode(coarse.nodes, [&](int x, int y, int z) {
        Range range = level.ranges[placeOf(level.nodes, 2 * x, 2 * y, 2 * z)];
        for (int k = 1; k < 8; ++k) {
            const ivec3 p = glm::min(2 * ivec3(x, y, z) + ivec3(k & 1, k >> 1 & 1, k >> 2), last);
            range.join(level.ranges[placeOf(level.nodes, p.x, p.y, p.z)]);
        }
        coarse.ranges[placeOf(coarse.nodes, x, y, z)] = range;
    });
    return coarse;
}

/// From the coarsest level down: the first node whose range is within ε, or within ε' with a
/// limited step (§5.3), is the leaf. Voxels in none are leaves by themselves, level 0. The
/// extinction is held constant over a step too (the source leaves that out): a leaf's optical depth
/// must be known to ε.
std::uint32_t leafAt(const std::vector<Level>& levels, ivec3 pair, const Params& params) {
    const auto tolerance = static_cast<float>(params.octreeTolerance);
    const auto limit = static_cast<float>(params.stepLimit);
    for (int k = static_cast<int>(levels.size()); k >= 1; --k) {
        const Level& level = levels[static_cast<size_t>(k) - 1];
        const ivec3 node = pair >> (k - 1);
        const Range& range = level.ranges[placeOf(level.nodes, node.x, node.y, node.z)];
        const float spread = range.mostIndex - range.leastIndex;
        if ((range.mostExtinction - range.leastExtinction) * static_cast<float>(1 << k) > tolerance)
            continue;
        // Sun et al. set no limit within ε. But a kick grows with the step, and a spread below ε
        // over a large leaf may sit in two voxels of it: the limit falls from unlimited at spread 0
        // to that of ε' at spread ε.
        if (spread < tolerance) return packLeaf(k, limit * tolerance / std::max(spread, 1e-12f));
        if (spread < static_cast<float>(params.octreeTolerance2)) return packLeaf(k, limit);
    }
    return packLeaf(0, 0);
}

} // namespace

std::uint32_t packLeaf(int level, float limit) {
    return static_cast<std::uint32_t>(level) |
           static_cast<std::uint32_t>(std::clamp(limit, 0.0f, 1e6f) * 16.0f) << 5u;
}

Leaves makeLeaves(const Plan& plan, const Params& params) {
    const ivec3 size = plan.scene.size();
    Leaves leaves{(size + 1) / 2, {}};
    // Where nothing varies there is one leaf without a limit.
    leaves.packed.assign(placeOf(leaves.pairs, 0, 0, leaves.pairs.z), packLeaf(30, 1e6f));
    const Source source(plan);
    if (!source.varies()) return leaves;
    std::vector<Level> levels{widened(pairsOf(source, size))};
    while (levels.back().nodes != ivec3(1)) levels.push_back(halved(levels.back()));
    forEachNode(leaves.pairs, [&](int x, int y, int z) {
        leaves.packed[placeOf(leaves.pairs, x, y, z)] = leafAt(levels, {x, y, z}, params);
    });
    return leaves;
}

OctreeDump dumpOctree(const Plan& plan, const Params& params) {
    OctreeDump dump;
    dump.level.size = dump.stepLimit.size = plan.scene.size();
    const auto voxels = static_cast<size_t>(plan.voxels());
    dump.level.values.assign(voxels, 0);
    dump.stepLimit.values.assign(voxels, 1e6f);
    const Leaves leaves = makeLeaves(plan, params);
    size_t i = 0;
    for (int z = 0; z < plan.scene.size().z; ++z)
        for (int y = 0; y < plan.scene.size().y; ++y)
            for (int x = 0; x < plan.scene.size().x; ++x, ++i) {
                const std::uint32_t leaf =
                    leaves.packed[placeOf(leaves.pairs, x / 2, y / 2, z / 2)];
                dump.level.values[i] = static_cast<float>(leaf & 31u);
                dump.stepLimit.values[i] = (leaf & 31u) == 0
                                               ? static_cast<float>(params.stepMin)
                                               : static_cast<float>(leaf >> 5u) / 16.0f;
            }
    return dump;
}

} // namespace eikonal::lightsim
