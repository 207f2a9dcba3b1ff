// Objects that are uniaxial crystals: what of a scene's can be traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/crystals.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace eikonal::scene {

namespace {

bool isAsGlass(const Region& region) {
    const bool alike =
        region.absorbsAlike || (region.coefficientPages() == 0 &&
                                region.absorptionExtraordinary.value == region.absorption.value);
    return region.crystal->index == region.index.value.x &&
           region.crystal->dispersion == region.dispersion.value.x && alike;
}

struct Indices {
    float ordinary, extraordinary;
};

/// Those that are furthest apart, of where rays may look. Throws DataError for an axis that is
/// none.
Indices furthestApart(const Scene& scene, const Region& region, const Object& object) {
    const float kLooked = 3; // beyond its boundary [voxel]
    Indices found{region.index.at(object.inside.min, 0), region.index.at(object.inside.min, 0)};
    for (int z = object.box.min.z; z <= object.box.max.z; ++z)
        for (int y = object.box.min.y; y <= object.box.max.y; ++y)
            for (int x = object.box.min.x; x <= object.box.max.x; ++x) {
                const glm::ivec3 voxel(x, y, z);
                if (!(object.distance.at(voxel) < kLooked)) continue;
                const glm::dvec3 axis(region.axis.at(voxel, 0), region.axis.at(voxel, 1),
                                      region.axis.at(voxel, 2));
                if (axis == glm::dvec3(0)) continue;
                if (!volume::isAxis(axis)) {
                    const glm::ivec3 place = voxel + scene.domain.min;
                    throw DataError(scene.path + ": grid 'axis' of '" + region.name + "': voxel (" +
                                    std::to_string(place.x) + ", " + std::to_string(place.y) +
                                    ", " + std::to_string(place.z) + ") has the length " +
                                    toText(static_cast<float>(glm::length(axis))) +
                                    ", expected 1 to a thousandth, or 0: none");
                }
                const Indices here{region.index.at(voxel, 0),
                                   region.indexExtraordinary.at(voxel, 0)};
                if (std::abs(here.extraordinary - here.ordinary) >
                    std::abs(found.extraordinary - found.ordinary))
                    found = here;
            }
    return found;
}

/// Sees to grids of the axis and the indices. Makes an isotropic medium of what is isotropic
/// everywhere.
void settleGrids(const Scene& scene, Region& region, const Object& object) {
    if (object.inside.empty()) return;
    const Indices indices = furthestApart(scene, region, object);
    if (region.axis.isZero()) {
        region.crystal.reset();
        region.absorptionExtraordinary = {};
        return;
    }
    region.crystal->index = indices.extraordinary;
    if (!region.axis.varies()) region.crystal->axis = glm::normalize(region.axis.value);
    if (!region.crystalVaries()) return;
    if (indices.extraordinary == indices.ordinary) {
        if (!region.absorbsAlike)
            throw DataError(scene.path + ": '" + region.name +
                            "' absorbs by its axis, which varies, expected an 'ior_extraordinary' "
                            "that is not 'ior' somewhere");
        region.axis = {};
        region.indexExtraordinary = region.index;
        region.crystal.reset();
        region.absorptionExtraordinary = {};
    }
    region.index.value = glm::vec3(indices.ordinary);
}

void requireTraced(const Scene& scene, const Region& region, const Object& object) {
    const std::string is = scene.path + ": '" + region.name + "' is a crystal";
    if (region.opaque) throw DataError(is + " and opaque, expected one of the two");
    if (region.dispersion.varies())
        throw DataError(is + " whose grid 'dispersion' varies within it, expected one value");
    const glm::ivec3 last = scene.size() - 1;
    if (!object.inside.empty() && (glm::any(glm::lessThanEqual(object.inside.min, glm::ivec3(0))) ||
                                   glm::any(glm::greaterThanEqual(object.inside.max, last))))
        throw DataError(is + " that comes to the domain's face, expected a voxel or more between");
}

} // namespace

void settleCrystals(Scene& scene) {
    for (size_t k = 0; k < scene.objects.size(); ++k) {
        Region& region = scene.regions[k];
        if (!region.crystal) continue;
        requireTraced(scene, region, scene.objects[k]);
        settleGrids(scene, region, scene.objects[k]);
        if (!region.crystal || region.crystalVaries()) continue;
        region.crystal->axis = glm::vec3(scene.turned * glm::dvec3(region.crystal->axis));
        if (!isAsGlass(region)) continue;
        region.crystal.reset();
        region.absorptionExtraordinary = {};
    }
    if (!scene.anyCrystal()) return;
    for (const Region& region : scene.regions)
        if (region.metal || region.roughness > 0)
            throw DataError(scene.path + ": '" + region.name + "' is " +
                            (region.metal ? "metal" : "rough") +
                            " beside crystals, which are traced with smooth transparent or matt "
                            "objects alone");
}

void refuseBlurredCrystals(const volume::Volume& volume) {
    for (const volume::ObjectFacts& object : volume.objects())
        if (object.crystal)
            throw DataError(volume.path() + ": '" + object.name +
                            "' is a crystal, expected --boundary sharp");
}

void refuseStrayCrystalGrids(const Files& files, bool sharp) {
    for (const volume::Volume* volume : files.all()) {
        const std::vector<volume::ObjectFacts> objects = volume->objects();
        for (const volume::GridFacts& grid : volume->grids()) {
            const size_t dot = grid.name.find('.');
            const std::string name = grid.name.substr(0, dot);
            if (name != "axis" && name != "ior_extraordinary" && name != "absorption_extraordinary")
                continue;
            const std::string has = volume->path() + ": has a grid '" + grid.name + "', expected ";
            if (!sharp)
                throw DataError(has + "it within level sets alone (sdf): crystals are traced by "
                                      "--boundary sharp");
            // As readRegion() takes them: those of an object's own where its index is its own.
            const bool isSomeones =
                std::any_of(objects.begin(), objects.end(), [&](const volume::ObjectFacts& object) {
                    const bool own =
                        !object.name.empty() && volume->has(volume::ownGrid("ior", object.name));
                    return dot == std::string::npos
                               ? !own
                               : own && grid.name.substr(dot + 1) == object.name;
                });
            if (!isSomeones)
                throw DataError(has + (dot == std::string::npos
                                           ? "'" + name + ".NAME', an object's own as its index is"
                                           : "one named as an object that has a grid 'ior.NAME'"));
        }
    }
}

bool anyCrystalDisperses(const Scene& scene) {
    return std::any_of(scene.regions.begin(), scene.regions.end(), [](const Region& region) {
        return region.crystal && region.crystal->dispersion != 0;
    });
}

const Region* crystalAt(const Scene& scene, const glm::dvec3& place) {
    const glm::dvec3 at(scene.voxelFromWorld() * glm::dvec4(place, 1));
    const glm::ivec3 voxel(glm::floor(at + 0.5));
    if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) ||
        glm::any(glm::greaterThanEqual(voxel, scene.size())))
        return nullptr;
    for (size_t k = 0; k < scene.objects.size(); ++k)
        if (scene.objects[k].distance.at(voxel) < 0)
            return scene.regions[k].crystal ? &scene.regions[k] : nullptr;
    return nullptr;
}

} // namespace eikonal::scene
