// A scene file's camera as render's.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "camera/camera.h"
#include "common/session.h"
#include "scenefile/gltf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace eikonal::scene_camera {

/// "FILE[:NAME]" of --camera.
struct Name {
    std::string path, camera;
};

inline Name parse(const std::string& text) {
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos || std::filesystem::exists(text)) return {text, ""};
    return {text.substr(0, colon), text.substr(colon + 1)};
}

/// The one of that name, a node's before a camera's; without a name the first, with a note where
/// there are more. Throws DataError where there is none.
inline scenefile::Camera read(tool::Session& session, const Name& name) {
    const std::string bytes = readWhole(name.path);
    if (!scenefile::isGltf(name.path, bytes))
        throw DataError(name.path + ": is no glTF file, expected .glb or .gltf for --camera");
    const std::vector<scenefile::Camera> all = scenefile::readGltfCameras(name.path, bytes);
    if (all.empty()) throw DataError(name.path + ": its scene has no camera");
    std::vector<std::string> names;
    for (const scenefile::Camera& camera : all) names.push_back(camera.node);
    if (name.camera.empty()) {
        if (all.size() > 1)
            session.note(name.path + ": has " + std::to_string(all.size()) + " cameras, " +
                         join(names, ", ") + ": takes the first (--camera FILE:NAME)");
        return all.front();
    }
    for (const auto member : {&scenefile::Camera::node, &scenefile::Camera::name})
        for (const scenefile::Camera& camera : all)
            if (camera.*member == name.camera) return camera;
    throw DataError(name.path + ": its scene has no camera '" + name.camera +
                    "', expected one of " + join(names, ", "));
}

/// Places render's camera.
inline void place(const scenefile::Camera& from, camera::Camera& to) {
    to.eye = from.eye;
    to.target = from.eye + from.forward;
    to.up = from.up;
    to.parallel = from.parallel;
    to.fov = from.fov;
    to.height = from.height;
}

/// "WxH" of a picture of the camera's aspect, its longer edge 640 pixels; 4:3 where it has none.
inline std::string sizeOf(const scenefile::Camera& camera) {
    const double aspect = camera.aspect.value_or(4.0 / 3), kLonger = 640;
    const auto pixels = [&](double share) {
        return std::to_string(std::max(1L, std::lround(kLonger * std::min(share, 1.0))));
    };
    return pixels(aspect) + "x" + pixels(1 / aspect);
}

} // namespace eikonal::scene_camera
