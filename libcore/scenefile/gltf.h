// glTF 2.0 scenes, text (.gltf) and binary (.glb).
// Source: Khronos Group, "glTF 2.0 Specification" (ISO/IEC 12113:2022), and its extensions
// KHR_materials_ior, _transmission, _volume, _dispersion and _emissive_strength,
// KHR_lights_punctual and KHR_mesh_quantization.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace eikonal::scenefile {

/// Whether a file is glTF: by its ending, .gltf or .glb in any case, or by its content.
bool isGltf(const std::string& path, std::string_view bytes);

// Each takes a file's path, for messages and to find buffers beside it, and its bytes. Coordinates
// are taken as world units, which glTF's are metres. They throw DataError for what is no glTF 2.0,
// for an index or a size out of range, numbers that are not finite, nodes that are not a tree, and
// an extension that is required and not known; MissingError where a buffer's file is missing.

/// The objects of the file's scene: each node's triangles, those of one material together.
/// Throws DataError where there are none.
Objects readGltfObjects(const std::string& path, std::string_view bytes);

/// The scene's cameras, in the order of its nodes.
std::vector<Camera> readGltfCameras(const std::string& path, std::string_view bytes);

/// The scene's lights, in the order of its nodes, with names of their own. glTF has them by the eye
/// (lux and candela): 683 lumens are taken for a watt, those of light of 540 THz (the SI's
/// definition of the candela), by which Blender exports watts.
Lights readGltfLights(const std::string& path, std::string_view bytes);

} // namespace eikonal::scenefile
