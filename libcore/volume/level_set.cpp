// Signed distances to closed surfaces as an OpenVDB grid.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/level_set.h"

#include <cmath>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

openvdb::FloatGrid::Ptr makeLevelSet(const glm::dmat4& indexFromWorld,
                                     const std::vector<glm::dvec3>& points,
                                     const std::vector<Shells>& shells, double halfWidth) {
    // Index-space points in double, then float: a mesh far from the world's origin keeps its shape.
    std::vector<openvdb::Vec3s> vdbPoints;
    vdbPoints.reserve(points.size());
    for (const glm::dvec3& point : points) {
        const glm::dvec3 p(indexFromWorld * glm::dvec4(point, 1.0));
        vdbPoints.emplace_back(openvdb::Vec3d(p.x, p.y, p.z));
    }
    const auto unit = openvdb::math::Transform::createLinearTransform(1.0);
    openvdb::FloatGrid::Ptr solid;
    for (const Shells& some : shells) {
        std::vector<openvdb::Vec3I> triangles;
        triangles.reserve(some.triangles.size());
        for (const glm::uvec3& t : some.triangles) triangles.emplace_back(t.x, t.y, t.z);
        // OpenVDB calls inside whatever it can't reach from without, cavities too: hence apart.
        auto made = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
            *unit, vdbPoints, triangles, static_cast<float>(halfWidth));
        if (!solid)
            solid = made;
        else if (some.cavity)
            openvdb::tools::csgDifference(*solid, *made);
        else
            openvdb::tools::csgUnion(*solid, *made);
    }
    return solid;
}

openvdb::FloatGrid::Ptr makeLevelSet(const IndexBox& box, const DenseGrid& values,
                                     float halfWidth) {
    auto grid = openvdb::FloatGrid::create(halfWidth);
    const openvdb::CoordBBox where(openvdb::Coord(box.min.x, box.min.y, box.min.z),
                                   openvdb::Coord(box.max.x, box.max.y, box.max.z));
    const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
        where, const_cast<float*>(values.values.data()));
    openvdb::tools::copyFromDense(dense, *grid, 0.0f);
    auto tile = grid->beginValueOn();
    tile.setMaxDepth(openvdb::FloatTree::ValueOnIter::LEAF_DEPTH - 1);
    for (; tile; ++tile)
        if (!(std::abs(*tile) < halfWidth)) {
            tile.setValue(*tile < 0 ? -halfWidth : halfWidth);
            tile.setActiveState(false);
        }
    std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
    grid->tree().getNodes(leaves);
    tbb::parallel_for(size_t{0}, leaves.size(), [&](size_t i) {
        for (auto voxel = leaves[i]->beginValueAll(); voxel; ++voxel) {
            const float value = *voxel;
            if (std::abs(value) < halfWidth)
                voxel.setValueOn();
            else
                leaves[i]->setValueOff(voxel.pos(), value < 0 ? -halfWidth : halfWidth);
        }
    });
    openvdb::tools::pruneLevelSet(grid->tree());
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
}

} // namespace eikonal::volume
