// The triangles of a glTF primitive.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/gltf_model.h"
#include "scenefile/scene.h"

namespace eikonal::scenefile {

/// Whether it has triangles, rather than points or lines.
bool isOfTriangles(const tinygltf::Primitive& primitive);

/// Appends its triangles, placed in the world, to an object. `sofar` counts the scene's: throws
/// DataError beyond what fits, for a small file may name a mesh many times. `where` is for
/// messages.
void addTriangles(const Gltf& file, const tinygltf::Primitive& primitive,
                  const glm::dmat4& worldFromNode, const std::string& where, size_t& sofar,
                  Object& object);

} // namespace eikonal::scenefile
