// The lights that a file was lit by, recorded for what lies beyond its domain.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/recorded_lights.h"

#include "base/error.h"
#include "base/text.h"

#include <optional>

namespace eikonal::scene {

namespace {

const std::string kUpward = "upward:";

/// The numbers of an environment's line; nothing if it is another light's.
std::optional<glm::dvec3> upwardOf(const std::string& line) {
    const size_t at = line.find(kUpward);
    if (at == std::string::npos || (at > 0 && line[at - 1] != '=')) return {};
    const auto rgb = parseNumbers(line.substr(at + kUpward.size()));
    if (!rgb || rgb->size() != 3) return {};
    return glm::dvec3((*rgb)[0], (*rgb)[1], (*rgb)[2]);
}

void addLine(RecordedLights& recorded, const std::string& line, const std::string& path) {
    if (const auto upward = upwardOf(line)) {
        recorded.upward += *upward;
        return;
    }
    const auto refuse = [&] {
        return DataError(path + ": metadata '" + kLightsKey + "' hold '" + line +
                         "', expected a light or NAME=upward:R,G,B on every line");
    };
    try {
        recorded.lights.push_back(parseLight(line));
    } catch (const UsageError&) {
        throw refuse();
    }
    if (recorded.lights.back().kind == Light::Kind::environment) throw refuse();
}

} // namespace

std::string recordOf(const Light& light, const glm::dvec3& upward) {
    if (light.kind != Light::Kind::environment) return light.spec;
    return light.name + "=" + kUpward + toText(upward.x) + "," + toText(upward.y) + "," +
           toText(upward.z);
}

RecordedLights recordedLights(const Files& files) {
    RecordedLights recorded;
    for (const volume::Volume* volume : files.all()) {
        const std::string text = volume->metadata(kLightsKey);
        if (text.empty()) continue;
        for (const std::string& line : split(text, '\n')) addLine(recorded, line, volume->path());
    }
    return recorded;
}

} // namespace eikonal::scene
