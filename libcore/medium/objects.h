// The objects of a scene with sharp boundaries, on the host: what bounds them, what is in them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "medium/medium.h"

#include <vector>

namespace eikonal::medium {

// Bits of a voxel's entry in the table that shaders/medium/surface.glsl reads.
constexpr size_t kMostSolids = 12;

/// A grid's values on one side of a boundary: one for all, or one per voxel of the domain.
struct OneSided {
    glm::vec3 value{0};     ///< a scalar stands in all three components
    volume::DenseGrid grid; ///< empty if it does not vary

    bool varies() const { return !grid.values.empty(); }
    bool isZero() const { return !varies() && value == glm::vec3(0); }
    bool grey() const;
    float at(size_t voxel, int component) const;
};

/// An object, or what surrounds them all. Values are the grids' [1/unit, not voxel].
struct Region {
    std::string name;
    OneSided index, absorption, scattering, anisotropy, emission, albedo, reflectance;
    bool opaque = false;

    /// Whether what it does to light on its way differs from place to place.
    bool coefficientsVary() const;
};

/// Distances are kept this far out [voxel].
constexpr float kKept = 5;

/// One object's boundary over the part of the domain where it is near or inside.
struct Solid {
    volume::IndexBox box;        ///< from the domain's first voxel on
    std::vector<float> distance; ///< signed, negative inside, x fastest [voxel]
    float band = 0;              ///< no distance is known beyond [voxel]
    float slope = 1;             ///< how it grows a voxel on, in the mean near the boundary
};

struct Objects {
    glm::ivec3 size{0};          ///< the domain's [voxel]
    std::vector<Solid> solids;   ///< the first that holds a point rules it
    std::vector<Region> regions; ///< of each solid, then of what surrounds them

    bool any(bool (*holds)(const Region&)) const;
    /// How many regions have coefficients that vary.
    int varying() const;
};

/// Reads level sets and one-sided grids over `box`. A region's grid varies only where that can be
/// seen: within the object and three voxels round it. Throws DataError for more than kMostSolids
/// objects.
Objects readObjects(const volume::Volume& volume, const volume::IndexBox& box);

} // namespace eikonal::medium
