// Grids as bricks: out of OpenVDB's trees.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/bricks.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/entries.h"

#include <algorithm>
#include <glm/common.hpp>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

namespace {

using glm::ivec3;

/// A number as a float.
struct Rounded {
    template<typename Number> float operator()(Number value) const {
        return static_cast<float>(value);
    }
};

/// What a float of a number lacks of it.
struct RoundedOff {
    float operator()(double value) const {
        return static_cast<float>(value - static_cast<double>(static_cast<float>(value)));
    }
};

/// Returns where the next one goes.
template<typename Part, typename Value> float* copyValue(const Value& value, float* out) {
    if constexpr (openvdb::VecTraits<Value>::IsVec) {
        for (int c = 0; c < 3; ++c) *out++ = Part{}(value[c]);
    } else {
        *out++ = Part{}(value);
    }
    return out;
}

/// Voxel (x, y, z) of a leaf is at 64 x + 8 y + z.
template<typename Part, typename Leaf> void copyLeaf(const Leaf& leaf, float* out) {
    const auto* in = leaf.buffer().data();
    for (int z = 0; z < kBrick; ++z)
        for (int y = 0; y < kBrick; ++y)
            for (int x = 0; x < kBrick; ++x)
                out = copyValue<Part>(in[kBrick * (kBrick * x + y) + z], out);
}

template<typename Grid, typename Part = Rounded>
void fill(const openvdb::GridBase& base, const IndexBox& box, BrickGrid& out) {
    const auto& tree = static_cast<const Grid&>(base).tree();
    const auto components = static_cast<size_t>(out.components);
    using Leaf = typename Grid::TreeType::LeafNodeType;
    std::vector<const Leaf*> leaves(out.page.size());
    tbb::parallel_for(0, out.bricks.z, [&](int z) {
        typename Grid::ConstAccessor accessor(tree);
        size_t brick = static_cast<size_t>(z) * out.bricks.y * out.bricks.x;
        for (int y = 0; y < out.bricks.y; ++y)
            for (int x = 0; x < out.bricks.x; ++x, ++brick) {
                const ivec3 p = box.min + out.first + kBrick * ivec3(x, y, z);
                const openvdb::Coord at(p.x, p.y, p.z);
                leaves[brick] = accessor.template probeConstNode<Leaf>(at);
                if (!leaves[brick])
                    copyValue<Part>(accessor.getValue(at), out.even.data() + brick * components);
            }
    });
    std::vector<size_t> uneven;
    for (size_t brick = 0; brick < leaves.size(); ++brick)
        if (leaves[brick]) {
            out.page[brick] = static_cast<std::int32_t>(uneven.size());
            uneven.push_back(brick);
        }
    out.values.resize(uneven.size() * kBrickVoxels * components);
    tbb::parallel_for(size_t{0}, uneven.size(), [&](size_t i) {
        copyLeaf<Part>(*leaves[uneven[i]], out.values.data() + i * kBrickVoxels * components);
    });
}

/// The first voxel of a brick within the box whose value breaks the rule, and how.
std::optional<std::string> faultOf(const GridRule* rule, const BrickGrid& grid, size_t brick,
                                   const ivec3& origin) {
    const bool even = grid.page[brick] < 0;
    const float* values = grid.valuesOf(brick);
    const int count = even ? 1 : kBrickVoxels;
    if (areValid(rule, values, static_cast<size_t>(count) * grid.components)) return std::nullopt;
    for (int i = 0; i < count; ++i) {
        std::optional<std::string> wrong;
        for (int c = 0; c < grid.components && !wrong; ++c)
            wrong = fault(rule, values[i * grid.components + c]);
        if (!wrong) continue;
        ivec3 p = grid.voxelOf(brick) + ivec3(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick);
        if (even) p = glm::max(p, ivec3(0));
        if (p != glm::clamp(p, ivec3(0), grid.size - 1)) continue;
        const ivec3 voxel = p + origin;
        return "voxel (" + std::to_string(voxel.x) + ", " + std::to_string(voxel.y) + ", " +
               std::to_string(voxel.z) + ") " + *wrong;
    }
    return std::nullopt;
}

} // namespace

BrickGrid::BrickGrid(const ivec3& boxSize, const ivec3& firstVoxel, float value, int perVoxel)
    : components(perVoxel), size(boxSize), first(firstVoxel),
      bricks((boxSize - firstVoxel + kBrick - 1) / kBrick) {
    const size_t count = static_cast<size_t>(bricks.x) * bricks.y * bricks.z;
    page.assign(count, -1);
    even.assign(count * static_cast<size_t>(components), value);
}

const float* BrickGrid::valuesOf(size_t brick) const {
    const auto count = static_cast<size_t>(components);
    return page[brick] < 0
               ? even.data() + brick * count
               : values.data() + static_cast<size_t>(page[brick]) * kBrickVoxels * count;
}

void BrickGrid::copyBox(const ivec3& low, const ivec3& edges, float* out) const {
    for (int z = 0; z < edges.z; ++z)
        for (int y = 0; y < edges.y; ++y)
            for (int x = 0; x < edges.x;) {
                const ivec3 wanted = low + ivec3(x, y, z);
                const ivec3 at = glm::clamp(wanted, ivec3(0), size - 1);
                const size_t brick = brickOf(at);
                const ivec3 p = (at - first) & (kBrick - 1);
                const int run = std::min({kBrick - p.x, size.x - at.x, edges.x - x});
                const int count = at.x == wanted.x ? run : 1;
                if (page[brick] < 0)
                    std::fill_n(out, count, even[brick]);
                else
                    std::copy_n(valuesOf(brick) + (p.z * kBrick + p.y) * kBrick + p.x, count, out);
                out += count;
                x += count;
            }
}

bool BrickGrid::isCut(size_t brick) const {
    const ivec3 low = voxelOf(brick);
    return low != glm::max(low, ivec3(0)) || low + kBrick != glm::min(low + kBrick, size);
}

ivec3 BrickGrid::voxelOf(size_t brick) const {
    const auto b = static_cast<int>(brick);
    return first + kBrick * ivec3(b % bricks.x, b / bricks.x % bricks.y, b / bricks.x / bricks.y);
}

std::optional<std::string> findFault(const GridRule* rule, const BrickGrid& grid,
                                     const glm::ivec3& origin) {
    const size_t plane = static_cast<size_t>(grid.bricks.x) * grid.bricks.y;
    std::vector<std::optional<std::string>> faults(static_cast<size_t>(grid.bricks.z));
    tbb::parallel_for(size_t{0}, faults.size(), [&](size_t z) {
        for (size_t brick = z * plane; brick < (z + 1) * plane && !faults[z]; ++brick)
            faults[z] = faultOf(rule, grid, brick, origin);
    });
    for (const auto& wrong : faults)
        if (wrong) return wrong;
    return std::nullopt;
}

BrickGrid Volume::bricks(const std::string& grid, const IndexBox& box) const {
    require(grid);
    Entry& entry = mImpl->numbers(grid);
    try {
        BrickGrid out(box.size(), box.firstBrick(), 0, entry.type == GridType::vector ? 3 : 1);
        const openvdb::GridBase& values = *entry.grid;
        if (values.isType<openvdb::FloatGrid>())
            fill<openvdb::FloatGrid>(values, box, out);
        else if (values.isType<openvdb::DoubleGrid>())
            fill<openvdb::DoubleGrid>(values, box, out);
        else if (values.isType<openvdb::Vec3SGrid>())
            fill<openvdb::Vec3SGrid>(values, box, out);
        else
            fill<openvdb::Vec3DGrid>(values, box, out);
        if (const auto wrong = findFault(ruleFor(grid), out, box.min))
            throw DataError(mImpl->where(grid) + ": " + *wrong);
        return out;
    } catch (const std::bad_alloc&) {
        throw MemoryError(mImpl->where(grid) + " needs more memory than there is");
    }
}

BrickGrid Volume::remainders(const std::string& grid, const IndexBox& box) const {
    require(grid);
    Entry& entry = mImpl->numbers(grid);
    if (!entry.grid->isType<openvdb::DoubleGrid>()) return {};
    try {
        BrickGrid out(box.size(), box.firstBrick(), 0);
        fill<openvdb::DoubleGrid, RoundedOff>(*entry.grid, box, out);
        const auto isZero = [](float value) { return value == 0; };
        const bool none = std::all_of(out.even.begin(), out.even.end(), isZero) &&
                          std::all_of(out.values.begin(), out.values.end(), isZero);
        return none ? BrickGrid{} : out;
    } catch (const std::bad_alloc&) {
        throw MemoryError(mImpl->where(grid) + " needs more memory than there is");
    }
}

} // namespace eikonal::volume
