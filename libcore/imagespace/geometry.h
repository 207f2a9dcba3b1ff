// Meshes as the device draws them, and where they are seen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/raster.h"
#include "imagespace/params.h"
#include "imagespace/shared.h"

#include <span>
#include <vector>

namespace eikonal::imagespace {

/// A mesh's vertices about the middle of its box, where floats are finest.
struct Geometry {
    glm::dvec3 middle{0};
    double radius = 0;           ///< of a sphere about the middle that holds it all
    std::vector<float> vertices; ///< place, outward normal, and what else a vertex has
    std::vector<std::uint32_t> indices;
    int extra = 0; ///< floats a vertex beside place and normal
};

/// Corners of one point and normal are one vertex. Where there are distances, one a point, they are
/// a further float of it.
Geometry geometryOf(const Body& body);

/// All of them in one; a vertex has its plate's albedo, three further floats.
Geometry geometryOf(const std::vector<Plate>& plates);

gpu::Triangles trianglesOf(gpu::Device& device, const Geometry& geometry);

/// How near and far a camera looks, so that all of the spheres that is before the eye is seen
/// [unit].
struct Depths {
    double near, far;
};
Depths depthsOf(const camera::Camera& camera, std::span<const Geometry* const> all);

/// Camera space from the space of a geometry's vertices.
glm::mat4 cameraFromBody(const camera::Camera& camera, const Geometry& geometry);

/// y down, depths from 0, far, to 1, near; the middle of a pixel is the place of it that
/// `place`, from (0, 0) to (1, 1), tells.
glm::mat4 clipFromCamera(const camera::Camera& camera, const Depths& depths,
                         const glm::dvec2& place);

} // namespace eikonal::imagespace
