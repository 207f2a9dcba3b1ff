// Pictures of what the device has made of each pixel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/picture.h"

#include "camera/aovs.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace eikonal::imagespace {

namespace {

using glm::dvec3;

struct Frame {
    dvec3 eye;
    glm::dmat3 worldFromCamera;

    explicit Frame(const camera::Camera& camera) : eye(camera.eye) {
        const camera::CameraAxes axes = camera::axesOf(camera);
        worldFromCamera = glm::dmat3(axes.right, axes.up, axes.forward);
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
    dvec3 (*valueOf)(const SurfacePath&, const Frame&);
};

constexpr Aov kAovTable[] = {
    {"exit_position", "XYZ",
     [](const SurfacePath& path, const Frame& frame) { return frame.placeOf(path); }},
    {"exit_direction", "XYZ",
     [](const SurfacePath& path, const Frame& frame) {
         return glm::normalize(frame.worldFromCamera * dvec3(path.direction));
     }},
    {"transmittance", "RGB",
     [](const SurfacePath& path, const Frame&) { return dvec3(path.through); }},
    {"optical_path_length", "V",
     [](const SurfacePath& path, const Frame&) { return dvec3(path.place.w); }},
    {"path_length", "V",
     [](const SurfacePath& path, const Frame&) { return dvec3(path.direction.w); }},
    {"steps", "V", [](const SurfacePath& path, const Frame&) { return dvec3(path.through.w); }},
    {"Z", "", [](const SurfacePath& path, const Frame&) { return dvec3(path.place.z); }},
    {"position", "XYZ",
     [](const SurfacePath& path, const Frame& frame) {
         return isOnPlate(path) ? frame.placeOf(path) : dvec3(0);
     }},
    {"normal", "XYZ",
     [](const SurfacePath& path, const Frame& frame) {
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
    const Frame frame(params.camera);
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
                    [&](size_t pixel) { return aov.valueOf(pathOf(pixel), frame); });
    return picture;
}

} // namespace eikonal::imagespace
