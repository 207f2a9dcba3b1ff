// What a point of a scene is made of: an object's medium, or what surrounds them all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/regions.h"

#include "scene/shared.h"

#include <algorithm>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

// Voxels this near a boundary are sampled by rays on its far side's account [voxel].
constexpr float kReach = 3;

/// Whether a voxel of the domain may be sampled on behalf of a region.
class Mask {
public:
    /// Where an object is, and round it; all of the domain if there is none.
    Mask(ivec3 size, const Object* object) : mSize(size), mObject(object) {}

    template<typename Visit> void forEach(const Visit& visit) const {
        const volume::IndexBox box = mObject ? mObject->box : volume::IndexBox{ivec3(0), mSize - 1};
        for (int z = box.min.z; z <= box.max.z; ++z)
            for (int y = box.min.y; y <= box.max.y; ++y)
                for (int x = box.min.x; x <= box.max.x; ++x)
                    if (!mObject || mObject->distance.at({x, y, z}) < kReach)
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

Region readAll(const std::string& name, const Mask& mask, const Reader& read) {
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

} // namespace

bool Values::grey() const {
    if (!varies()) return value.x == value.y && value.y == value.z;
    for (size_t i = 0; grid.components == 3 && i < grid.values.size(); i += 3)
        if (grid.values[i] != grid.values[i + 1] || grid.values[i] != grid.values[i + 2])
            return false;
    return true;
}

float Values::at(size_t voxel, int component) const {
    if (!varies()) return value[component];
    return grid.components == 1 ? grid.values[voxel]
                                : grid.values[3 * voxel + static_cast<size_t>(component)];
}

float Values::most(int component) const {
    if (!varies()) return value[component];
    float most = at(0, component);
    for (size_t i = 0; i < grid.voxels(); ++i) most = std::max(most, at(i, component));
    return most;
}

bool Region::coefficientsVary() const {
    return absorption.varies() || scattering.varies() || anisotropy.varies() || emission.varies();
}

Values readValues(const volume::Volume& volume, const std::string& grid,
                  const volume::IndexBox& box) {
    return Reader(volume, box, Mask(box.size(), nullptr), "", false)(grid);
}

Region readRegion(const volume::Volume& volume, const std::string& name,
                  const volume::IndexBox& box, const Object* object, bool own) {
    const Mask mask(box.size(), object);
    return readAll(name, mask, Reader(volume, box, mask, name, own));
}

RegionParams paramsOf(const Region& region, float voxelSize, float page) {
    RegionParams params{};
    params.index = vec4(region.index.value.x, region.index.varies(), region.opaque, 0);
    params.absorption = vec4(region.absorption.value * voxelSize, page);
    params.scattering = vec4(region.scattering.value * voxelSize, region.anisotropy.value.x);
    params.emission = vec4(region.emission.value * voxelSize, 0);
    params.albedo = vec4(region.albedo.value, 0);
    params.reflectance = vec4(region.reflectance.value, 0);
    return params;
}

} // namespace eikonal::scene
