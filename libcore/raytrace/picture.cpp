// A traced picture in the making.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "raytrace/picture.h"

#include "camera/aovs.h"
#include "camera/pattern.h"

#include <glm/geometric.hpp>

namespace eikonal::raytrace {

namespace {

using glm::dvec3;

/// A camera, and where its rays begin.
struct View {
    const camera::Camera& camera;
    camera::CameraAxes axes;
    camera::Eye eye;
    glm::dvec2 place; ///< where in its pixel a ray goes whose path is kept

    explicit View(const Params& params)
        : camera(params.camera), axes(camera::axesOf(params.camera)), eye(params.camera),
          place(camera::samplePattern(params.samples).front()) {}
    dvec3 beganAt(size_t pixel) const {
        const auto width = static_cast<size_t>(camera.width);
        return eye.rayThrough(glm::dvec2(pixel % width, pixel / width) + place).direction;
    }
};

/// A picture that goes beside the colour: its channels, and a pixel's values.
struct Aov {
    const char* name;
    const char* components; ///< "" for Z alone, whose name every reader knows
    dvec3 (*valueOf)(const FirstPath&, const View&, size_t pixel);
};

constexpr Aov kAovTable[] = {
    {"exit_position", "XYZ", [](const FirstPath& path, const View&, size_t) { return path.x; }},
    {"exit_direction", "XYZ",
     [](const FirstPath& path, const View&, size_t) { return path.direction; }},
    {"deflection", "XY",
     [](const FirstPath& path, const View& view, size_t pixel) {
         return dvec3(camera::deflectionOf(view.axes, view.beganAt(pixel), path.direction), 0);
     }},
    {"transmittance", "RGB",
     [](const FirstPath& path, const View&, size_t) { return path.through; }},
    {"optical_path_length", "V",
     [](const FirstPath& path, const View&, size_t) { return dvec3(path.opticalLength); }},
    {"path_length", "V",
     [](const FirstPath& path, const View&, size_t) { return dvec3(path.length); }},
    {"Z", "",
     [](const FirstPath& path, const View& view, size_t) {
         return dvec3(glm::dot(path.x - view.camera.eye, view.axes.forward));
     }},
    {"position", "XYZ",
     [](const FirstPath& path, const View&, size_t) {
         return path.normal != dvec3(0) ? path.x : dvec3(0);
     }},
    {"normal", "XYZ", [](const FirstPath& path, const View&, size_t) { return path.normal; }},
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
    const View view(params);
    for (const std::string& name : params.aovs)
        for (const Aov& aov : kAovTable)
            if (name == aov.name)
                camera::addChannels(
                    picture, camera::channelsOf(aov.name, aov.components),
                    [&](size_t pixel) { return aov.valueOf(pixels.paths[pixel], view, pixel); });
    return picture;
}

} // namespace eikonal::raytrace
