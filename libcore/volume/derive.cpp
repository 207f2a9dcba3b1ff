// A grid of the contract made of another grid's values, each by itself, in double.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/text.h"
#include "volume/contract.h"
#include "volume/entries.h"
#include "volume/objects.h"

#include <algorithm>
#include <cmath>
#include <openvdb/openvdb.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

namespace {

using openvdb::Coord;

/// What was met in a part of the tree.
struct Met {
    Cut cut;
    std::string fault; // of the first voxel that has one
    Coord place;
};

/// Values by a law, held to the contract's range.
class Maker {
public:
    Maker(const Law& law, const GridRule& rule, std::string to)
        : mLaw(law), mRule(rule), mTo(std::move(to)) {}

    /// The number made; notes in `met` what is wrong with it, or how many of `voxels` it cuts.
    double number(double value, int component, std::int64_t voxels, Met& met) const {
        if (!std::isfinite(value) || !(value > mLaw.above)) {
            if (met.fault.empty())
                met.fault = "is " + textOf(value) + ", expected " +
                            (mLaw.wanted.empty() ? "a finite number" : mLaw.wanted);
            return 0;
        }
        double made = mLaw.value(value, component);
        if (made < double{mRule.least} && !mRule.leastOpen) {
            made = double{mRule.least};
            met.cut.below += voxels;
        } else if (made > double{mRule.most} && !mRule.mostOpen && std::isfinite(made) &&
                   mRule.most <= 1) {
            made = double{mRule.most};
            met.cut.above += voxels;
        }
        if (met.fault.empty())
            if (const auto wrong = fault(&mRule, static_cast<float>(made)))
                met.fault = "is " + textOf(value) + ", by which '" + mTo + "' " + *wrong;
        return made;
    }

    template<typename Out, typename In>
    Out make(const In& in, std::int64_t voxels, Met& met) const {
        constexpr bool fromVector = openvdb::VecTraits<In>::IsVec;
        if constexpr (openvdb::VecTraits<Out>::IsVec) {
            Out out;
            Met each[3];
            for (int c = 0; c < 3; ++c) {
                double value;
                if constexpr (fromVector)
                    value = static_cast<double>(in[c]);
                else
                    value = static_cast<double>(in);
                out[c] = static_cast<typename Out::value_type>(number(value, c, 1, each[c]));
                if (met.fault.empty()) met.fault = each[c].fault;
            }
            // A voxel counts once, however many of its components are cut.
            const auto any = [&](std::int64_t Cut::*side) {
                return std::any_of(each, each + 3, [=](const Met& m) { return m.cut.*side > 0; });
            };
            met.cut.below += any(&Cut::below) ? voxels : 0;
            met.cut.above += any(&Cut::above) ? voxels : 0;
            return out;
        } else {
            return static_cast<Out>(number(static_cast<double>(in), 0, voxels, met));
        }
    }

    template<typename In> In outsideOr(const In& in) const {
        if (!mLaw.outside) return in;
        return openvdb::zeroVal<In>() +
               static_cast<typename openvdb::VecTraits<In>::ElementType>(*mLaw.outside);
    }

private:
    static std::string textOf(double value) {
        return std::isnan(value)   ? "NaN"
               : std::isinf(value) ? "infinite"
                                   : toText(static_cast<float>(value));
    }

    const Law& mLaw;
    const GridRule& mRule;
    std::string mTo;
};

std::string voxelText(const Coord& p) {
    return "voxel (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " +
           std::to_string(p.z()) + ") ";
}

/// The same tree with other values. Throws DataError, led by `where`.
template<typename OutGrid, typename InGrid>
typename OutGrid::Ptr transformed(const InGrid& in, const Maker& maker, const std::string& where,
                                  Cut& cut) {
    using In = typename InGrid::ValueType;
    using Out = typename OutGrid::ValueType;
    using OutLeaf = typename OutGrid::TreeType::LeafNodeType;
    Met outside;
    const Out background = maker.make<Out, In>(maker.outsideOr(in.background()), 0, outside);
    if (!outside.fault.empty()) throw DataError(where + ": the background " + outside.fault);
    auto out = OutGrid::create(std::make_shared<typename OutGrid::TreeType>(
        in.tree(), background, openvdb::TopologyCopy()));

    auto tile = in.cbeginValueAll();
    tile.setMaxDepth(InGrid::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        Met met;
        const bool on = tile.isValueOn();
        const auto voxels = on ? static_cast<std::int64_t>(tile.getVoxelCount()) : 0;
        const In value = on ? *tile : maker.outsideOr(*tile);
        out->tree().addTile(tile.getLevel(), tile.getCoord(), maker.make<Out>(value, voxels, met),
                            on);
        if (!met.fault.empty())
            throw DataError(where + ": " + voxelText(tile.getCoord()) + met.fault);
        cut.below += met.cut.below;
        cut.above += met.cut.above;
    }

    std::vector<OutLeaf*> leaves;
    out->tree().getNodes(leaves);
    std::vector<Met> met(leaves.size());
    tbb::parallel_for(size_t{0}, leaves.size(), [&](size_t i) {
        OutLeaf& leaf = *leaves[i];
        const auto& from = *in.tree().probeConstLeaf(leaf.origin());
        for (openvdb::Index v = 0; v < OutLeaf::SIZE; ++v) {
            const bool on = from.isValueOn(v), fine = met[i].fault.empty();
            const In value = on ? from.getValue(v) : maker.outsideOr(from.getValue(v));
            leaf.setValueOnly(v, maker.make<Out>(value, on ? 1 : 0, met[i]));
            if (fine && !met[i].fault.empty()) met[i].place = leaf.offsetToGlobalCoord(v);
        }
    });
    for (const Met& one : met) {
        if (!one.fault.empty()) throw DataError(where + ": " + voxelText(one.place) + one.fault);
        cut.below += one.cut.below;
        cut.above += one.cut.above;
    }
    return out;
}

template<typename OutGrid>
openvdb::GridBase::Ptr transformedAny(const openvdb::GridBase& in, const Maker& maker,
                                      const std::string& where, Cut& cut) {
    if (in.isType<openvdb::FloatGrid>())
        return transformed<OutGrid>(static_cast<const openvdb::FloatGrid&>(in), maker, where, cut);
    if (in.isType<openvdb::DoubleGrid>())
        return transformed<OutGrid>(static_cast<const openvdb::DoubleGrid&>(in), maker, where, cut);
    if constexpr (openvdb::VecTraits<typename OutGrid::ValueType>::IsVec) {
        if (in.isType<openvdb::Vec3SGrid>())
            return transformed<OutGrid>(static_cast<const openvdb::Vec3SGrid&>(in), maker, where,
                                        cut);
        return transformed<OutGrid>(static_cast<const openvdb::Vec3DGrid&>(in), maker, where, cut);
    }
    throw InternalError(where + " holds no number a voxel");
}

} // namespace

Cut Volume::derive(const std::string& from, const std::string& to, const Law& law) {
    if (!mImpl->find(from))
        throw DataError(mImpl->path + ": no grid '" + from + "' (found: " + mImpl->foundNames() +
                        ")");
    const GridRule* rule = ruleFor(to);
    if (!rule) throw InternalError("grid '" + to + "': not of the contract, it has no type");
    const Entry& source = mImpl->numbers(from);
    const std::string where = mImpl->where(from);
    const bool fromVector = source.type == GridType::vector;
    if (fromVector && rule->type == GridType::scalar)
        throw DataError(where + " holds " + source.valueType + ", expected float for '" + to + "'");
    const Maker maker(law, *rule, to);
    Cut cut;
    openvdb::GridBase::Ptr made;
    try {
        if (fromVector || law.vector)
            made = transformedAny<openvdb::Vec3SGrid>(*source.grid, maker, where, cut);
        else if (law.inDouble)
            made = transformedAny<openvdb::DoubleGrid>(*source.grid, maker, where, cut);
        else
            made = transformedAny<openvdb::FloatGrid>(*source.grid, maker, where, cut);
    } catch (const std::bad_alloc&) {
        throw MemoryError(where + ": '" + to + "' needs more memory than there is");
    }
    made->setName(to);
    made->setCreator("eikonal");
    if (const Entry* old = mImpl->replaced(to, fromVector || law.vector ? 3 : 1))
        inherit(*made, *old->grid);
    if (fromVector || law.vector) made->setVectorType(openvdb::VEC_INVARIANT);
    if (isLevelSet(to)) made->setGridClass(openvdb::GRID_LEVEL_SET);
    mImpl->place(made);
    return cut;
}

} // namespace eikonal::volume
