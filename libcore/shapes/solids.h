// Plain solids: box, sphere, prism.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <optional>

namespace eikonal::shapes {

struct BoxParams {
    glm::dvec3 low{-0.5}, high{0.5}; ///< two opposite corners [unit]
    double bevel = 0;                ///< radius of the edges and corners [unit]
    int segments = 8;                ///< of a quarter of a turn, where there is a bevel; even
    /// Throws UsageError.
    void check() const;
};
/// With a bevel it has the rounded surface's normals.
mesh::TriangleMesh makeBox(const BoxParams& params);

struct SphereParams {
    double radius = 1;  ///< [unit]
    int segments = 256; ///< around the y axis; half as many from pole to pole
    void check() const;
};
/// About the origin, its points on the sphere.
mesh::TriangleMesh makeSphere(const SphereParams& params);

struct PrismParams {
    int sides = 3;
    double side = 1;   ///< of the regular polygon, of a triangle with an apex its base [unit]
    double length = 1; ///< along z [unit]
    std::optional<double> apex{}; ///< angle between the two equal sides of a triangle [degree]
    void check() const;
};
/// About the origin, a corner at the top; its faces are flat, with normals that say so.
mesh::TriangleMesh makePrism(const PrismParams& params);

} // namespace eikonal::shapes
