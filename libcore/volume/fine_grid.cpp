// Grids of fine voxels: a whole number of them lies along an edge of a scene's voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/fine_grid.h"

#include "base/error.h"
#include "volume/contract.h"
#include "volume/entries.h"
#include "volume/vdb_frame.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace eikonal::volume {

namespace {

using glm::ivec3;
using openvdb::Vec3SGrid;

constexpr int kMostDetail = 64; // beyond any that is worth its memory

/// The frame of the fine voxels that fill those of `frame`.
Frame fineFrame(const Frame& frame, int detail) {
    const double edge = 1.0 / detail;
    Frame fine;
    fine.voxelSize = frame.voxelSize * edge;
    fine.worldFromIndex = frame.worldFromIndex *
                          glm::translate(glm::dmat4(1), glm::dvec3(0.5 * edge - 0.5)) *
                          glm::scale(glm::dmat4(1), glm::dvec3(edge));
    return fine;
}

template<typename GridT> void read(const openvdb::GridBase& grid, const ivec3& low, FineGrid& out) {
    for (auto it = static_cast<const GridT&>(grid).cbeginValueOn(); it; ++it) {
        const auto& value = *it;
        // Tiles are many voxels at once.
        openvdb::CoordBBox box;
        it.getBoundingBox(box);
        for (auto at = box.begin(); at != box.end(); ++at) {
            out.voxels.push_back(fromCoord(*at) - low);
            out.values.emplace_back(value.x(), value.y(), value.z());
        }
    }
}

} // namespace

FineGrid Volume::fine(const std::string& grid, const IndexBox& box) const {
    FineGrid out;
    Entry* entry = mImpl->find(grid);
    if (!entry) return out;
    const std::string where = mImpl->where(grid);
    if (entry->type != GridType::vector)
        throw DataError(where + " holds " + entry->valueType + ", expected vec3s");
    mImpl->requireHead(*entry);
    const Frame found = toFrame(entry->grid->transform(), where);
    const double ratio = mImpl->frame.voxelSize / found.voxelSize;
    const int detail = static_cast<int>(std::lround(std::min(std::max(ratio, 1.0), 1e6)));
    if (detail > kMostDetail || !nearlyEqual(found, fineFrame(mImpl->frame, detail)))
        throw DataError(where + " does not subdivide the scene's voxels, expected 1 to " +
                        std::to_string(kMostDetail) + " of its own along an edge of one");
    mImpl->requireTree(*entry);
    out.detail = detail;
    try {
        if (entry->grid->isType<Vec3SGrid>())
            read<Vec3SGrid>(*entry->grid, detail * box.min, out);
        else
            read<openvdb::Vec3DGrid>(*entry->grid, detail * box.min, out);
    } catch (const std::bad_alloc&) {
        throw MemoryError(where + " needs more memory than there is");
    }
    for (const glm::vec3& value : out.values)
        for (int c = 0; c < 3; ++c)
            if (const auto wrong = fault(ruleFor(grid), value[c]))
                throw DataError(where + ": a value " + *wrong);
    return out;
}

void Volume::putFine(const std::string& grid, const IndexBox& box, const FineGrid& values) {
    const auto made = Vec3SGrid::create(openvdb::Vec3s(0));
    auto accessor = made->getAccessor();
    for (size_t i = 0; i < values.voxels.size(); ++i) {
        const ivec3 at = values.voxels[i] + values.detail * box.min;
        const glm::vec3 value = values.values[i];
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(value[c]))
                throw InternalError("grid '" + grid + "': a value is NaN");
        accessor.setValueOn({at.x, at.y, at.z}, {value.x, value.y, value.z});
    }
    made->setName(grid);
    made->setCreator("eikonal");
    made->setVectorType(openvdb::VEC_INVARIANT);
    const IndexBox domain = mImpl->domain;
    mImpl->place(made);
    mImpl->domain = domain;
    made->setTransform(toTransform(fineFrame(mImpl->frame, values.detail)));
}

} // namespace eikonal::volume
