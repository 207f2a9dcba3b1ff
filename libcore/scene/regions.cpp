// What a point of a scene is made of: an object's medium, or what surrounds them all.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/regions.h"

#include "base/error.h"
#include "scene/shared.h"

#include <algorithm>
#include <optional>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

// Voxels this near a boundary are sampled by rays on its far side's account [voxel].
constexpr float kReach = 3;

vec3 valueAt(const volume::BrickGrid& grid, const ivec3& voxel) {
    return grid.components == 1 ? vec3(grid.at(voxel))
                                : vec3(grid.at(voxel, 0), grid.at(voxel, 1), grid.at(voxel, 2));
}

/// The values of a grid that may be sampled on behalf of an object's region, where it is and round
/// it; all of the domain's if there is none. `visit(value, voxels)`, once where many are the same.
template<typename Visit>
void forEachSampled(const volume::BrickGrid& grid, const Object* object, const Visit& visit) {
    const volume::IndexBox box = object ? object->box : volume::IndexBox{ivec3(0), grid.size - 1};
    const auto isSampled = [&](const ivec3& voxel) {
        return !object || object->distance.at(voxel) < kReach;
    };
    for (size_t brick = 0; brick < grid.page.size(); ++brick) {
        const ivec3 corner = grid.voxelOf(brick);
        const ivec3 low = glm::max(corner, box.min);
        const ivec3 high = glm::min(corner + volume::kBrick - 1, box.max);
        const volume::IndexBox part{low, high};
        if (part.empty()) continue;
        if (grid.page[brick] < 0 && (!object || object->distance.page[brick] < 0)) {
            if (isSampled(low)) visit(valueAt(grid, low), part.voxels());
            continue;
        }
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    if (isSampled({x, y, z})) visit(valueAt(grid, {x, y, z}), 1);
    }
}

Values collapsed(volume::BrickGrid grid, const Object* object, const vec3& fallback) {
    Values result;
    bool found = false, varies = false;
    forEachSampled(grid, object, [&](const vec3& value, std::int64_t) {
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
    Reader(const volume::Volume& volume, const volume::IndexBox& box, const Object* object,
           std::string suffix, bool ownGrids)
        : mVolume(volume), mBox(box), mObject(object), mSuffix(std::move(suffix)), mOwn(ownGrids) {}

    /// The values of a grid if it is there.
    std::optional<Values> given(const std::string& grid) const {
        const std::string name = mOwn ? volume::ownGrid(grid, mSuffix) : grid;
        return mVolume.has(name) ? std::optional(read(name, absentValue(grid))) : std::nullopt;
    }
    const std::string& path() const { return mVolume.path(); }

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
        return collapsed(mVolume.bricks(grid, mBox), mObject, absent);
    }

    const volume::Volume& mVolume;
    const volume::IndexBox& mBox;
    const Object* mObject;
    std::string mSuffix;
    bool mOwn;
};

/// Of an object's voxels, or of all where there is none.
float meanWithin(const volume::BrickGrid& grid, const Object* object) {
    const glm::ivec3 low = object ? object->inside.min : glm::ivec3(0);
    const glm::ivec3 high = object ? object->inside.max : grid.size - 1;
    double sum = 0;
    std::int64_t voxels = 0;
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                if (object && object->distance.at({x, y, z}) >= 0) continue;
                sum += static_cast<double>(grid.at({x, y, z}));
                ++voxels;
            }
    return voxels > 0 ? static_cast<float>(sum / static_cast<double>(voxels)) : 0;
}

Region readAll(const std::string& name, const Object* object, const Reader& read) {
    Region region;
    region.name = name;
    region.index = read("ior");
    region.dispersion = read("dispersion");
    region.absorption = read("absorption");
    region.scattering = read("scattering");
    if (!region.scattering.isZero()) region.anisotropy = read("anisotropy");
    region.emission = read("emission");
    region.reflectance = read("reflectance");
    Values opacity = read("opacity");
    if (opacity.varies()) { // made elsewhere, with an edge of its own: most of the inside decides
        opacity.value = vec3(meanWithin(opacity.grid, object));
    }
    region.opaque = opacity.value.x > 0.5f;
    if (region.opaque) region.albedo = read("albedo");
    return region;
}

/// Its crystal, by grids or by its level set's metadata.
void readCrystal(Region& region, const volume::ObjectFacts& facts, const Reader& read) {
    region.crystal = facts.crystal;
    const auto axis = read.given("axis"), index = read.given("ior_extraordinary"),
               absorption = read.given("absorption_extraordinary");
    if (!facts.crystal) {
        if (!axis && !index && !absorption) return;
        const auto requireWith = [&](const char* missing, bool found) {
            const std::string there = axis    ? "axis"
                                      : index ? "ior_extraordinary"
                                              : "absorption_extraordinary";
            if (!found)
                throw DataError(read.path() + ": '" + region.name + "' has a grid '" + there +
                                "' and none of '" + missing + "', expected both, of one crystal");
        };
        requireWith("axis", axis.has_value());
        requireWith("ior_extraordinary", index.has_value());
        region.crystal = volume::Crystal{1, region.dispersion.value.x, {}, {}};
    }
    region.absorbsAlike = !absorption && !facts.crystal;
    region.axis = axis ? *axis : Values{facts.crystal->axis, {}};
    region.indexExtraordinary = index ? *index : Values{vec3(facts.crystal->index), {}};
    region.absorptionExtraordinary = absorption            ? *absorption
                                     : region.absorbsAlike ? region.absorption
                                                           : Values{facts.crystal->absorption, {}};
}

} // namespace

bool Values::grey() const {
    if (!varies()) return value.x == value.y && value.y == value.z;
    bool grey = true;
    for (size_t brick = 0; grid.components == 3 && grey && brick < grid.page.size(); ++brick)
        grid.forEachValue(brick, [&](const float* v) { grey &= v[0] == v[1] && v[0] == v[2]; });
    return grey;
}

float Values::most(int component) const {
    if (!varies()) return value[component];
    float most = at(ivec3(0), component);
    for (size_t brick = 0; brick < grid.page.size(); ++brick)
        grid.forEachValue(brick, [&](const float* v) {
            most = std::max(most, v[grid.components == 1 ? 0 : component]);
        });
    return most;
}

float Region::indexAt(const glm::ivec3& voxel, float term) const {
    return index.at(voxel, 0) + term * dispersion.at(voxel, 0);
}

int Region::coefficientPages() const {
    const bool along = absorptionExtraordinary.varies() && !absorbsAlike;
    const bool plain =
        absorption.varies() || scattering.varies() || anisotropy.varies() || emission.varies();
    return (plain || along ? 1 : 0) + (along ? 1 : 0);
}

bool Region::crystalVaries() const {
    return crystal && (axis.varies() || indexExtraordinary.varies() || index.varies());
}

Values readValues(const volume::Volume& volume, const std::string& grid,
                  const volume::IndexBox& box) {
    return Reader(volume, box, nullptr, "", false)(grid);
}

Region readRegion(const volume::Volume& volume, const volume::ObjectFacts& facts,
                  const volume::IndexBox& box, const Object* object, bool own) {
    Region region = readAll(facts.name, object, Reader(volume, box, object, facts.name, own));
    region.priority = facts.priority;
    region.roughness = facts.roughness;
    region.metal = facts.metal;
    region.opaque = region.opaque || region.metal;
    if (object) readCrystal(region, facts, Reader(volume, box, object, facts.name, own));
    return region;
}

RegionParams paramsOf(const Region& region, float voxelSize, const glm::dmat3& turn, int page,
                      int texels) {
    const int pages = region.coefficientPages();
    RegionParams params{};
    params.index = vec4(region.index.value.x, region.indexVaries() && !region.crystal,
                        region.opaque, region.dispersion.value.x);
    params.absorption =
        vec4(region.absorption.value * voxelSize, pages > 0 ? static_cast<float>(page) : -1);
    params.scattering = vec4(region.scattering.value * voxelSize, region.anisotropy.value.x);
    const float along = pages > 1 ? static_cast<float>(page + texels) : -1;
    params.emission = vec4(region.emission.value * voxelSize,
                           region.absorbsAlike && region.absorption.varies() ? kAsOrdinary : along);
    const bool varies = region.crystalVaries();
    params.albedo = vec4(region.albedo.value, !varies ? 0 : region.index.varies() ? 2 : 1);
    params.reflectance = vec4(region.reflectance.value, region.roughness);
    if (region.crystal) {
        const volume::Crystal& crystal = *region.crystal;
        params.axis = vec4(vec3(glm::dvec3(crystal.axis) * turn), crystal.index);
        params.extraordinary =
            vec4(region.absorptionExtraordinary.value * voxelSize, crystal.dispersion);
    }
    if (!region.metal) return params;
    params.metalIndex = vec4(region.metal->index, 1);
    params.metalExtinction = vec4(region.metal->extinction, 0);
    return params;
}

} // namespace eikonal::scene
