// Bodies that are where a function of space is below 0, as meshes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace eikonal::shapes {

struct ImplicitParams {
    std::string name;
    int resolution = 96;               ///< cells along the body's longest side
    std::uint32_t seed = 0;            ///< of what is placed at random
    std::map<std::string, double> set; ///< knobs of the body by name; others have their defaults

    /// Throws UsageError: a name that there is not, a knob that the body has not or beyond its
    /// range.
    void check() const;
};

/// A number that shapes a body.
struct Knob {
    std::string name, meaning;
    double value, least, most; ///< the default and the range, both ends included
};

/// A body by name, within a box.
struct ImplicitBody {
    std::string name, meaning;
    std::vector<Knob> knobs;
    using Values = std::map<std::string, double>;
    using Function = std::function<double(const glm::dvec3&)>; ///< below 0 inside
    std::function<mesh::Box(const Values&)> box;               ///< that holds it [unit]
    std::function<Function(const Values&, std::uint32_t seed)> function;
};

/// All of them.
const std::vector<ImplicitBody>& implicitBodies();

/// A mesh with its points on the surface, but near creases, where they are a cell's width off at
/// most: OpenVDB's polygons, their points then moved along the gradient by Newton's method.
mesh::TriangleMesh makeImplicit(const ImplicitParams& params);

} // namespace eikonal::shapes
