// Which triangles of a file are an object of their own.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace eikonal::mesh {

/// For each of the `count` labels, the first of those it makes one object with. `labels` has one
/// for each triangle. Labels that have an open edge in common belong together, and a closed
/// surface that looks inward with the smallest around it.
std::vector<std::uint32_t> objectsOf(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& labels, size_t count);

/// The triangles of each object with their points, at the label that stands for it; at the others
/// nothing.
std::vector<TriangleMesh> split(const TriangleMesh& mesh, const std::vector<std::uint32_t>& labels,
                                const std::vector<std::uint32_t>& objects);

} // namespace eikonal::mesh
