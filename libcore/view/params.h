// What the view stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/background.h"
#include "camera/camera.h"
#include "image/image.h"
#include "optics/tracing.h"

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eikonal::view {

using camera::Camera;
using optics::Integrator;
using optics::Interpolation;

/// Names of the pictures that can go beside the colour.
const std::vector<std::string>& allAovs();

/// Light for the points of a picture, row by row, as lightsim --at gives it.
struct PointLights {
    int width = 0, rows = 0;        ///< of the picture [pixel]
    std::vector<glm::dvec3> places; ///< in the world [unit]
    std::vector<bool> isPoint;      ///< whether a pixel shows an opaque surface
    std::vector<glm::vec3> lights;  ///< irradiance [W/m²]
    bool empty() const { return places.empty(); }
};

/// A picture upright behind the scene, across the camera's axis.
struct Plate {
    image::Image picture; ///< radiance: exactly R, G and B
    double distance = 0;  ///< from the eye along the axis [unit]
    double height = 0;    ///< [unit]; 0: as much as covers the view
    bool endless = true;  ///< beyond it are its border's pixels, or what surrounds the scene
};

struct Params : optics::Tracing, camera::Background {
    Camera camera;
    int maxDepth = 64; ///< sharp: most boundaries that a ray meets
    /// Sharp: a reflection of a smaller share of its ray's light is not followed, and what is
    /// refracted takes that along; below its square a branch is dropped. What floats hold of a
    /// picture is three decimals.
    double cutoff = 1e-3;
    int samples = 1;  ///< rays of a pixel, see camera::samplePattern()
    int maxSteps = 0; ///< of one ray, after which it counts as trapped; 0: 16 crossings' worth
    std::vector<std::string> aovs;
    std::optional<Plate> plate;
    /// Sharp: linear polarisers, by the angle of what they let through from the picture's right
    /// towards its up [degree]: before the camera, and before what surrounds the scene.
    std::optional<double> polarizer, backPolarizer;
    PointLights points; ///< where a pixel's first branch ends, in place of the stored light

    double unit = 0; ///< of the scene [m]: the waves of weak crystals interfere; 0: unknown
    bool polarises() const { return polarizer || backPolarizer; }
    /// Throws UsageError naming the option that is wrong.
    void check() const;
};

} // namespace eikonal::view
