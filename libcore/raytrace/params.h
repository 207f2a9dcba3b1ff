// What is traced, and how a picture is made of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/background.h"
#include "camera/camera.h"
#include "mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace eikonal::raytrace {

/// A body of one matter. Clear ones must be closed, and look outward; opaque ones may be sheets.
struct Body {
    std::string name; ///< for messages
    /// Its normals, where there are any, are those of the smooth surface that the triangles stand
    /// for (mesh::cornerNormals() of mesh::findFans()); where there are none it is flat.
    mesh::TriangleMesh mesh;
    double ior = 1.5;
    glm::dvec3 absorption{0}; ///< [1/unit]
    bool opaque = false;  ///< matt, lit by what surrounds the scene as if nothing else were there
    glm::dvec3 albedo{0}; ///< of an opaque one
};

/// Names of the pictures that can go beside the colour, with the volume method's meanings: all are
/// of a pixel's first branch, which refracts wherever it can, of light at the pixel's first sample.
const std::vector<std::string>& allAovs();

struct Params : camera::Background {
    camera::Camera camera;
    double outsideIor = 1; ///< of what is around the bodies
    int maxDepth = 64;     ///< most boundaries that a ray meets
    /// A reflection of a smaller share of its ray's light is not followed, and what is refracted
    /// takes that along; a branch below its square sees what is straight ahead.
    double cutoff = 1e-3;
    int samples = 1; ///< rays of a pixel, see camera::samplePattern()
    std::vector<std::string> aovs;

    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

/// Clear bodies that a scene may have: paths carry which of them they are within.
constexpr int kMostClearBodies = 16;

} // namespace eikonal::raytrace
