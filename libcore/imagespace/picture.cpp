// Pictures of what the device has made of each pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/picture.h"

#include "camera/aovs.h"
#include "camera/pattern.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace eikonal::imagespace {

namespace {

using glm::dvec3;

struct Frame {
    dvec3 eye;
    camera::CameraAxes axes;
    glm::dmat3 worldFromCamera;
    camera::Eye rays;
    glm::dvec2 place; ///< where in its pixel a ray goes whose path is kept
    size_t width;

    explicit Frame(const Params& params)
        : eye(params.camera.eye), axes(camera::axesOf(params.camera)),
          worldFromCamera(axes.right, axes.up, axes.forward), rays(params.camera),
          place(camera::samplePattern(params.samples).front()),
          width(static_cast<size_t>(params.camera.width)) {}

    dvec3 beganAt(size_t pixel) const {
        return rays.rayThrough(glm::dvec2(pixel % width, pixel / width) + place).direction;
    }
    dvec3 placeOf(const SurfacePath& path) const {
        return eye + worldFromCamera * dvec3(path.place);
    }
};

bool isOnPlate(const SurfacePath& path) {
    return path.outward.w == 2;
}

/// A picture that goes beside the colour: its channels, and a pixel's values. They mean what the
/// volume method's do, its domain being the bodies.
struct Aov {
    const char* name;
    const char* components; ///< "" for Z alone, whose name every reader knows
    dvec3 (*valueOf)(const SurfacePath&, const Frame&, size_t pixel);
};

constexpr Aov kAovTable[] = {
    {"exit_position", "XYZ",
     [](const SurfacePath& path, const Frame& frame, size_t) { return frame.placeOf(path); }},
    {"exit_direction", "XYZ",
     [](const SurfacePath& path, const Frame& frame, size_t) {
         return glm::normalize(frame.worldFromCamera * dvec3(path.direction));
     }},
    {"deflection", "XY",
     [](const SurfacePath& path, const Frame& frame, size_t pixel) {
         return dvec3(
             camera::deflectionOf(frame.axes, frame.beganAt(pixel),
                                  glm::normalize(frame.worldFromCamera * dvec3(path.direction))),
             0);
     }},
    {"transmittance", "RGB",
     [](const SurfacePath& path, const Frame&, size_t) { return dvec3(path.through); }},
    {"optical_path_length", "V",
     [](const SurfacePath& path, const Frame&, size_t) { return dvec3(path.place.w); }},
    {"path_length", "V",
     [](const SurfacePath& path, const Frame&, size_t) { return dvec3(path.direction.w); }},
    {"steps", "V",
     [](const SurfacePath& path, const Frame&, size_t) { return dvec3(path.through.w); }},
    {"Z", "", [](const SurfacePath& path, const Frame&, size_t) { return dvec3(path.place.z); }},
    {"position", "XYZ",
     [](const SurfacePath& path, const Frame& frame, size_t) {
         return isOnPlate(path) ? frame.placeOf(path) : dvec3(0);
     }},
    {"normal", "XYZ",
     [](const SurfacePath& path, const Frame& frame, size_t) {
         return isOnPlate(path) ? frame.worldFromCamera * dvec3(path.outward) : dvec3(0);
     }},
};

} // namespace

const std::vector<std::string>& allAovs() {
    static const std::vector<std::string> kNames = camera::namesOf(kAovTable);
    return kNames;
}

bool wantsPaths(const Params& params) {
    return !params.aovs.empty() || params.isColoured();
}

image::Image assemble(const Params& params, std::span<const vec4> colours,
                      std::span<const vec4> paths) {
    image::Image picture(params.camera.width, params.camera.rows);
    picture.addChannels({"R", "G", "B", "A"},
                        {reinterpret_cast<const float*>(colours.data()), colours.size() * 4}, 4);
    const Frame frame(params);
    const size_t pixels = paths.size() / 4;
    const auto pathOf = [&](size_t pixel) {
        return SurfacePath{paths[pixel], paths[pixels + pixel], paths[2 * pixels + pixel],
                           paths[3 * pixels + pixel]};
    };
    if (params.isColoured())
        camera::addChannels(picture, {"AR", "AG", "AB"},
                            [&](size_t pixel) { return 1.0 - dvec3(pathOf(pixel).through); });
    for (const std::string& name : params.aovs)
        for (const Aov& aov : kAovTable)
            if (name == aov.name)
                camera::addChannels(
                    picture, camera::channelsOf(aov.name, aov.components),
                    [&](size_t pixel) { return aov.valueOf(pathOf(pixel), frame, pixel); });
    return picture;
}

} // namespace eikonal::imagespace
