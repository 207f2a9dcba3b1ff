// The lights of a scene.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/lights.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::lightsim {

Light parseLight(const std::string& spec) {
    const std::string wanted = "directional:DX,DY,DZ[:R,G,B] or point:X,Y,Z[:R,G,B]";
    const auto bad = [&](const std::string& why) {
        return UsageError("--light: found '" + spec + "' (" + why + "), expected " + wanted);
    };
    const std::vector<std::string> parts = split(spec, ':');
    Light light;
    if (parts[0] == "directional")
        light.kind = Light::Kind::directional;
    else if (parts[0] == "point")
        light.kind = Light::Kind::point;
    else
        throw bad("no such kind of light");
    if (parts.size() < 2 || parts.size() > 3) throw bad("wrong number of parts");
    const auto vector = parseNumbers(parts[1]);
    if (!vector || vector->size() != 3) throw bad("no three numbers");
    light.vector = {(*vector)[0], (*vector)[1], (*vector)[2]};
    if (light.kind == Light::Kind::directional) {
        const double length = glm::length(light.vector);
        if (!(length > 0) || !std::isfinite(length)) throw bad("the direction has no length");
        light.vector /= length;
    }
    if (parts.size() == 3) {
        const auto rgb = parseNumbers(parts[2]);
        if (!rgb || (rgb->size() != 3 && rgb->size() != 1)) throw bad("no three numbers");
        const size_t last = rgb->size() - 1;
        light.rgb = {(*rgb)[0], (*rgb)[last / 2], (*rgb)[last]};
        if (light.rgb.x < 0 || light.rgb.y < 0 || light.rgb.z < 0) throw bad("a colour below 0");
    }
    return light;
}

Light inVoxels(const Light& light, const glm::dmat4& voxelFromWorld) {
    Light out = light;
    const bool point = light.kind == Light::Kind::point;
    out.vector = glm::dvec3(voxelFromWorld * glm::dvec4(light.vector, point ? 1.0 : 0.0));
    if (!point) out.vector = glm::normalize(out.vector);
    return out;
}

} // namespace eikonal::lightsim
