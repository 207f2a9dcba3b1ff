// The refractive index over the domain, where it varies.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/index.h"

#include "base/error.h"
#include "scene/shared.h"
#include "volume/make_bricks.h"

#include <algorithm>
#include <cmath>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

// Look-ups on one object's behalf reach this far beyond its boundary: a step and a spline [voxel].
constexpr float kLookUps = 4;

/// Objects whose index varies, of sharp boundaries.
class Varying {
public:
    explicit Varying(const Scene& scene) : mScene(scene) {
        for (size_t k = 0; k < scene.objects.size(); ++k)
            if (scene.regions[k].indexVaries() && !scene.regions[k].crystal) mObjects.push_back(k);
    }

    bool any() const { return !mObjects.empty(); }

    bool isEven(size_t brick) const {
        return std::all_of(mObjects.begin(), mObjects.end(), [&](size_t k) {
            const bool near = mObjects.size() > 1 && mScene.objects[k].distance.page[brick] >= 0;
            return !near && mScene.regions[k].indexIsEven(brick);
        });
    }

    /// At a term of Cauchy's law, of the object that the voxel is nearest to. Throws DataError
    /// where two are within kLookUps.
    float at(const ivec3& voxel, float term) const {
        size_t nearest = mObjects.front();
        float least = 1e9f;
        for (const size_t k : mObjects) {
            const float distance = mScene.objects[k].distance.at(voxel);
            if (std::max(distance, least) < kLookUps)
                throw DataError(mScene.path + ": the index varies in '" + mScene.regions[k].name +
                                "' and in another object less than " +
                                std::to_string(static_cast<int>(2 * kLookUps)) +
                                " voxels off, expected one of them, or more room");
            if (distance >= least) continue;
            least = distance;
            nearest = k;
        }
        return mScene.regions[nearest].indexAt(voxel, term);
    }

    /// Takes up the range of what is looked up.
    void widen(Index& index, float term) const {
        for (const size_t k : mObjects) {
            const Object& object = mScene.objects[k];
            for (int z = object.box.min.z; z <= object.box.max.z; ++z)
                for (int y = object.box.min.y; y <= object.box.max.y; ++y)
                    for (int x = object.box.min.x; x <= object.box.max.x; ++x) {
                        if (object.distance.at({x, y, z}) > kLookUps) continue;
                        const float n = mScene.regions[k].indexAt({x, y, z}, term);
                        index.least = std::min(index.least, n);
                        index.most = std::max(index.most, n);
                    }
        }
    }

private:
    const Scene& mScene;
    std::vector<size_t> mObjects;
};

/// What an index ranges over.
struct Range {
    float least, most;
};

Range rangeOf(const volume::BrickGrid& grid) {
    Range range{grid.at(ivec3(0)), grid.at(ivec3(0))};
    for (size_t brick = 0; brick < grid.page.size(); ++brick)
        grid.forEachValue(brick, [&](const float* n) {
            range.least = std::min(range.least, *n);
            range.most = std::max(range.most, *n);
        });
    return range;
}

void widen(Index& index, const Range& range) {
    index.least = std::min(index.least, range.least);
    index.most = std::max(index.most, range.most);
}

/// A region's index over the domain at a term of Cauchy's law.
volume::BrickGrid gridOf(const Scene& scene, const Region& region, float term) {
    return volume::makeBricks(
        scene.size(), scene.domain.firstBrick(), 1,
        [&](size_t brick) { return region.indexIsEven(brick); },
        [&](const ivec3& voxel, float* n) { *n = region.indexAt(voxel, term); });
}

} // namespace

Index varyingIndex(const Scene& scene) {
    Index index;
    const Region& medium = scene.medium();
    index.background = medium.index.value.x;
    index.backgroundDispersion = medium.dispersion.value.x;
    index.least = index.most = index.background;
    const Varying objects(scene);
    const auto gridAt = [&](float term) {
        objects.widen(index, term);
        return volume::makeBricks(
            scene.size(), scene.domain.firstBrick(), 1,
            [&](size_t brick) { return objects.isEven(brick); },
            [&](const ivec3& voxel, float* n) { *n = objects.at(voxel, term); });
    };
    if (objects.any()) {
        index.grid = gridAt(0);
        if (scene.disperses) index.dispersed = gridAt(kDispersedTerm);
    }
    if (!medium.indexVaries()) return index;
    if (objects.any())
        throw DataError(scene.path +
                        ": the index varies in an object and in what surrounds it, expected "
                        "it to vary on one side of sharp boundaries");
    index.grid = medium.index.varies() ? medium.index.grid : gridOf(scene, medium, 0);
    widen(index, rangeOf(index.grid));
    if (!scene.disperses) return index;
    index.dispersed = gridOf(scene, medium, kDispersedTerm);
    widen(index, rangeOf(index.dispersed));
    return index;
}

Index blurredIndex(const volume::Volume& volume, const volume::IndexBox& box) {
    Index index;
    index.background = volume.background("ior", vec3(1)).x;
    index.least = index.most = index.background;
    if (!volume.has("ior")) return index;
    index.grid = volume.bricks("ior", box);
    const Range floats = rangeOf(index.grid);
    index.rest = volume.remainders("ior", box);
    if (floats.least == floats.most && !index.rest.page.empty()) {
        const Range rests = rangeOf(index.rest);
        if (rests.least == rests.most) index.rest = {};
    }
    index.inHalf = volume.isStoredInHalf("ior");
    index.least = index.most = index.grid.at(ivec3(0));
    widen(index, floats);
    const ivec3 size = index.grid.size;
    const auto look = [&](int x, int y, int z) {
        const float jump = std::abs(index.grid.at({x, y, z}) - index.background);
        index.jumpAtFaces = std::max(index.jumpAtFaces, jump);
    };
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y) {
            const bool face = z == 0 || z == size.z - 1 || y == 0 || y == size.y - 1;
            for (int x = 0; x < size.x; x += face ? 1 : std::max(size.x - 1, 1)) look(x, y, z);
        }
    return index;
}

void disperse(Index& index, const Values& dispersion, const volume::IndexBox& box) {
    const auto isEven = [&](size_t brick) {
        return (index.grid.page.empty() || index.grid.page[brick] < 0) && dispersion.isEven(brick);
    };
    const auto gridAt = [&](float term) {
        return volume::makeBricks(
            box.size(), box.firstBrick(), 1, isEven, [&](const ivec3& voxel, float* n) {
                *n = index.grid.page.empty() ? index.background : index.grid.at(voxel);
                *n += term * dispersion.at(voxel, 0);
            });
    };
    volume::BrickGrid dispersed = gridAt(kDispersedTerm);
    // What that sum lacks, of an index in double.
    const auto restOf = [&](const ivec3& voxel, float* rest) {
        const double sum =
            static_cast<double>(index.grid.at(voxel)) + static_cast<double>(index.rest.at(voxel)) +
            static_cast<double>(kDispersedTerm) * static_cast<double>(dispersion.at(voxel, 0));
        *rest = static_cast<float>(sum - static_cast<double>(dispersed.at(voxel)));
    };
    const Range range = rangeOf(dispersed);
    if (!index.varies() && range.least == range.most) return; // straight, whatever the wavelength
    widen(index, range);
    if (!index.rest.page.empty())
        index.dispersedRest = volume::makeBricks(box.size(), box.firstBrick(), 1, isEven, restOf);
    index.dispersed = std::move(dispersed);
    if (index.grid.page.empty()) index.grid = gridAt(0);
}

} // namespace eikonal::scene
