// Closed shapes of known size, for tests and benchmarks.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

namespace eikonal::mesh {

/// A box of 12 triangles between two corners [unit]; outward while min < max on every axis.
TriangleMesh boxShape(const glm::dvec3& min, const glm::dvec3& max);

/// A sphere around the origin of 20 · 4^subdivisions nearly equal triangles, its corners on the
/// sphere of that radius [unit].
TriangleMesh icosphere(double radius, int subdivisions);

/// A sphere around the origin by rings of latitude (poles at ±Y), of about so many triangles (at
/// least 12), its corners on the sphere of that radius [unit].
TriangleMesh uvSphere(double radius, size_t triangleCount);

/// A profile (distance from the y axis, y) turned round that axis, in so many steps [unit]. Outward
/// where the profile runs upward outside: from a pole or from any point of a ring, back to which it
/// runs. Points on the axis are poles.
TriangleMesh turned(const std::vector<glm::dvec2>& profile, int steps, bool ring);

/// Both meshes in one, as two sets of points.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// The same surface seen from the other side.
TriangleMesh turnedInsideOut(TriangleMesh mesh);

/// The mesh moved by an offset [unit].
TriangleMesh moved(TriangleMesh mesh, const glm::dvec3& offset);

} // namespace eikonal::mesh
