// Meshes as the device draws them, and where they are seen.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "gpu/raster.h"
#include "imagespace/params.h"

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

/// A geometry's triangles along a curve that fills its box (Morton 1966): devices work out a vertex
/// anew where the triangles that share it are far apart in the list.
std::vector<std::uint32_t> nearbyOrder(const Geometry& geometry);

/// Puts its triangles in that order.
void reorder(Geometry& geometry, std::span<const std::uint32_t> order);

/// Which of a geometry's triangles may be seen from their front, and which from behind.
struct Sides {
    gpu::Triangles::Part front, back;
};

/// Puts the triangles that a camera surely sees from their front first, and those that it surely
/// sees from behind last; each stay in their order. Both parts hold what is too near to edge-on to
/// tell from here.
Sides sortBySide(Geometry& geometry, const camera::Camera& camera);

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
