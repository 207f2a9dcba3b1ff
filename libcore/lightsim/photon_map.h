// How a light sees the domain: the windows of its photon map (Sun et al. 2008, §4.3).
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lightsim/sources.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace eikonal::lightsim {

/// An axis-aligned box in voxel space, the domain's low corner voxel at the origin.
struct VoxelBox {
    glm::dvec3 low, high;
    bool contains(const glm::dvec3& p, double margin) const;
};

/// One rectangle of a photon map: parallel rays, or a part of one face of a cube round the light.
struct Window {
    bool point = false;
    Source source;                 ///< whose rays go through it
    glm::dvec3 right, up, forward; ///< orthonormal, voxel space
    glm::dvec3 origin{0};          ///< the light [voxel]; point lights only
    glm::dvec2 low, extent;        ///< offsets [voxel] or tangents
    glm::ivec2 pixels;             ///< of the whole map in this window
    double near = 0, far = 1;      ///< depth range along forward [voxel]
    bool startsAtLight = false;    ///< the light is in the domain, and there is no proxy

    double pixelArea() const; ///< [voxel²] or [sr] straight ahead

    /// The part of the map that batch (i, j) of b × b interleaved ones covers.
    Window batch(int i, int j, int b) const;
    glm::dmat4 clipFromVoxel() const;

    /// A rectangle of its coordinates, low and high corner, that a box lies in as the light sees
    /// it; nothing where a part of the box is beside or behind the light.
    std::optional<glm::dvec4> rectangleOf(const VoxelBox& box) const;
};

/// How finely a map is cut: so many pixels in all, or, if 0, by what a pixel covers where the
/// target is.
struct MapDetail {
    std::int64_t pixels = 0;
    double edge = 1;             ///< of what a pixel covers [voxel]
    std::int64_t most = 1 << 24; ///< pixels by that
};

/// The windows through which a source sees `target`, by pixels of that detail; none where it shines
/// elsewhere. A map of parallel rays is shifted by `shift` pixels in [0, 1)². The domain tells
/// whether the source stands inside.
std::vector<Window> windowsOf(const Source& source, const VoxelBox& target, const VoxelBox& domain,
                              const MapDetail& detail, const glm::dvec2& shift, bool hasProxy);

} // namespace eikonal::lightsim
