// Directions and lat-long pictures: where in an environment map a direction lies.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace eikonal::image {

// The convention is OpenEXR's ENVMAP_LATLONG (ImfEnvmap.h), Y up: latitude = asin(y), longitude =
// atan2(x, z), and the picture runs from longitude +π at its left edge to -π at its right one,
// latitude +π/2 on top. So (u, v), from the upper left corner:
//     u = ½ - longitude / 2π     v = ½ - latitude / π
// +Z is the centre, +Y the whole top edge, -Z the left and right edges, +X a quarter from the left
// (as seen from inside, +X is to the left of +Z). OpenImageIO's lookup of a Y-up map is the same
// formula, vector_to_latlong() in its environment.cpp, with -x for x and +½.
//
// Where pixels lie in (u, v) is another question. ImfEnvmap.h puts the *centres* of the outer
// pixels on the edges, u = i / (width - 1), so that the first and last column hold the same values,
// and so does OpenImageIO where an EXR has the 'envmap' attribute (its "oiio:sampleborder").
// Without it, and for every other format, OpenImageIO takes the edges of the outer pixels as the
// edges of the map, u = (i + ½) / width. Image::envmap says which file it was.

/// (u, v) in [0, 1] of a direction, which need not have length 1. At the poles, where every
/// longitude is right, and for the zero vector, u is ½.
glm::dvec2 latLongFromDirection(glm::dvec3 direction);

/// The unit direction at (u, v); the inverse of the above.
glm::dvec3 directionFromLatLong(glm::dvec2 uv);

/// The place of (u, v) among the pixels of a picture of `size`, in units of pixels, where integers
/// are pixel centres. `onEdges`: the outer pixels' centres lie on the edges (Envmap::latLong).
glm::dvec2 pixelFromLatLong(glm::dvec2 uv, glm::ivec2 size, bool onEdges);

} // namespace eikonal::image
