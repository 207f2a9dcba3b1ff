// What bounds the objects of a scene with sharp boundaries.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/objects.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/lattice.h"
#include "scene/shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <tbb/parallel_for.h>

namespace eikonal::scene {

namespace {

using glm::ivec3;
using glm::vec3;
using volume::kBrick;

/// Distances are kept this far out [voxel].
constexpr float kKept = 5;

/// The voxels of a brick that are in the domain.
volume::IndexBox voxelsOf(const volume::BrickGrid& grid, size_t brick) {
    const ivec3 low = grid.voxelOf(brick);
    return {glm::max(low, ivec3(0)), glm::min(low + kBrick, grid.size) - 1};
}

template<typename Visit> void forEachVoxel(const volume::IndexBox& box, const Visit& visit) {
    for (int z = box.min.z; z <= box.max.z; ++z)
        for (int y = box.min.y; y <= box.max.y; ++y)
            for (int x = box.min.x; x <= box.max.x; ++x) visit(ivec3(x, y, z));
}

/// A voxel beside which, along an axis, a sign is lost.
struct Lost {
    ivec3 voxel;
    int axis;
};

/// What is seen of an object in some bricks.
struct Facts {
    volume::IndexBox box, inside;
    double slopes = 0;
    std::int64_t sloped = 0;
    std::vector<std::uint32_t> cells; ///< blocks that are looked up, some more than once
    std::optional<Lost> lost;         ///< the first
};

/// The box of single voxels.
struct Extent {
    ivec3 min{std::numeric_limits<int>::max()}, max{-1};

    void take(ivec3 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
};

/// Looks at bricks' voxels, and at those beside them.
class Inspector {
public:
    explicit Inspector(const Object& object)
        : mGrid(object.distance), mBlocks(cellBlocks(object.distance.size)), mBand(object.band) {}

    /// Adds what a layer of bricks has.
    Facts inspectLayer(int z) const {
        Facts facts;
        const size_t layer = static_cast<size_t>(mGrid.bricks.x) * mGrid.bricks.y;
        for (size_t brick = layer * z; brick < layer * (z + 1); ++brick) {
            // Of the 2³ blocks of cells about the brick.
            const unsigned near =
                mGrid.page[brick] < 0 ? inspectEven(brick, facts) : inspectVoxels(brick, facts);
            addCells(brick, near, facts);
        }
        return facts;
    }

private:
    unsigned inspectEven(size_t brick, Facts& facts) const {
        const float d = mGrid.even[brick];
        const volume::IndexBox own = voxelsOf(mGrid, brick);
        if (d < within()) facts.box.include(own);
        if (d < kCornerWay) facts.inside.include(own);
        // Only beyond its faces are other values.
        for (int axis = 0; axis < 3; ++axis) {
            if (own.max[axis] + 1 == mGrid.size[axis]) continue;
            volume::IndexBox face = own;
            face.min[axis] = face.max[axis];
            ivec3 next = own.max;
            ++next[axis];
            if (mGrid.page[mGrid.brickOf(next)] < 0) face = {own.max, own.max};
            forEachVoxel(face, [&](ivec3 q) { compare(q, axis, d, facts); });
        }
        return std::abs(d) < kNearby ? 255u : 0u;
    }

    /// The voxel is a corner of cells p to p + 1, whose blocks begin where voxels' bricks need not.
    static unsigned blocksAbout(ivec3 p, ivec3 first) {
        const ivec3 low = (p >> volume::kBrickBits) - first;
        const ivec3 high = ((p + 1) >> volume::kBrickBits) - first;
        unsigned bits = 0;
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    bits |= 1u << static_cast<unsigned>(4 * z + 2 * y + x);
        return bits;
    }

    void addCells(size_t brick, unsigned near, Facts& facts) const {
        const ivec3 first = mGrid.voxelOf(brick) >> volume::kBrickBits;
        for (unsigned k = 0; near >> k > 0; ++k) {
            const ivec3 b = first + ivec3(k & 1, k >> 1 & 1, k >> 2);
            if (((near >> k) & 1u) == 1u && b == glm::clamp(b, ivec3(0), mBlocks - 1))
                facts.cells.push_back(static_cast<std::uint32_t>(placeOf(mBlocks, b.x, b.y, b.z)));
        }
    }

    /// The blocks that a boundary is near to.
    unsigned inspectVoxels(size_t brick, Facts& facts) const {
        constexpr int kEdge = kBrick + 2; // with the voxels beside it
        constexpr std::array<int, 3> kStrides{1, kEdge, kEdge * kEdge};
        const ivec3 low = mGrid.voxelOf(brick), first = low >> volume::kBrickBits;
        std::array<float, kEdge * kEdge * kEdge> values;
        mGrid.copyBox(low - 1, ivec3(kEdge), values.data());
        const float steep = std::min(2.0f, mBand - 1.5f), jump = 1.5f * mBand;
        unsigned near = 0;
        Extent box, inside;
        forEachVoxel(voxelsOf(mGrid, brick), [&](ivec3 p) {
            const ivec3 in = p - low + 1;
            const float* at = values.data() + (in.z * kEdge + in.y) * kEdge + in.x;
            const float d = *at;
            if (d < within()) box.take(p);
            if (d < kCornerWay) inside.take(p);
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(d - at[kStrides[axis]]) > jump && !facts.lost)
                    facts.lost = Lost{p, axis};
            if (std::abs(d) < kNearby) near |= blocksAbout(p, first);
            if (std::abs(d) > steep || glm::any(glm::equal(p, ivec3(0))) ||
                glm::any(glm::equal(p, mGrid.size - 1)))
                return;
            vec3 rise;
            for (int axis = 0; axis < 3; ++axis)
                rise[axis] = 0.5f * (at[kStrides[axis]] - at[-kStrides[axis]]);
            facts.slopes += static_cast<double>(glm::length(rise));
            ++facts.sloped;
        });
        facts.box.include({box.min, box.max});
        facts.inside.include({inside.min, inside.max});
        return near;
    }

    /// Two neighbours on either side of a boundary are no further apart than one voxel; where
    /// nearly the whole band lies between them, one has lost its sign.
    void compare(ivec3 p, int axis, float d, Facts& facts) const {
        if (facts.lost || p[axis] + 1 == mGrid.size[axis]) return;
        ivec3 next = p;
        ++next[axis];
        if (std::abs(d - mGrid.at(next)) <= 1.5f * mBand) return;
        facts.lost = Lost{p, axis};
    }

    float within() const { return std::min(mBand, kKept); }

    const volume::BrickGrid& mGrid;
    ivec3 mBlocks;
    float mBand;
};

float bandOf(const volume::BrickGrid& grid) {
    float band = 0;
    for (size_t brick = 0; brick < grid.page.size(); ++brick)
        if (grid.page[brick] < 0) band = std::max(band, std::abs(grid.even[brick]));
    for (const float d : grid.values) band = std::max(band, std::abs(d));
    return band;
}

[[noreturn]] void refuseLostSign(const Object& object, const Lost& lost, float voxelSize,
                                 const ivec3& origin, const std::string& where) {
    ivec3 next = lost.voxel;
    ++next[lost.axis];
    const ivec3 voxel = lost.voxel + origin;
    throw DataError(where + ": the signed distance jumps from " +
                    toText(object.distance.at(lost.voxel) * voxelSize) + " to " +
                    toText(object.distance.at(next) * voxelSize) + " beside voxel (" +
                    std::to_string(voxel.x) + ", " + std::to_string(voxel.y) + ", " +
                    std::to_string(voxel.z) +
                    "), expected a change of about a voxel: a sign is lost");
}

/// Finds all but the distances of an object. Returns where a sign is lost, if it is.
std::optional<Lost> inspect(Object& object) {
    object.band = bandOf(object.distance);
    const Inspector inspector(object);
    std::vector<Facts> layers(static_cast<size_t>(object.distance.bricks.z));
    tbb::parallel_for(size_t{0}, layers.size(),
                      [&](size_t z) { layers[z] = inspector.inspectLayer(static_cast<int>(z)); });
    std::optional<Lost> lost;
    double slopes = 0;
    std::int64_t sloped = 0;
    for (const Facts& layer : layers) {
        if (!lost) lost = layer.lost;
        object.box.include(layer.box);
        object.inside.include(layer.inside);
        slopes += layer.slopes;
        sloped += layer.sloped;
        object.cells.insert(object.cells.end(), layer.cells.begin(), layer.cells.end());
    }
    std::sort(object.cells.begin(), object.cells.end());
    object.cells.erase(std::unique(object.cells.begin(), object.cells.end()), object.cells.end());
    // Outside the domain: its first voxel will do.
    if (object.box.empty()) object.box = {ivec3(0), ivec3(0)};
    if (sloped > 0) object.slope = static_cast<float>(slopes / static_cast<double>(sloped));
    return lost;
}

} // namespace

Object readObject(const volume::Volume& volume, const std::string& sdf,
                  const volume::IndexBox& box) {
    const auto h = static_cast<float>(volume.frame().voxelSize);
    const std::string where = volume.path() + ": grid '" + sdf + "'";
    const float outside = volume.background(sdf, vec3(0)).x;
    if (outside < 0)
        throw DataError(where + ": it is " + toText(outside) +
                        " outside, expected 0 or above: it is inside out");
    Object object;
    object.distance = volume.bricks(sdf, box);
    for (float& d : object.distance.even) d /= h;
    tbb::parallel_for(
        size_t{0}, object.distance.values.size() / volume::kBrickVoxels, [&](size_t brick) {
            float* values = object.distance.values.data() + brick * volume::kBrickVoxels;
            for (int i = 0; i < volume::kBrickVoxels; ++i) values[i] /= h;
        });
    if (const std::optional<Lost> lost = inspect(object))
        refuseLostSign(object, *lost, h, box.min, where);
    return object;
}

Object makeObject(volume::BrickGrid distance) {
    Object object;
    object.distance = std::move(distance);
    inspect(object);
    return object;
}

bool areMany(const std::vector<Object>& objects) {
    return objects.size() > static_cast<size_t>(kFewObjects);
}

int mostNear(const std::vector<Object>& objects) {
    const ivec3 blocks = cellBlocks(objects.front().distance.size);
    std::vector<std::uint8_t> near(placeOf(blocks, 0, 0, blocks.z));
    for (const Object& object : objects)
        for (const std::uint32_t cell : object.cells) ++near[cell];
    return *std::max_element(near.begin(), near.end());
}

} // namespace eikonal::scene
