// A traced picture in the making.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/picture.h"

#include <glm/geometric.hpp>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

/// A picture that goes beside the colour: its channels, and a pixel's values.
struct Aov {
    const char* name;
    const char* components; ///< "" for Z alone, whose name every reader knows
    dvec3 (*valueOf)(const FirstPath&, const camera::Camera&);
};

constexpr Aov kAovTable[] = {
    {"exit_position", "XYZ", [](const FirstPath& path, const camera::Camera&) { return path.x; }},
    {"exit_direction", "XYZ",
     [](const FirstPath& path, const camera::Camera&) { return path.direction; }},
    {"transmittance", "RGB",
     [](const FirstPath& path, const camera::Camera&) { return path.through; }},
    {"optical_path_length", "V",
     [](const FirstPath& path, const camera::Camera&) { return dvec3(path.opticalLength); }},
    {"path_length", "V",
     [](const FirstPath& path, const camera::Camera&) { return dvec3(path.length); }},
    {"Z", "",
     [](const FirstPath& path, const camera::Camera& camera) {
         return dvec3(glm::dot(path.x - camera.eye, camera::axesOf(camera).forward));
     }},
    {"position", "XYZ",
     [](const FirstPath& path, const camera::Camera&) {
         return path.normal != dvec3(0) ? path.x : dvec3(0);
     }},
    {"normal", "XYZ", [](const FirstPath& path, const camera::Camera&) { return path.normal; }},
};

std::vector<std::string> channelsOf(const Aov& aov) {
    if (aov.components[0] == 0) return {aov.name};
    std::vector<std::string> channels;
    for (const char* c = aov.components; *c; ++c)
        channels.push_back(std::string(aov.name) + "." + *c);
    return channels;
}

} // namespace

const std::vector<std::string>& allAovs() {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names;
        for (const Aov& aov : kAovTable) names.emplace_back(aov.name);
        return names;
    }();
    return kNames;
}

image::Image assemble(const Pixels& pixels, const Params& params, bool coloured) {
    image::Image picture(params.camera.width, params.camera.rows);
    picture.addChannels(
        {"R", "G", "B", "A"},
        {reinterpret_cast<const float*>(pixels.colours.data()), pixels.colours.size() * 4}, 4);
    const auto add = [&](const std::vector<std::string>& channels, const auto& valueOf) {
        std::vector<float> samples;
        samples.reserve(pixels.paths.size() * channels.size());
        for (const FirstPath& path : pixels.paths) {
            const dvec3 value = valueOf(path);
            for (int c = 0; c < static_cast<int>(channels.size()); ++c)
                samples.push_back(static_cast<float>(value[c]));
        }
        picture.addChannels(channels, samples, channels.size());
    };
    if (coloured) add({"AR", "AG", "AB"}, [](const FirstPath& path) { return 1.0 - path.through; });
    for (const std::string& name : params.aovs)
        for (const Aov& aov : kAovTable)
            if (name == aov.name)
                add(channelsOf(aov),
                    [&](const FirstPath& path) { return aov.valueOf(path, params.camera); });
    return picture;
}

} // namespace eikonal::raytrace
