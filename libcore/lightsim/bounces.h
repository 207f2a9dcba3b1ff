// Light that opaque surfaces have reflected: power by voxels, spread over the surface they are on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/result.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace eikonal::lightsim {

/// What a surface has in a voxel of the domain. Surfaces that face other ways have others.
struct SurfacePatch {
    glm::ivec3 voxel{0};
    glm::vec3 power{0}; ///< that falls on it [W]
    glm::vec3 flow{0};  ///< the same, mean of RGB, times where it travels, in voxel space
    glm::vec3 normal{0};
    float area = 0; ///< [m²]
};

/// Adds a part of a surface to the patch of its voxel that faces its way, or as a new one. Parts
/// come voxel by voxel.
void gather(std::vector<SurfacePatch>& patches, const SurfacePatch& part);

/// The irradiance that patches get, smoothed along surfaces where photons are few. Power and area
/// are smoothed apart, so that it does not fall off where a surface ends.
class SoftLight {
public:
    /// Patches about a voxel.
    struct Near {
        glm::ivec3 voxel{0};
        std::vector<const SurfacePatch*> patches;
        bool empty() const { return patches.empty(); }
    };

    /// Of patches in a domain of that many voxels, in ascending order of their places, x fastest.
    /// `photon` is what one brings to a voxel's face at most [W/m²].
    SoftLight(const glm::ivec3& size, std::vector<SurfacePatch> patches, double photon);

    Near near(const glm::ivec3& voxel) const;
    /// At a point [voxel] in the voxel that they are near, of a surface of that normal; flow in
    /// voxel space. Nothing where no patch is near.
    static LightAtPoint at(const Near& near, const glm::vec3& x, const glm::vec3& normal);

private:
    /// Calls `visit(patch)` for every one of a voxel.
    template<typename Visit> void forEachIn(const glm::ivec3& voxel, const Visit& visit) const;
    SurfacePatch smoothed(const SurfacePatch& patch, double photon) const;

    glm::ivec3 mSize;
    std::vector<SurfacePatch> mPatches;
    std::vector<std::uint32_t> mPlaces; ///< of their voxels
};

} // namespace eikonal::lightsim
