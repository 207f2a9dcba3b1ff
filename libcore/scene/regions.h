// What a point of a scene is made of: an object's medium, or what surrounds them all.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/objects.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace eikonal::scene {

/// A grid's values in a region: one for all of it, or one per voxel of the domain.
struct Values {
    glm::vec3 value{0};     ///< a scalar stands in all three components
    volume::BrickGrid grid; ///< empty if it does not vary

    bool varies() const { return !grid.page.empty(); }
    bool isZero() const { return !varies() && value == glm::vec3(0); }
    /// Whether R = G = B everywhere.
    bool grey() const;
    /// Whether a brick of the domain has one value.
    bool isEven(size_t brick) const { return !varies() || grid.page[brick] < 0; }
    float at(const glm::ivec3& voxel, int component) const {
        return !varies() ? value[component] : grid.at(voxel, grid.components == 1 ? 0 : component);
    }
    /// The largest value of a component.
    float most(int component) const;
};

/// An object, or what surrounds them all. Values are the grids' [1/unit, not voxel].
struct Region {
    std::string name;
    Values index;      ///< of sharp boundaries
    Values dispersion; ///< Cauchy's B [µm²]
    Values absorption, scattering, anisotropy, emission, albedo, reflectance, opacity;
    bool opaque = false; ///< of sharp boundaries: all of it
    int priority = 0;    ///< where objects overlap the higher wins
    float roughness = 0; ///< GGX's α of its boundary
    std::optional<volume::Metal> metal;
    /// Its axis turned as the file is. None where it is as glass.
    std::optional<volume::Crystal> crystal;
    Values absorptionExtraordinary; ///< of a crystal's light that is polarised along its axis
    bool absorbsAlike = false;      ///< that is `absorption`
    /// Of a crystal by grids: the axis in its files' world, 0 where it is isotropic, and n_e.
    Values axis, indexExtraordinary;

    /// At a term of Cauchy's law [1/µm²]; of sharp boundaries.
    float indexAt(const glm::ivec3& voxel, float term) const;
    /// Whether the index differs from place to place, of some wavelength; within a brick.
    bool indexVaries() const { return index.varies() || dispersion.varies(); }
    bool indexIsEven(size_t brick) const { return index.isEven(brick) && dispersion.isEven(brick); }
    /// Whether what it does to light on its way differs from place to place.
    bool coefficientsVary() const { return coefficientPages() > 0; }
    /// How many tables of coefficients it has: one, of a crystal's light along its axis another.
    int coefficientPages() const;
    /// Whether it is a crystal whose axis or indices differ from place to place. Then `index` and
    /// `crystal` hold the n_o and n_e that are furthest apart.
    bool crystalVaries() const;
};

/// A grid's values in a region, whichever that is.
using RegionValues = Values Region::*;

/// Reads a grid over `box`: one value if it does not vary there, what the contract says of an
/// absent grid if it is not there.
Values readValues(const volume::Volume& volume, const std::string& grid,
                  const volume::IndexBox& box);

/// Reads the region of an object, or of what surrounds them all where `object` is null. Grids vary
/// only where that can be seen: within the object and three voxels round it. `own`: its values are
/// grids of its own, else the plain ones.
Region readRegion(const volume::Volume& volume, const volume::ObjectFacts& facts,
                  const volume::IndexBox& box, const Object* object, bool own);

/// As the device reads it, lengths in voxels; `page` is where its coefficients that vary begin, if
/// some do, each page of `texels`; `turn` leads from voxel space to the world.
struct RegionParams paramsOf(const Region& region, float voxelSize, const glm::dmat3& turn,
                             int page, int texels);

} // namespace eikonal::scene
