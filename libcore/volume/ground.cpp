// The ground of a scene, an infinite plane, as a file's metadata tell of it.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/ground.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>

namespace eikonal::volume {

namespace {

/// The numbers of a text, or nothing.
std::optional<Ground> parse(const std::string& text) {
    const std::vector<std::string> parts = split(text, ' ');
    if (parts.size() != 3) return {};
    const auto y = parseNumber(parts[0]), square = parseNumber(parts[2]);
    const auto albedo = parseNumbers(parts[1]);
    if (!y || !square || !albedo || albedo->size() != 3) return {};
    return Ground{*y, {(*albedo)[0], (*albedo)[1], (*albedo)[2]}, *square};
}

} // namespace

std::string faultOf(const Ground& ground) {
    for (int c = 0; c < 3; ++c)
        if (!(ground.albedo[c] >= 0 && ground.albedo[c] <= 1)) return "an albedo beyond 0 to 1";
    if (!(std::abs(ground.y) <= kFarthestGround)) return "a height beyond 1e12";
    if (!(ground.square >= 0 && ground.square <= kFarthestGround))
        return "squares beyond 0 to 1e12";
    return "";
}

std::string textOf(const Ground& ground) {
    const glm::dvec3& a = ground.albedo;
    return toText(ground.y) + " " + toText(a.x) + "," + toText(a.y) + "," + toText(a.z) + " " +
           toText(ground.square);
}

std::optional<Ground> groundOf(const Volume& volume) {
    const std::string text = volume.metadata(kGroundKey);
    if (text.empty()) return {};
    const std::optional<Ground> ground = parse(text);
    const std::string fault = ground ? faultOf(*ground) : "";
    if (!ground || !fault.empty())
        throw DataError(volume.path() + ": metadata '" + kGroundKey + "' are '" + text + "'" +
                        (fault.empty() ? "" : " (" + fault + ")") + ", expected Y R,G,B SIZE");
    return ground;
}

} // namespace eikonal::volume
