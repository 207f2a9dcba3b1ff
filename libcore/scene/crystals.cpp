// Objects that are uniaxial crystals: what of a scene's can be traced.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/crystals.h"

#include "base/error.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace eikonal::scene {

namespace {

bool isAsGlass(const Region& region) {
    return region.crystal->index == region.index.value.x &&
           region.crystal->dispersion == region.dispersion.value.x && !region.absorption.varies() &&
           region.absorptionExtraordinary.value == region.absorption.value;
}

void requireTraced(const Scene& scene, const Region& region, const Object& object) {
    const std::string is = scene.path + ": '" + region.name + "' is a crystal";
    if (region.opaque) throw DataError(is + " and opaque, expected one of the two");
    if (region.indexVaries() || region.coefficientsVary())
        throw DataError(is + " whose grids vary within it, expected one value of each");
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

void refuseCrystalGrids(const Files& files) {
    for (const volume::Volume* volume : files.all())
        for (const volume::GridFacts& grid : volume->grids()) {
            const std::string name = grid.name.substr(0, grid.name.find('.'));
            if (name == "axis" || name == "ior_extraordinary" || name == "absorption_extraordinary")
                throw DataError(volume->path() + ": has a grid '" + grid.name +
                                "', expected crystals by metadata of their level sets: those that "
                                "vary in space are not traced");
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
