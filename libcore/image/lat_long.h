// Directions of lat-long maps (OpenEXR's ImfEnvmap.h): row 0 is +Y, the middle +Z, +X at longitude
// +π/2, which lies on the left.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace eikonal::image {

/// How a map is placed: turned by so many degrees about its up axis, which is Y or Z. A turn by
/// +90° brings what it shows at +X to +Z, as turning the picture to the right does.
glm::dmat3 mapFromWorld(double turn, bool zUp);

/// The unit vector, in the map's frame, of a place in the picture: (0, 0) its upper left corner,
/// (1, 1) its lower right one.
glm::dvec3 directionOf(const glm::dvec2& place);

/// The radiance there of a map that has exactly R, G and B: between its pixels, which lie where
/// `envmap` says, by bilinear interpolation, round the seam.
glm::dvec3 radianceAt(const Image& map, const glm::dvec2& place);

} // namespace eikonal::image
