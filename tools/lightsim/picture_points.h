// Points of a picture as they come in, and their light as it goes out: EXR on both sides.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "image/exr.h"
#include "lightsim/lightsim.h"

#include <cmath>
#include <string>
#include <vector>

namespace picture_points {

using namespace eikonal;

/// Channels of render's AOVs position and normal, which go on with the light.
inline const std::vector<std::string> kPlaces{"position.X", "position.Y", "position.Z"};
inline const std::vector<std::string> kNormals{"normal.X", "normal.Y", "normal.Z"};

/// Both AOVs of a picture. Throws DataError for a sample that is no number.
inline image::Image read(const std::string& path) {
    std::vector<std::string> channels = kPlaces;
    channels.insert(channels.end(), kNormals.begin(), kNormals.end());
    image::Image picture = image::readExrChannels(path, channels);
    for (size_t c = 0; c < channels.size(); ++c)
        for (size_t i = 0; i < picture.area(); ++i)
            if (!std::isfinite(picture.plane(c)[i])) {
                const size_t width = static_cast<size_t>(picture.width);
                throw DataError(path + ": channel '" + channels[c] +
                                "' is not a finite number in pixel (" + std::to_string(i % width) +
                                ", " + std::to_string(i / width) + ")");
            }
    return picture;
}

inline lightsim::Points pointsOf(const image::Image& picture) {
    lightsim::Points points;
    points.width = picture.width;
    points.places.reserve(picture.area());
    points.normals.reserve(picture.area());
    for (size_t i = 0; i < picture.area(); ++i) {
        const auto at = [&](size_t channel) { return picture.plane(channel)[i]; };
        points.places.emplace_back(at(0), at(1), at(2));
        points.normals.emplace_back(at(3), at(4), at(5));
    }
    return points;
}

/// The layers irradiance and irradiance_direction, of lights apart irradiance_NAME and so on beside
/// them, and the points. `lights` is empty where no point is on a surface.
inline image::Image lightOf(const image::Image& points, const std::vector<std::string>& apart,
                            const std::vector<std::vector<lightsim::LightAtPoint>>& lights) {
    image::Image out(points.width, points.height);
    const auto add = [&](const std::string& suffix,
                         const std::vector<lightsim::LightAtPoint>& light) {
        std::vector<float> colours, directions;
        for (size_t i = 0; i < points.area(); ++i)
            for (int c = 0; c < 3; ++c) {
                colours.push_back(light.empty() ? 0 : light[i].irradiance[c]);
                directions.push_back(light.empty() ? 0 : light[i].flow[c]);
            }
        const auto layer = [&](const char* name, const char* components) {
            std::vector<std::string> channels;
            for (const char* c = components; *c != 0; ++c)
                channels.push_back(name + suffix + "." + *c);
            return channels;
        };
        out.addChannels(layer("irradiance", "RGB"), colours, 3);
        out.addChannels(layer("irradiance_direction", "XYZ"), directions, 3);
    };
    std::vector<lightsim::LightAtPoint> sum;
    for (const auto& light : lights) {
        sum.resize(light.size());
        for (size_t i = 0; i < light.size(); ++i) {
            sum[i].irradiance += light[i].irradiance;
            sum[i].flow += light[i].flow;
        }
    }
    add("", sum);
    for (size_t k = 0; k < apart.size(); ++k)
        add("_" + apart[k], lights.empty() ? std::vector<lightsim::LightAtPoint>() : lights[k]);
    for (size_t c = 0; c < points.channels.size(); ++c)
        out.addChannels({points.channels[c]}, points.plane(c), 1);
    return out;
}

} // namespace picture_points
