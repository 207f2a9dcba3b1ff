// The lights of a scene file, as --light has them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "common/session.h"
#include "scenefile/gltf.h"

#include <string>
#include <vector>

namespace eikonal::scene_lights {

/// "NAME=KIND:...", whose numbers read back as they are.
inline std::string specOf(const scenefile::Light& light) {
    const auto three = [](const glm::dvec3& v) {
        return toText(v.x) + "," + toText(v.y) + "," + toText(v.z);
    };
    std::string spec = light.name + "=";
    switch (light.kind) {
    case scenefile::Light::Kind::directional:
        spec += "directional:" + three(light.direction);
        break;
    case scenefile::Light::Kind::point:
        spec += "point:" + three(light.place);
        break;
    case scenefile::Light::Kind::spot:
        spec += "spot:" + three(light.place) + ":" + three(light.direction) + ":" +
                toText(light.angle) + ":" + toText(light.soft);
        break;
    }
    return spec + ":" + three(light.rgb);
}

/// The lights of a glTF file. Throws DataError where it has none.
inline std::vector<std::string> read(tool::Session& session, const std::string& path) {
    const std::string bytes = readWhole(path);
    if (!scenefile::isGltf(path, bytes))
        throw DataError(path + ": is no glTF file, expected .glb or .gltf for --lights");
    const scenefile::Lights found = scenefile::readGltfLights(path, bytes);
    if (found.lights.empty())
        throw DataError(path + ": its scene has no lights, expected some of KHR_lights_punctual");
    if (!found.unknown.empty())
        session.warn(path + ": of lights not understood: " + join(found.unknown, ", "));
    std::vector<std::string> specs;
    for (const scenefile::Light& light : found.lights) specs.push_back(specOf(light));
    return specs;
}

} // namespace eikonal::scene_lights
