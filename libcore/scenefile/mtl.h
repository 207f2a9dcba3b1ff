// Materials of an OBJ file: its .mtl.
// Source: Wavefront, "MTL material format" (1995), and the PBR lines Pr and Pm of Exocortex (2016),
// which Blender writes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace eikonal::scenefile {

struct Materials {
    std::vector<Material> materials;
    std::vector<std::string> unknown; ///< keywords that are not understood, once each
};

/// Reads a .mtl's bytes; `path` is for messages. What lets light through: d below 1 (or Tr above
/// 0), illum 4, 6, 7 or 9, a Tf that is not white, or any Tf beside Pr or Pm, as Blender writes it.
/// Throws DataError, with the line, for a number that is none or out of range.
Materials readMtl(const std::string& path, std::string_view bytes);

} // namespace eikonal::scenefile
