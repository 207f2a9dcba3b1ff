// Scenes with sharp boundaries whose domains overlap, made one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/ground.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace eikonal::scene {

/// A scene and the ground it has, if it has one.
struct Part {
    const Scene* scene = nullptr;
    std::optional<Ground> ground;
};

struct Merged {
    Scene scene;
    std::optional<Ground> ground; ///< the first part's that has one
};

/// One scene of the parts' objects, on voxels as fine as the finest's, which lie as the ground's
/// scene has them or else the finest. Where objects overlap the higher priority wins, among equals
/// that of the later part. Each object keeps the light that was stored on it and in it. Throws
/// DataError if a part is blurred, if something but a clear, even medium surrounds its objects, or
/// if they are more than are traced, MemoryError if they lie too far apart for voxels so fine.
Merged merge(const std::vector<Part>& parts);

} // namespace eikonal::scene
