// The objects of a scene with sharp boundaries: what bounds them, what is in them.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/objects.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

using glm::uint;
#include "shared/limits.h"

// Voxels this near a boundary are sampled by rays on its far side's account [voxel].
constexpr float kReach = 3;

/// Whether a voxel of the domain may be sampled on behalf of a region.
class Mask {
public:
    /// All of the domain.
    explicit Mask(ivec3 size) : mSize(size) {}
    /// Where the object is, and round it.
    Mask(ivec3 size, const Object& object) : mSize(size), mObject(&object) {}

    template<typename Visit> void forEach(const Visit& visit) const {
        const volume::IndexBox box = mObject ? mObject->box : volume::IndexBox{ivec3(0), mSize - 1};
        size_t i = 0;
        for (int z = box.min.z; z <= box.max.z; ++z)
            for (int y = box.min.y; y <= box.max.y; ++y)
                for (int x = box.min.x; x <= box.max.x; ++x, ++i)
                    if (!mObject || mObject->distance[i] < kReach)
                        visit((static_cast<size_t>(z) * mSize.y + y) * mSize.x + x);
    }

private:
    ivec3 mSize;
    const Object* mObject = nullptr;
};

Values collapsed(volume::DenseGrid grid, const Mask& mask, const vec3& fallback) {
    Values result;
    const auto components = static_cast<size_t>(grid.components);
    const auto valueAt = [&](size_t voxel) {
        const float* v = grid.values.data() + voxel * components;
        return components == 1 ? vec3(v[0]) : vec3(v[0], v[1], v[2]);
    };
    bool found = false, varies = false;
    mask.forEach([&](size_t voxel) {
        const vec3 value = valueAt(voxel);
        if (!found) result.value = value;
        varies = varies || value != result.value;
        found = true;
    });
    if (!found) result.value = fallback;
    if (varies) result.grid = std::move(grid);
    return result;
}

vec3 absentValue(const std::string& grid) {
    return vec3(grid == "ior" || grid == "reflectance" ? 1 : 0);
}

/// Reads grids for one region.
class Reader {
public:
    Reader(const volume::Volume& volume, const volume::IndexBox& box, const Mask& mask,
           std::string suffix, bool ownGrids)
        : mVolume(volume), mBox(box), mMask(mask), mSuffix(std::move(suffix)), mOwn(ownGrids) {}

    Values operator()(const std::string& grid) const {
        const std::string own = volume::ownGrid(grid, mSuffix);
        if (mSuffix == volume::kMedium && !mVolume.has(own))
            return {mVolume.background(grid, absentValue(grid)), {}};
        return mOwn ? read(own, absentValue(grid)) : read(grid, absentValue(grid));
    }

private:
    Values read(const std::string& grid, const vec3& absent) const {
        if (!mVolume.has(grid)) return {absent, {}};
        if (const auto value = mVolume.constant(grid)) return {*value, {}};
        return collapsed(mVolume.dense(grid, mBox), mMask, absent);
    }

    const volume::Volume& mVolume;
    const volume::IndexBox& mBox;
    const Mask& mMask;
    std::string mSuffix;
    bool mOwn;
};

Region readRegion(const std::string& name, const Mask& mask, const Reader& read) {
    Region region;
    region.name = name;
    region.index = read("ior");
    region.absorption = read("absorption");
    region.scattering = read("scattering");
    if (!region.scattering.isZero()) region.anisotropy = read("anisotropy");
    region.emission = read("emission");
    region.reflectance = read("reflectance");
    Values opacity = read("opacity");
    if (opacity.varies()) { // made elsewhere, with an edge of its own: most of the inside decides
        double sum = 0;
        std::int64_t voxels = 0;
        mask.forEach([&](size_t voxel) {
            sum += opacity.grid.values[voxel];
            ++voxels;
        });
        opacity.value = vec3(static_cast<float>(sum / static_cast<double>(voxels)));
    }
    region.opaque = opacity.value.x > 0.5f;
    if (region.opaque) region.albedo = read("albedo");
    return region;
}

/// The mean length of the gradient within two voxels of the boundary.
float slopeOf(const Object& object) {
    const ivec3 size = object.box.size();
    const auto at = [&](int x, int y, int z) {
        return object.distance[(static_cast<size_t>(z) * size.y + y) * size.x + x];
    };
    double sum = 0;
    std::int64_t count = 0;
    for (int z = 1; z + 1 < size.z; ++z)
        for (int y = 1; y + 1 < size.y; ++y)
            for (int x = 1; x + 1 < size.x; ++x) {
                if (std::abs(at(x, y, z)) > std::min(2.0f, object.band - 1.5f)) continue;
                sum += static_cast<double>(glm::length(vec3(at(x + 1, y, z) - at(x - 1, y, z),
                                                            at(x, y + 1, z) - at(x, y - 1, z),
                                                            at(x, y, z + 1) - at(x, y, z - 1)) *
                                                       0.5f));
                ++count;
            }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 1.0f;
}

Object readObject(const volume::Volume& volume, const std::string& sdf,
                  const volume::IndexBox& box) {
    const volume::DenseGrid dense = volume.dense(sdf, box);
    const auto h = static_cast<float>(volume.frame().voxelSize);
    Object object;
    for (float value : dense.values) object.band = std::max(object.band, std::abs(value) / h);
    // Within the band and inside: nothing else is ever looked up.
    const ivec3 size = dense.size;
    const float within = std::min(object.band, kKept) * h;
    volume::IndexBox& kept = object.box;
    kept = {size, ivec3(-1)};
    size_t i = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i)
                if (dense.values[i] < within) {
                    kept.min = glm::min(kept.min, ivec3(x, y, z));
                    kept.max = glm::max(kept.max, ivec3(x, y, z));
                }
    if (kept.empty()) kept = {ivec3(0), ivec3(0)}; // outside the domain: its first voxel will do
    object.distance.reserve(static_cast<size_t>(kept.voxels()));
    for (int z = kept.min.z; z <= kept.max.z; ++z)
        for (int y = kept.min.y; y <= kept.max.y; ++y)
            for (int x = kept.min.x; x <= kept.max.x; ++x)
                object.distance.push_back(
                    dense.values[(static_cast<size_t>(z) * size.y + y) * size.x + x] / h);
    object.slope = slopeOf(object);
    return object;
}

} // namespace

void readObjects(Scene& scene, const volume::Volume& volume) {
    const volume::IndexBox& box = scene.domain;
    const std::vector<volume::ObjectFacts> facts = volume.objects();
    if (facts.size() > static_cast<size_t>(kMostObjects))
        throw DataError(volume.path() + ": " + std::to_string(facts.size()) +
                        " objects with signed distances, expected at most " +
                        std::to_string(kMostObjects));
    for (const volume::ObjectFacts& object : facts) {
        scene.objects.push_back(readObject(volume, object.sdf, box));
        const Mask mask(box.size(), scene.objects.back());
        const bool own = !object.name.empty() && volume.has(volume::ownGrid("ior", object.name));
        scene.regions.push_back(
            readRegion(object.name, mask, Reader(volume, box, mask, object.name, own)));
    }
    const Mask everywhere(box.size());
    scene.regions.push_back(readRegion(volume::kMedium, everywhere,
                                       Reader(volume, box, everywhere, volume::kMedium, true)));
}

Values readValues(const volume::Volume& volume, const std::string& grid,
                  const volume::IndexBox& box) {
    const Mask everywhere(box.size());
    return Reader(volume, box, everywhere, "", false)(grid);
}

} // namespace eikonal::scene
