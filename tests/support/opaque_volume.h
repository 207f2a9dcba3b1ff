// Opaque material in empty space, by a signed distance.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/test_volume.h"

namespace eikonal {

enum class Edge {
    sharp,   ///< a signed distance
    blurred, ///< opacity that falls over two voxels
    voxels   ///< opacity that is 0 or 1
};

/// Opaque where the distance [voxel] is negative.
inline TestVolume opaqueVolume(const glm::ivec3& size, const TestVolume::Scalar& distance,
                               const glm::dvec3& albedo, Edge edge = Edge::sharp) {
    TestVolume scene{size};
    if (edge == Edge::sharp) scene.add("sdf", distance, 1e3);
    const double fall = edge == Edge::blurred ? 0.5 : 1e6;
    scene.constant("ior", 1);
    scene.add("opacity",
              [=](glm::dvec3 p) { return glm::clamp(0.5 - fall * distance(p), 0.0, 1.0); });
    scene.constantVector("albedo", albedo);
    return scene;
}

} // namespace eikonal
