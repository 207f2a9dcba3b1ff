// The files a scene is made of: the material of the first that has it, the light of all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/files.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::scene {

namespace {

bool sameFrame(const volume::Frame& a, const volume::Frame& b) {
    const double kTolerance = 1e-6; // [voxel]; as within one file
    const glm::dmat4 between = a.indexFromWorld() * b.worldFromIndex;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (std::abs(between[column][row] - (column == row ? 1.0 : 0.0)) > kTolerance)
                return false;
    return true;
}

} // namespace

Files::Files(std::vector<volume::Volume> volumes) : mOwn(std::move(volumes)) {
    for (const volume::Volume& volume : mOwn) mAll.push_back(&volume);
    for (const volume::Volume* volume : mAll) {
        if (!areOnOneTransform(first(), *volume))
            throw DataError(volume->path() + ": is on another transform than " + path());
        mDomain.include(volume->domain());
    }
    mFrame = first().frame();
}

Files::Files(const volume::Volume& volume)
    : mAll{&volume}, mDomain(volume.domain()), mFrame(volume.frame()) {}

void Files::place(const glm::dmat4& worldFromFile) {
    mMoved |= worldFromFile != glm::dmat4(1);
    mFrame.worldFromIndex = worldFromFile * mFrame.worldFromIndex;
    const double scale = glm::length(glm::dvec3(worldFromFile[0]));
    mFrame.voxelSize *= scale;
    mTurn = glm::dmat3(worldFromFile) / scale * mTurn;
}

bool areOnOneTransform(const volume::Volume& a, const volume::Volume& b) {
    return sameFrame(a.frame(), b.frame());
}

const volume::Volume* Files::withGrid(const std::string& grid) const {
    for (const volume::Volume* volume : mAll)
        if (volume->has(grid)) return volume;
    return nullptr;
}

std::string Files::foundNames() const {
    std::vector<std::string> names;
    for (const volume::Volume* volume : mAll)
        for (const volume::GridFacts& grid : volume->grids()) names.push_back(grid.name);
    return join(names, ", ");
}

const volume::Volume* Files::withObjects() const {
    for (const volume::Volume* volume : mAll)
        if (!volume->objects().empty()) return volume;
    return nullptr;
}

} // namespace eikonal::scene
