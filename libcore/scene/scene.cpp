// A scene volume on the host: where it lies, what bounds its objects, what is in them, its light.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/crystals.h"
#include "scene/index.h"
#include "scene/shared.h"
#include "volume/make_bricks.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <limits>

namespace eikonal::scene {

using glm::ivec3;
using glm::vec3;

namespace {

Values readFirst(const Files& files, const std::string& grid) {
    const volume::Volume* volume = files.withGrid(grid);
    return readValues(volume ? *volume : files.first(), grid, files.domain());
}

/// What each file holds.
std::vector<Values> readOfAll(const Files& files, const std::string& grid) {
    std::vector<Values> all;
    for (const volume::Volume* volume : files.all())
        all.push_back(readValues(*volume, grid, files.domain()));
    return all;
}

/// [W/m²], the sum of all files.
Values readFluence(const Files& files) {
    std::vector<Values> parts = readOfAll(files, "fluence");
    if (parts.size() == 1) return std::move(parts.front());
    Values sum;
    bool varies = false;
    for (const Values& part : parts) {
        sum.value += part.value;
        varies |= part.varies();
    }
    if (!varies) return sum;
    const auto isEven = [&](size_t brick) {
        return std::all_of(parts.begin(), parts.end(),
                           [=](const Values& part) { return part.isEven(brick); });
    };
    sum.grid = volume::makeBricks(files.domain().size(), files.domain().firstBrick(), 3, isEven,
                                  [&](const glm::ivec3& voxel, float* out) {
                                      std::fill_n(out, 3, 0.0f);
                                      for (const Values& part : parts)
                                          for (int c = 0; c < 3; ++c) out[c] += part.at(voxel, c);
                                  });
    return sum;
}

/// World space, weighted by the files' fluence.
Values readDirection(const Files& files) {
    std::vector<Values> parts = readOfAll(files, "light_direction");
    if (parts.size() == 1) return std::move(parts.front());
    const std::vector<Values> weights = readOfAll(files, "fluence");
    Values mean;
    if (std::all_of(parts.begin(), parts.end(), [](const Values& v) { return v.isZero(); }))
        return mean;
    const auto isEven = [&](size_t brick) {
        bool even = true;
        for (size_t f = 0; f < parts.size(); ++f)
            even &= parts[f].isEven(brick) && weights[f].isEven(brick);
        return even;
    };
    mean.grid = volume::makeBricks(
        files.domain().size(), files.domain().firstBrick(), 3, isEven,
        [&](const glm::ivec3& voxel, float* out) {
            float power = 0;
            std::fill_n(out, 3, 0.0f);
            for (size_t f = 0; f < parts.size(); ++f) {
                if (parts[f].isZero()) continue;
                const Values& weight = weights[f];
                const float p = weight.at(voxel, 0) + weight.at(voxel, 1) + weight.at(voxel, 2);
                power += p;
                for (int c = 0; c < 3; ++c) out[c] += p * parts[f].at(voxel, c);
            }
            for (int c = 0; c < 3 && power > 0; ++c) out[c] /= power;
        });
    return mean;
}

void readObjects(Scene& scene, const volume::Volume& volume) {
    const std::vector<volume::ObjectFacts> facts = volume.objects();
    if (facts.size() > static_cast<size_t>(kMostObjects))
        throw DataError(volume.path() + ": " + std::to_string(facts.size()) +
                        " objects with signed distances, expected at most " +
                        std::to_string(kMostObjects));
    for (const volume::ObjectFacts& object : facts) {
        const bool own = !object.name.empty() && volume.has(volume::ownGrid("ior", object.name));
        scene.objects.push_back(readObject(volume, object.sdf, scene.domain));
        scene.regions.push_back(
            readRegion(volume, object, scene.domain, &scene.objects.back(), own));
    }
    scene.regions.push_back(readRegion(volume, {volume::kMedium, ""}, scene.domain, nullptr, true));
}

/// Whether rays of some wavelengths go other ways than those of 587.6 nm: what disperses refracts.
bool disperses(const Scene& scene) {
    const Region& medium = scene.medium();
    const bool any = scene.anyHas(&Region::dispersion) || anyCrystalDisperses(scene);
    return any &&
           std::any_of(scene.regions.begin(), scene.regions.end(), [&](const Region& region) {
               return region.crystal || region.indexVaries() ||
                      region.index.value != medium.index.value ||
                      region.dispersion.value != medium.dispersion.value;
           });
}

/// Throws DataError where Cauchy's law leaves no index above 0.
void requireIndex(const Scene& scene, const optics::Wavelengths& wavelengths) {
    const auto require = [&](float n, float at4, double nanometres, const std::string& where) {
        const double share = optics::cauchyTerm(nanometres) / static_cast<double>(kDispersedTerm);
        const double found = static_cast<double>(n) + share * static_cast<double>(at4 - n);
        if (!(found > 0))
            throw DataError(scene.path + ": by grid 'dispersion' the index" + where + " is " +
                            toText(found) + " at " + toText(nanometres) +
                            " nm, expected above 0 (in µm², as Cauchy's B is)");
    };
    for (const double nanometres : {wavelengths.shortest(), wavelengths.longest()}) {
        for (const Region& region : scene.regions)
            if (scene.sharp && !region.indexVaries())
                require(region.index.value.x, region.indexAt(ivec3(0), kDispersedTerm), nanometres,
                        " of '" + region.name + "'");
        for (const Region& region : scene.regions)
            if (region.crystal)
                require(region.crystal->index,
                        region.crystal->index + kDispersedTerm * region.crystal->dispersion,
                        nanometres, " of the e-rays of '" + region.name + "'");
        const Index& index = scene.index;
        if (index.dispersed.page.empty()) continue;
        const ivec3 size = scene.size();
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    require(index.grid.at({x, y, z}), index.dispersed.at({x, y, z}), nanometres,
                            "");
    }
}

void requireOne(const Scene& scene, const char* grid, RegionValues values) {
    for (const Region& region : scene.regions)
        if ((region.*values).varies())
            throw DataError(scene.path + ": grid '" + grid + "' of '" + region.name +
                            "' varies, expected one value on each side of sharp boundaries "
                            "(--boundary blurred takes any)");
}

} // namespace

glm::dmat4 Scene::voxelFromWorld() const {
    glm::dmat4 voxelFromWorld = frame.indexFromWorld();
    voxelFromWorld[3] -= glm::dvec4(glm::dvec3(domain.min), 0.0);
    return voxelFromWorld;
}

glm::dmat3 Scene::worldFromVoxelTurn() const {
    return glm::dmat3(frame.worldFromIndex) / frame.voxelSize;
}

bool Scene::anyHas(RegionValues values) const {
    return std::any_of(regions.begin(), regions.end(),
                       [&](const Region& region) { return !(region.*values).isZero(); });
}

bool Scene::anyColoured(std::initializer_list<RegionValues> values) const {
    for (const Region& region : regions)
        for (const RegionValues one : values)
            if (!(region.*one).grey()) return true;
    return false;
}

bool Scene::anyOpaque() const {
    return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
        return sharp ? region.opaque : region.opacity.most(0) > 0.5f;
    });
}

bool Scene::anyMetal() const {
    return std::any_of(regions.begin(), regions.end(),
                       [](const Region& region) { return region.metal.has_value(); });
}

bool Scene::anyRough() const {
    return std::any_of(regions.begin(), regions.end(),
                       [](const Region& region) { return region.roughness > 0; });
}

bool Scene::anyCrystal() const {
    return std::any_of(regions.begin(), regions.end(),
                       [](const Region& region) { return region.crystal.has_value(); });
}

bool Scene::anyVaryingCrystal() const {
    return std::any_of(regions.begin(), regions.end(),
                       [](const Region& region) { return region.crystalVaries(); });
}

bool Scene::anyMatt() const {
    return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
        return sharp ? region.opaque && !region.metal : region.opacity.most(0) > 0.5f;
    });
}

const Region* Scene::firstCoated() const {
    float least = std::numeric_limits<float>::infinity();
    for (const Region& region : regions)
        if (!region.opaque)
            least = std::min(least, region.index.varies() ? index.least : region.index.value.x);
    for (const Region& region : regions)
        if (sharp && region.opaque && !region.metal && region.index.value.x > least) return &region;
    return nullptr;
}

bool Scene::isClearAround() const {
    const Region& around = medium();
    return sharp && !around.indexVaries() && around.absorption.isZero() &&
           around.scattering.isZero() && around.emission.isZero() && !around.opaque;
}

bool Scene::showsLight() const {
    const bool receives = sharp ? anyMatt() : anyHas(&Region::opacity);
    return receives || anyHas(&Region::scattering);
}

int Scene::coefficientPages() const {
    int pages = 0;
    for (const Region& region : regions) pages += region.coefficientPages();
    return pages;
}

namespace {

/// Of blurred boundaries.
void readDispersion(Scene& scene, const Files& files, const Wanted& wanted) {
    Region& region = scene.regions.front();
    region.dispersion = readFirst(files, "dispersion");
    if (region.dispersion.isZero() || !wanted.wavelengths.disperse()) return;
    const volume::Volume* volume = files.withGrid("dispersion");
    scene.index.backgroundDispersion = volume ? volume->background("dispersion", vec3(0)).x : 0;
    disperse(scene.index, region.dispersion, scene.domain);
    scene.disperses = scene.index.varies();
}

Scene readGrids(const Files& files, const Wanted& wanted) {
    Scene scene;
    scene.path = files.path();
    scene.frame = files.frame();
    scene.domain = files.domain();
    scene.turned = files.turn();
    const volume::Volume* objects = files.withObjects();
    scene.sharp = wanted.boundary == optics::Boundary::sharp ||
                  (wanted.boundary == optics::Boundary::automatic && objects != nullptr);
    refuseStrayCrystalGrids(files, scene.sharp);
    if (!scene.sharp && objects != nullptr) refuseBlurredCrystals(*objects);
    if (scene.sharp) {
        if (objects == nullptr) files.first().require("sdf");
        readObjects(scene, *objects);
        settleCrystals(scene);
    } else {
        Region region;
        region.name = volume::kMedium;
        region.scattering = readFirst(files, "scattering");
        if (!region.scattering.isZero()) region.anisotropy = readFirst(files, "anisotropy");
        region.opacity = readFirst(files, "opacity");
        region.reflectance.value = vec3(1);
        scene.regions.push_back(std::move(region));
    }
    if (wanted.onlyIfLightShows && !scene.showsLight()) return scene;
    if (scene.sharp) {
        requireOne(scene, "reflectance", &Region::reflectance);
        if (wanted.surfaces) requireOne(scene, "albedo", &Region::albedo);
        scene.disperses = wanted.wavelengths.disperse() && disperses(scene);
        scene.index = varyingIndex(scene);
        scene.index.inHalf = objects->isStoredInHalf("ior");
        for (const Region& region : scene.regions)
            scene.index.inHalf |= objects->isStoredInHalf(volume::ownGrid("ior", region.name));
    } else {
        const volume::Volume* index = files.withGrid("ior");
        scene.index = blurredIndex(index ? *index : files.first(), files.domain());
        Region& region = scene.regions.front();
        readDispersion(scene, files, wanted);
        region.absorption = readFirst(files, "absorption");
        if (wanted.emission) region.emission = readFirst(files, "emission");
        if (wanted.surfaces && scene.anyOpaque()) region.albedo = readFirst(files, "albedo");
    }
    if (!wanted.light) return scene;
    if (scene.anyMatt()) scene.light.surfaces = readSurfaceLight(files);
    if (!scene.anyHas(&Region::scattering)) return scene;
    scene.light.fluence = readFluence(files);
    if (!scene.light.fluence.isZero() && scene.anyHas(&Region::anisotropy))
        scene.light.direction = readDirection(files);
    return scene;
}

} // namespace

Scene read(const Files& files, const Wanted& wanted) {
    Scene scene = readGrids(files, wanted);
    if (scene.disperses) requireIndex(scene, wanted.wavelengths);
    scene.layout = layoutOf(scene);
    return scene;
}

} // namespace eikonal::scene
