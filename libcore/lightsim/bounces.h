// Light that opaque surfaces have reflected: power by voxels, spread over the surface they are on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/result.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::lightsim {

/// What a surface has in a voxel of the domain.
struct SurfacePatch {
    glm::ivec3 voxel{0};
    glm::vec3 power{0}; ///< that falls on it [W]
    glm::vec3 flow{0};  ///< the same, mean of RGB, times where it travels, in voxel space
    glm::vec3 normal{0};
    float area = 0; ///< [m²]
};

/// The irradiance that patches get, smoothed along surfaces: it has no sharp edges, and photons are
/// few. Power and area are smoothed apart, so that it does not fall off where a surface ends.
class SoftLight {
public:
    /// Of patches in a domain of that many voxels, in ascending order of their places, x fastest.
    SoftLight(const glm::ivec3& size, std::vector<SurfacePatch> patches);

    /// At a point [voxel] of a surface of that normal; flow in voxel space. Nothing where no patch
    /// is near.
    LightAtPoint at(const glm::vec3& x, const glm::vec3& normal) const;

private:
    const SurfacePatch* patchOf(const glm::ivec3& voxel) const;
    SurfacePatch smoothed(const SurfacePatch& patch) const;

    glm::ivec3 mSize;
    std::vector<SurfacePatch> mPatches;
};

} // namespace eikonal::lightsim
