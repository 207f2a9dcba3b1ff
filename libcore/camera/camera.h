// Where the eye is, and which way each pixel looks.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/exr.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace eikonal::camera {

struct Camera {
    glm::dvec3 eye{0}, target{0}, up{0, 1, 0}; ///< world [unit]
    bool parallel = false;
    double fov = 0;          ///< vertical, perspective [degree]
    double height = 0;       ///< of the view, parallel [unit]
    int width = 0, rows = 0; ///< of the picture [pixel]

    double aspect() const { return static_cast<double>(width) / rows; }
    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

/// Orthonormal, world.
struct CameraAxes {
    glm::dvec3 forward, right, up;
};
CameraAxes axesOf(const Camera& camera);

struct Ray {
    glm::dvec3 start{0}, direction{0}; ///< of length 1
};

/// Rays of a camera, in the world.
class Eye {
public:
    explicit Eye(const Camera& camera);
    /// Through a place of the picture [pixel]: (0, 0) its upper left corner.
    Ray rayThrough(const glm::dvec2& place) const;

private:
    Camera mCamera;
    CameraAxes mAxes;
    double mHalf; ///< of the picture's height, at distance 1 if in perspective [unit]
};

/// How far light is turned [rad]: the angles of its direction `exit` with the camera ray's,
/// `began`, to the right and upward, along the picture's axes made perpendicular to that. All in
/// one frame.
glm::dvec2 deflectionOf(const CameraAxes& axes, const glm::dvec3& began, const glm::dvec3& exit);

/// Right, up and forward as x, y, z, the eye at the origin [unit].
glm::dmat4 cameraFromWorld(const Camera& camera);

/// To coordinates in [0, 1] over the picture, y down, as OpenEXR's worldToNDC has them.
glm::dmat4 ndcFromCamera(const Camera& camera);

/// The camera's matrices in OpenEXR's spaces.
void describeCamera(const Camera& camera, image::ImageAttributes& attributes);

} // namespace eikonal::camera
