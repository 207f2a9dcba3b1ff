// What the methods in image space are asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera/background.h"
#include "camera/camera.h"
#include "mesh/triangle_mesh.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::imagespace {

/// How a ray finds the way out of a body.
enum class Method {
    dir, ///< by a search in the depths of the back faces (Oliveira, Brauwers 2007)
    isr, ///< by a guess between two distances (Wyman 2005), one of them known for each point
    sir  ///< not at all: refracted once
};

/// Names of the pictures that can go beside the colour.
const std::vector<std::string>& allAovs();

/// What refracts: a closed surface whose faces look outward, in a medium of index 1.
struct Body {
    mesh::TriangleMesh mesh; ///< with the normals it is to have; without, its faces are flat
    /// isr: of each point, along the normal inward to the far side [unit]
    std::vector<float> distances;
};

/// A matt surface beside the body, lit by what surrounds the scene as if nothing else were there.
struct Plate {
    mesh::TriangleMesh mesh; ///< open or closed; its normals as Body's
    glm::dvec3 albedo{0.8};
};

struct Params : camera::Background {
    camera::Camera camera;
    Method method = Method::dir;
    double ior = 1.5;         ///< of the body, relative to what is round it
    glm::dvec3 absorption{0}; ///< of the body [1/unit]
    int searchSteps = 5;      ///< dir: halvings of the range of depths, see kMostSearchSteps
    /// dir: front and back faces behind each other that a pixel keeps, among which rays are
    /// followed; 0: the furthest back faces alone
    int layers = 0;
    int maxDepth = 64; ///< with layers: most interfaces that a ray meets
    /// With layers: a reflection of a smaller share of its ray's light is not followed, and what is
    /// refracted takes that along.
    double cutoff = 1e-3;
    int samples = 1; ///< rays of a pixel, see camera::samplePattern()
    std::vector<std::string> aovs;

    /// Throws UsageError naming the option that is wrong.
    void check() const;
    /// Whether what is seen through the body has a colour of its own.
    bool isColoured() const { return absorption != glm::dvec3(absorption.x); }
};

/// Layers that any device has, of front and back faces together, halved.
constexpr int kMostLayers = 64;

/// Halvings beyond which a range of floats has nothing left to halve.
constexpr int kMostSearchSteps = 32;

} // namespace eikonal::imagespace
