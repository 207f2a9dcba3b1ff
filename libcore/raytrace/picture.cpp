// A traced picture in the making.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/picture.h"

#include "camera/aovs.h"

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

} // namespace

const std::vector<std::string>& allAovs() {
    static const std::vector<std::string> kNames = camera::namesOf(kAovTable);
    return kNames;
}

image::Image assemble(const Pixels& pixels, const Params& params, bool coloured) {
    image::Image picture(params.camera.width, params.camera.rows);
    picture.addChannels(
        {"R", "G", "B", "A"},
        {reinterpret_cast<const float*>(pixels.colours.data()), pixels.colours.size() * 4}, 4);
    if (coloured)
        camera::addChannels(picture, {"AR", "AG", "AB"},
                            [&](size_t pixel) { return 1.0 - pixels.paths[pixel].through; });
    for (const std::string& name : params.aovs)
        for (const Aov& aov : kAovTable)
            if (name == aov.name)
                camera::addChannels(
                    picture, camera::channelsOf(aov.name, aov.components),
                    [&](size_t pixel) { return aov.valueOf(pixels.paths[pixel], params.camera); });
    return picture;
}

} // namespace eikonal::raytrace
