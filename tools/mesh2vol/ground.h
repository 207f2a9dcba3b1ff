// mesh2vol's options of the ground.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "common/command_line.h"
#include "volume/ground.h"

#include <optional>
#include <string>

namespace eikonal::mesh2vol {

struct GroundOptions {
    std::string ground; ///< as given; empty: none
    std::optional<double> margin;
};

inline void addGroundOptions(CLI::App& app, GroundOptions& o) {
    const std::string group = "Ground";
    app.add_option("--ground", o.ground,
                   "the plane y = Y, opaque below and without an end, as an object 'ground' within "
                   "the domain and, for lightsim and render, beyond it; its albedo (default 0.5), "
                   "and the edge of a checker's squares, every other of which has half the albedo "
                   "[unit]")
        ->type_name("Y[:R,G,B[:checker SIZE]]")
        ->group(group);
    app.add_option("--ground-margin", o.margin,
                   "how far the domain goes on beside the objects, for shadows and caustics on the "
                   "ground; default: as far as they extend sideways [unit]")
        ->type_name("S")
        ->group(group);
}

/// Throws UsageError where the text is no ground.
inline std::optional<volume::Ground> groundOf(const GroundOptions& o) {
    if (o.ground.empty()) return {};
    const UsageError bad("--ground: found '" + o.ground +
                         "', expected Y[:R,G,B[:checker SIZE]], an albedo of 0 to 1 and a SIZE "
                         "above 0");
    const std::vector<std::string> parts = split(o.ground, ':');
    if (parts.size() > 3) throw bad;
    volume::Ground ground;
    const auto y = parseNumber(parts[0]);
    if (!y) throw bad;
    ground.y = *y;
    if (parts.size() > 1) {
        const auto albedo = parseNumbers(parts[1]);
        if (!albedo || (albedo->size() != 1 && albedo->size() != 3)) throw bad;
        const size_t last = albedo->size() - 1;
        ground.albedo = {(*albedo)[0], (*albedo)[last / 2], (*albedo)[last]};
    }
    if (parts.size() > 2) {
        const std::string word = "checker ";
        const auto square =
            parts[2].starts_with(word) ? parseNumber(parts[2].substr(word.size())) : std::nullopt;
        if (!square || !(*square > 0)) throw bad;
        ground.square = *square;
    }
    if (!volume::faultOf(ground).empty()) throw bad;
    return ground;
}

/// For --explain.
inline std::string groundText(const volume::Ground& ground) {
    const glm::dvec3& a = ground.albedo;
    std::string text = "y = " + toText(ground.y) + ", albedo " + toText(a.x) + "," + toText(a.y) +
                       "," + toText(a.z);
    if (ground.square > 0) text += ", checker of " + toText(ground.square);
    return text;
}

} // namespace eikonal::mesh2vol
