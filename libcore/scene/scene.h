// A scene volume on the host: where it lies, what bounds its objects, what is in them, its light.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optics/bands.h"
#include "optics/tracing.h"
#include "scene/files.h"
#include "scene/objects.h"
#include "scene/regions.h"
#include "scene/surface_light.h"
#include "scene/voxel_layout.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::scene {

/// The refractive index where it varies; of several regions each voxel has that of the varying one
/// which is nearest, so that look-ups within one find its own values alone.
struct Index {
    volume::BrickGrid grid; ///< at 587.6 nm; empty where it does not vary
    /// At kDispersedTerm of shaders/shared/field_params.h; empty where nothing disperses.
    volume::BrickGrid dispersed;
    /// What `grid` and `dispersed` lack of an index that a file holds in double; empty where they
    /// hold all of it. A faint contrast is all in here.
    volume::BrickGrid rest, dispersedRest;
    float background = 1;           ///< outside the domain
    float backgroundDispersion = 0; ///< Cauchy's B [µm²]
    float least = 1, most = 1;      ///< of both grids
    /// The largest jump between the domain's outermost voxels and the outside; of blurred
    /// boundaries.
    float jumpAtFaces = 0;
    bool inHalf = false; ///< a file holds some of it in 16 bits

    bool varies() const { return most > least || !rest.page.empty(); }
};

/// What lightsim stored.
struct StoredLight {
    Values fluence;   ///< [W/m²], of all files
    Values direction; ///< world space, weighted by the files' fluence
    SurfaceLight surfaces;
};

/// With sharp boundaries a region is an object, the first that holds a point, or what surrounds
/// them; blurred, one region is everywhere.
struct Scene {
    std::string path; ///< of the first file
    volume::Frame frame;
    volume::IndexBox domain;
    bool sharp = false;
    bool disperses = false;      ///< light is refracted by wavelength
    std::vector<Object> objects; ///< sharp boundaries alone
    std::vector<Region> regions; ///< of each object, then of what surrounds them
    Index index;
    StoredLight light;
    VoxelLayout layout; ///< of textures of its grids

    glm::ivec3 size() const { return domain.size(); }
    std::int64_t voxels() const { return domain.voxels(); }
    double voxelSize() const { return frame.voxelSize; }
    glm::dmat4 voxelFromWorld() const; ///< the domain's first voxel at the origin
    glm::dmat3 worldFromVoxelTurn() const;
    glm::dmat3 turned{1}; ///< how its files were turned in the world, their light with them

    /// What surrounds all objects; blurred, the one region.
    const Region& medium() const { return regions.back(); }
    /// Whether some region has values that are not 0.
    bool anyHas(RegionValues values) const;
    /// Whether some region's values differ by wavelength.
    bool anyColoured(std::initializer_list<RegionValues> values) const;
    /// Whether something stops light: an object, or voxels of an opacity above ½.
    bool anyOpaque() const;
    /// Of those, whether some shows the light that falls on it.
    bool anyMatt() const;
    bool anyMetal() const;   ///< with sharp boundaries
    bool anyRough() const;   ///< the same
    bool anyCrystal() const; ///< the same
    bool anyVaryingCrystal() const;
    /// A matt object whose index is above that of something transparent: it has a coat there. Null
    /// if there is none.
    const Region* firstCoated() const;
    /// Whether what surrounds its objects does nothing to light, with sharp boundaries.
    bool isClearAround() const;
    /// Whether light is seen anywhere: where it is scattered, or falls on what is opaque.
    bool showsLight() const;
    /// How many tables of coefficients that vary its regions have, of sharp boundaries.
    int coefficientPages() const;
};

/// What an engine wants of the files. Grids it does not want are not read.
struct Wanted {
    optics::Boundary boundary = optics::Boundary::automatic;
    optics::Wavelengths wavelengths;
    bool onlyIfLightShows = false; ///< where nothing shows light, stop at what tells so
    bool emission = false;
    bool surfaces = false; ///< albedo
    bool light = false;
};

/// Reads a scene. A grid of coefficients comes from the first file that has it, the light is the
/// sum of all. A region's grid varies only where that can be seen: of an object within it and three
/// voxels round it. Throws DataError for more objects than are traced, for grids that vary in a way
/// that is not, and where sharp boundaries are asked for and no file has any.
Scene read(const Files& files, const Wanted& wanted);

} // namespace eikonal::scene
