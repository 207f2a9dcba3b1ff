// The volumes a picture is made of: the material of the first, the light of all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/scene.h"

#include "base/error.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::view {

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

Scene::Scene(std::vector<volume::Volume> volumes) : mVolumes(std::move(volumes)) {
    for (const volume::Volume& volume : mVolumes) {
        if (!sameFrame(frame(), volume.frame()))
            throw DataError(volume.path() + ": is on another transform than " + path());
        mDomain.include(volume.domain());
    }
}

const volume::Volume* Scene::holder(const std::string& grid) const {
    for (const volume::Volume& volume : mVolumes)
        if (volume.has(grid)) return &volume;
    return nullptr;
}

bool Scene::has(const std::string& grid) const {
    return holder(grid) != nullptr;
}

medium::Coefficient Scene::coefficient(const std::string& grid) const {
    const volume::Volume* volume = holder(grid);
    return volume ? medium::readCoefficient(*volume, grid, mDomain) : medium::Coefficient{};
}

medium::Index Scene::index() const {
    const volume::Volume* volume = holder("ior");
    return medium::readIndex(volume ? *volume : mVolumes.front(), mDomain);
}

const volume::Volume* Scene::objectsHolder() const {
    for (const volume::Volume& volume : mVolumes)
        if (!volume.objects().empty()) return &volume;
    return nullptr;
}

medium::Objects Scene::objects() const {
    const volume::Volume* volume = objectsHolder();
    if (!volume) mVolumes.front().require("sdf");
    return medium::readObjects(*volume, mDomain);
}

medium::Coefficient Scene::fluence() const {
    medium::Coefficient sum;
    for (const volume::Volume& volume : mVolumes) {
        medium::Coefficient part = medium::readCoefficient(volume, "fluence", mDomain);
        if (!part.present) continue;
        if (!sum.present) {
            sum = std::move(part);
            continue;
        }
        sum.grey = sum.grey && part.grey;
        for (size_t i = 0; i < sum.grid.values.size(); ++i)
            sum.grid.values[i] += part.grid.values[i];
    }
    return sum;
}

medium::Coefficient Scene::lightDirection() const {
    if (mVolumes.size() == 1)
        return medium::readCoefficient(mVolumes.front(), "light_direction", mDomain);
    medium::Coefficient mean;
    std::vector<float> power;
    for (const volume::Volume& volume : mVolumes) {
        const auto part = medium::readCoefficient(volume, "light_direction", mDomain);
        const auto weight = medium::readCoefficient(volume, "fluence", mDomain);
        if (!part.present || !weight.present) continue;
        if (!mean.present) {
            mean = part;
            std::fill(mean.grid.values.begin(), mean.grid.values.end(), 0.0f);
            power.assign(mean.grid.voxels(), 0.0f);
        }
        for (size_t i = 0; i < power.size(); ++i) {
            const float p = weight.at(i, 0) + weight.at(i, 1) + weight.at(i, 2);
            power[i] += p;
            for (size_t c = 0; c < 3; ++c)
                mean.grid.values[3 * i + c] += p * part.grid.values[3 * i + c];
        }
    }
    for (size_t i = 0; i < power.size(); ++i)
        for (size_t c = 0; c < 3 && power[i] > 0; ++c) mean.grid.values[3 * i + c] /= power[i];
    return mean;
}

} // namespace eikonal::view
