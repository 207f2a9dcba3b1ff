// Grids that a stage made, taken into a scene volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "volume/contract.h"
#include "volume/entries.h"
#include "volume/level_set.h"
#include "volume/objects.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

namespace {

using openvdb::FloatGrid;
using openvdb::GridBase;
using openvdb::Vec3SGrid;

/// The reverse: a sparse tree of a dense array.
template<typename GridT>
typename GridT::Ptr copyIn(const IndexBox& box, const DenseGrid& in,
                           const typename GridT::ValueType& background, bool allActive) {
    using Value = typename GridT::ValueType;
    // Values that equal the background become inactive; one that occurs nowhere keeps all active.
    const Value none = openvdb::zeroVal<Value>() + std::numeric_limits<float>::lowest();
    auto grid = GridT::create(allActive ? none : background);
    const openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
        toBox(box), const_cast<Value*>(reinterpret_cast<const Value*>(in.values.data())));
    openvdb::tools::copyFromDense(dense, *grid, openvdb::zeroVal<Value>());
    if (allActive) openvdb::tools::changeBackground(grid->tree(), background);
    openvdb::tools::prune(grid->tree());
    return grid;
}

template<typename Value> Value valueOf(const float* from) {
    if constexpr (openvdb::VecTraits<Value>::IsVec)
        return {from[0], from[1], from[2]};
    else
        return *from;
}

/// A tree of bricks: of what is even, tiles.
template<typename GridT>
typename GridT::Ptr copyIn(const IndexBox& box, const BrickGrid& in,
                           const typename GridT::ValueType& background, bool allActive) {
    using Value = typename GridT::ValueType;
    using Leaf = typename GridT::TreeType::LeafNodeType;
    auto grid = GridT::create(background);
    std::vector<size_t> uneven;
    for (size_t brick = 0; brick < in.page.size(); ++brick) {
        const glm::ivec3 p = box.min + in.voxelOf(brick);
        if (in.page[brick] >= 0 || in.isCut(brick)) {
            uneven.push_back(brick);
            continue;
        }
        const auto value = valueOf<Value>(in.valuesOf(brick));
        if (allActive || value != background)
            grid->tree().addTile(1, openvdb::Coord(p.x, p.y, p.z), value, true);
    }
    std::vector<Leaf*> leaves(uneven.size());
    tbb::parallel_for(size_t{0}, uneven.size(), [&](size_t i) {
        const glm::ivec3 first = in.voxelOf(uneven[i]), p = box.min + first;
        leaves[i] = new Leaf(openvdb::Coord(p.x, p.y, p.z), background, false);
        const glm::ivec3 from = glm::max(first, glm::ivec3(0)) - first;
        const glm::ivec3 to = glm::min(first + kBrick, in.size) - first;
        for (int x = from.x; x < to.x; ++x)
            for (int y = from.y; y < to.y; ++y)
                for (int z = from.z; z < to.z; ++z) {
                    const auto value =
                        valueOf<Value>(in.valuesAt(uneven[i], (z * kBrick + y) * kBrick + x));
                    if (allActive || value != background)
                        leaves[i]->setValueOn(Leaf::coordToOffset(openvdb::Coord(x, y, z)), value);
                }
    });
    for (Leaf* leaf : leaves)
        if (leaf->isEmpty())
            delete leaf;
        else
            grid->tree().addLeaf(leaf);
    openvdb::tools::prune(grid->tree());
    return grid;
}

/// Whether an item tells of a grid's voxels or of how a file holds them, not of what it is.
bool tellsOfStorage(const std::string& item) {
    return item.rfind("file_", 0) == 0 || item == GridBase::META_SAVE_HALF_FLOAT;
}

} // namespace

void inherit(GridBase& made, const GridBase& old) {
    const auto gridClass = made.getGridClass();
    // Items of the same name may differ in type, which insertMeta() refuses to replace.
    for (auto item = old.beginMeta(); item != old.endMeta(); ++item) {
        if (tellsOfStorage(item->first)) continue;
        made.removeMeta(item->first);
        made.insertMeta(item->first, *item->second);
    }
    if (gridClass != openvdb::GRID_UNKNOWN || ruleFor(made.getName())) made.setGridClass(gridClass);
}

namespace {

/// Makes the voxels active that were so in the grid replaced, which held floats or doubles.
template<typename Floats, typename Doubles> void keepActive(Floats& made, const GridBase& old) {
    if (old.isType<Floats>())
        made.topologyUnion(static_cast<const Floats&>(old));
    else
        made.topologyUnion(static_cast<const Doubles&>(old));
    openvdb::tools::prune(made.tree());
}

template<typename Values>
void requireNumbers(const Values& values, const IndexBox& box, const std::string& grid) {
    if (const auto wrong = findFault(nullptr, values, box.min))
        throw InternalError("grid '" + grid + "': " + *wrong);
}

void describe(GridBase& made, const std::string& name, const PutOptions& options) {
    made.setName(name);
    if (!options.vectorType.empty())
        made.setVectorType(options.vectorType == "vector" ? openvdb::VEC_CONTRAVARIANT_RELATIVE
                                                          : openvdb::VEC_INVARIANT);
}

} // namespace

namespace {

/// Makes a grid of values and describes it, by what `old` (or null) was.
template<typename Values>
GridBase::Ptr made(const std::string& grid, const IndexBox& box, const Values& values,
                   const PutOptions& options, const Entry* old) {
    GridBase::Ptr result;
    const glm::vec3 b = options.background;
    if (values.components == 3) {
        const auto vectors =
            copyIn<Vec3SGrid>(box, values, openvdb::Vec3s(b.x, b.y, b.z), options.allActive);
        if (old && options.keepActive)
            keepActive<Vec3SGrid, openvdb::Vec3DGrid>(*vectors, *old->grid);
        result = vectors;
    } else {
        const auto scalars = copyIn<FloatGrid>(box, values, b.x, options.allActive);
        if (old && options.keepActive)
            keepActive<FloatGrid, openvdb::DoubleGrid>(*scalars, *old->grid);
        result = scalars;
    }
    if (old) {
        result->setName(grid);
        inherit(*result, *old->grid);
    } else {
        result->setCreator("eikonal");
    }
    describe(*result, grid, options);
    return result;
}

} // namespace

const Entry* Volume::Impl::replaced(const std::string& grid, int components) {
    const Entry* old = find(grid);
    const GridType type = components == 3 ? GridType::vector : GridType::scalar;
    return old && old->type == type ? &numbers(grid) : nullptr;
}

void Volume::put(const std::string& grid, const IndexBox& box, const DenseGrid& values,
                 const PutOptions& options) {
    requireNumbers(values, box, grid);
    mImpl->place(made(grid, box, values, options, mImpl->replaced(grid, values.components)));
}

void Volume::put(const std::string& grid, const IndexBox& box, const BrickGrid& values,
                 const PutOptions& options) {
    requireNumbers(values, box, grid);
    mImpl->place(made(grid, box, values, options, mImpl->replaced(grid, values.components)));
}

void Volume::putConstant(const std::string& grid, const glm::vec3& value) {
    const GridRule* rule = ruleFor(grid);
    if (!rule) throw InternalError("grid '" + grid + "': not of the contract, it has no type");
    GridBase::Ptr made;
    if (rule->type == GridType::vector) {
        const auto vectors = Vec3SGrid::create(openvdb::Vec3s(value.x, value.y, value.z));
        vectors->setVectorType(openvdb::VEC_INVARIANT);
        made = vectors;
    } else {
        made = FloatGrid::create(value.x);
    }
    made->setName(grid);
    made->setCreator("eikonal");
    mImpl->place(made);
}

void Volume::Impl::placeLevelSet(const ObjectFacts& object, const openvdb::FloatGrid::Ptr& made) {
    made->setCreator("eikonal");
    made->setGridClass(openvdb::GRID_LEVEL_SET);
    const Entry* old = find(object.sdf);
    if (old && old->grid) inherit(*made, *old->grid);
    describe(*made, object);
    made->setName(object.sdf);
    place(made);
}

void Volume::putLevelSet(const ObjectFacts& object, const IndexBox& box, const DenseGrid& values,
                         double halfWidth) {
    requireNumbers(values, box, object.sdf);
    const auto far = static_cast<float>(halfWidth * mImpl->frame.voxelSize);
    mImpl->placeLevelSet(object, makeLevelSet(box, values, far));
}

void Volume::putLevelSet(const ObjectFacts& object, const IndexBox& box, const BrickGrid& values,
                         double halfWidth) {
    requireNumbers(values, box, object.sdf);
    const auto far = static_cast<float>(halfWidth * mImpl->frame.voxelSize);
    mImpl->placeLevelSet(object, makeLevelSet(box, values, far));
}

} // namespace eikonal::volume
