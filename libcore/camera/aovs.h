// Pictures beside the colour (AOVs), as every way of making pictures adds them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "image/image.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::camera {

/// EXR channels of a picture of that name: one for each component, "NAME.X"; the name alone where
/// there are no components, as of Z, whose name every reader knows.
inline std::vector<std::string> channelsOf(const std::string& name, const std::string& components) {
    if (components.empty()) return {name};
    std::vector<std::string> channels;
    for (const char c : components) channels.push_back(name + "." + c);
    return channels;
}

/// The names in a table of AOVs.
template<typename Table> std::vector<std::string> namesOf(const Table& table) {
    std::vector<std::string> names;
    for (const auto& aov : table) names.emplace_back(aov.name);
    return names;
}

/// Adds channels, three at most, of `valueOf(pixel)`; pixels are counted row by row from the top.
template<typename ValueOf>
void addChannels(image::Image& picture, const std::vector<std::string>& channels,
                 const ValueOf& valueOf) {
    std::vector<float> samples;
    samples.reserve(picture.area() * channels.size());
    for (size_t pixel = 0; pixel < picture.area(); ++pixel) {
        const glm::dvec3 value = valueOf(pixel);
        for (int c = 0; c < static_cast<int>(channels.size()); ++c)
            samples.push_back(static_cast<float>(value[c]));
    }
    picture.addChannels(channels, samples, channels.size());
}

} // namespace eikonal::camera
