// Bodies that are where a function of space is below 0, as meshes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/implicit.h"

#include "base/error.h"
#include "base/text.h"
#include "volume/polygonize.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

namespace eikonal::shapes {

namespace {

const ImplicitBody& bodyOf(const std::string& name) {
    std::vector<std::string> names;
    for (const ImplicitBody& body : implicitBodies()) {
        if (body.name == name) return body;
        names.push_back(body.name);
    }
    throw UsageError("NAME: found '" + name + "', expected one of " + join(names, ", "));
}

/// Onto the function's zero, by at most half a cell: near a crease the gradient may lead astray.
glm::dvec3 onSurface(const ImplicitBody::Function& function, const glm::dvec3& start, double cell) {
    const double h = 1e-3 * cell;
    glm::dvec3 x = start;
    for (int step = 0; step < 4; ++step) {
        glm::dvec3 gradient;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 d(0);
            d[axis] = h;
            gradient[axis] = (function(x + d) - function(x - d)) / (2 * h);
        }
        const double squared = glm::dot(gradient, gradient);
        if (!(squared > 0)) return start;
        x -= function(x) / squared * gradient;
        if (!(glm::length(x - start) < cell / 2)) return start;
    }
    return x;
}

} // namespace

void ImplicitParams::check() const {
    const ImplicitBody& body = bodyOf(name);
    for (const auto& [knob, value] : set) {
        const auto known = std::find_if(body.knobs.begin(), body.knobs.end(),
                                        [&](const Knob& k) { return k.name == knob; });
        if (known == body.knobs.end()) throw UsageError("--" + knob + ": is nothing of a " + name);
        requireOption(value >= known->least && value <= known->most, "--" + knob, toText(value),
                      toText(known->least) + " to " + toText(known->most) + " for a " + name);
    }
    requireOption(resolution >= 8 && resolution <= 1024, "--resolution", std::to_string(resolution),
                  "8 to 1024");
}

mesh::TriangleMesh makeImplicit(const ImplicitParams& params) {
    const ImplicitBody& body = bodyOf(params.name);
    ImplicitBody::Values values;
    for (const Knob& knob : body.knobs) values[knob.name] = knob.value;
    for (const auto& [knob, value] : params.set) values[knob] = value;
    const ImplicitBody::Function function = body.function(values, params.seed);
    const mesh::Box box = body.box(values);
    const glm::dvec3 size = box.max - box.min;
    const double cell = std::max({size.x, size.y, size.z}) / params.resolution;
    // Shifted by part of a cell, so that no plane of a body's lies in a plane of the lattice, where
    // the function would be 0 at corners.
    const glm::dvec3 shift = cell * glm::dvec3(0.37, 0.41, 0.43);
    volume::Polygons polygons = volume::polygonize(function, box.min - shift, box.max + cell, cell);
    tbb::parallel_for(size_t(0), polygons.points.size(), [&](size_t i) {
        polygons.points[i] = onSurface(function, polygons.points[i], cell);
    });
    mesh::TriangleMesh made;
    made.points = std::move(polygons.points);
    for (const glm::uvec4& q : polygons.quads) {
        const auto& p = made.points;
        // Along the shorter diagonal.
        if (glm::length(p[q.x] - p[q.z]) <= glm::length(p[q.y] - p[q.w])) {
            made.triangles.emplace_back(q.x, q.y, q.z);
            made.triangles.emplace_back(q.x, q.z, q.w);
        } else {
            made.triangles.emplace_back(q.x, q.y, q.w);
            made.triangles.emplace_back(q.y, q.z, q.w);
        }
    }
    if (made.triangles.empty())
        throw InternalError("implicit " + params.name + ": no surface found");
    return made;
}

} // namespace eikonal::shapes
