// Light that opaque surfaces have reflected: power by voxels, spread over the surface they are on.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/result.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
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

/// Patches, and which hang together.
struct SurfacePatches {
    std::vector<SurfacePatch> all;     ///< in ascending order of their voxels' places, x fastest
    std::vector<std::uint32_t> ofFine; ///< the patch of each surface voxel, by its number
    /// Neighbours on one surface, both ways, ascending: those of one patch after those of another.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
};

/// Whether surfaces of these normals are one.
bool areOne(const glm::vec3& normal, const glm::vec3& other);

/// Adds what a surface voxel has to the patch of its voxel that faces its way, or as a new one.
/// They come voxel by voxel.
void gather(SurfacePatches& patches, const SurfacePatch& part);

/// The irradiance that patches get, where photons are few shared out along the surface, from voxel
/// to voxel. Power and area are shared out apart, so that it does not fall off where a surface
/// ends.
class BouncedLight {
public:
    /// In a domain of that many voxels. `photon` is what one brings to a voxel's face at most
    /// [W/m²].
    BouncedLight(const glm::ivec3& size, SurfacePatches patches, double photon);

    /// At a point [voxel] of a surface voxel.
    LightAtPoint ofFine(std::uint32_t number, const glm::vec3& x) const;
    /// At a point [voxel] of a surface of that normal; flow in voxel space. Nothing where no patch
    /// is near.
    LightAtPoint at(const glm::vec3& x, const glm::vec3& normal) const;

private:
    void share(double photon);
    LightAtPoint about(std::uint32_t patch, const glm::vec3& x) const;
    std::uint32_t patchNear(const glm::vec3& x, const glm::vec3& normal) const;

    glm::ivec3 mSize;
    SurfacePatches mPatches;
    std::vector<size_t> mFirst; ///< link of each patch, and behind the last
};

} // namespace eikonal::lightsim
