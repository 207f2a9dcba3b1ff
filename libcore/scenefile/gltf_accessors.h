// The numbers that a glTF file's accessors name, checked against the bytes that there are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/gltf_model.h"

#include <cstdint>

namespace eikonal::scenefile {

// Both throw DataError, naming `what`, where the accessor is not there, is of another type, or
// reaches beyond its bytes. Memory is taken only for bytes that were seen.

/// Vectors of three: floats, or whole numbers (KHR_mesh_quantization), as their sparse ones replace
/// them. All are finite.
std::vector<glm::dvec3> readVectors(const Gltf& file, int accessor, const std::string& what);

/// Whole numbers, each below `limit`.
std::vector<std::uint32_t> readIndices(const Gltf& file, int accessor, size_t limit,
                                       const std::string& what);

} // namespace eikonal::scenefile
