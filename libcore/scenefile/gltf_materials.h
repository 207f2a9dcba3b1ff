// What a glTF material means to light.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenefile/gltf_model.h"
#include "scenefile/scene.h"

namespace eikonal::scenefile {

/// Material `index` of the file. What it has and is not understood is added to `objects.unknown`.
Material readMaterial(const Gltf& file, int index, Objects& objects);

} // namespace eikonal::scenefile
