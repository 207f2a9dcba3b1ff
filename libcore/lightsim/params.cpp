// What the light stage is asked to do.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/params.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace eikonal::lightsim {

namespace {

void require(bool holds, const std::string& option, double found, const std::string& wanted) {
    if (!holds) throw UsageError(option + ": found " + toText(found) + ", expected " + wanted);
}

} // namespace

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

std::int64_t photonCount(double number) {
    const double kMostPhotons = 1099511627776.0; // 2^40: weeks of work on any device
    require(number >= 1 && number <= kMostPhotons && number == std::floor(number), "--photons",
            number, "a whole number from 1 to 2^40");
    return static_cast<std::int64_t>(number);
}

void Params::check() const {
    if (lights.empty()) throw UsageError("--light: none given, expected at least one");
    photonCount(static_cast<double>(photons));
    tracing.check("--tolerance");
    require(octreeTolerance >= 0, "--octree-tolerance", octreeTolerance, "0 or more");
    require(octreeTolerance2 >= octreeTolerance, "--octree-tolerance2", octreeTolerance2,
            "at least --octree-tolerance (" + toText(octreeTolerance) + ")");
    require(stepLimit > 0, "--step-limit", stepLimit, "above 0");
    require(stepMin >= 0.01 && stepMin <= 1e4, "--step-min", stepMin, "0.01 to 10000");
    require(maxSteps >= 1 && maxSteps <= 1 << 16, "--max-steps", maxSteps, "1 to 65536");
    require(maxDepth >= 0 && maxDepth <= 4096, "--max-depth", maxDepth, "0 to 4096");
    require(dropBelow >= 0 && dropBelow < 1, "--drop-below", dropBelow, "0 to below 1");
    require(thinTo >= 0 && thinTo < 1, "--thin-to", thinTo, "0 to below 1");
    require(smoothing >= 0 && smoothing <= 64, "--smoothing", smoothing, "0 to 64");
}

} // namespace eikonal::lightsim
