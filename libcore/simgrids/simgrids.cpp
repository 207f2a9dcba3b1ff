// A simulation's grids made into those of the contract.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simgrids/simgrids.h"

#include "base/error.h"
#include "base/text.h"
#include "optics/air.h"
#include "optics/spectrum.h"
#include "volume/contract.h"

#include <algorithm>
#include <cmath>

namespace eikonal::simgrids {

namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The first of a grid's names that the file has, else its own.
std::string nameIn(const Names& found, const std::string& grid) {
    for (const std::string& name : namesOf(grid))
        if (holds(found, name)) return name;
    return grid;
}

/// What a file of smoke says without an option, as far as it has the grids.
std::vector<Map> defaultMaps(const Names& found) {
    std::vector<Map> maps;
    const auto add = [&](const char* to, const std::string& from) {
        Map map;
        map.to = to;
        map.from = from;
        maps.push_back(map);
    };
    if (holds(found, "density")) add("scattering", "density");
    // Houdini's older fires have heat beside a temperature; where it is alone it is one.
    const std::string flame = nameIn(found, "flame");
    if (holds(found, flame))
        add("emission", flame);
    else if (holds(found, "temperature") && holds(found, "heat"))
        add("emission", "heat");
    return maps;
}

/// So that every grid is made of what the file held, though another replaces it. Throws UsageError
/// where there is no such order.
std::vector<Map> inOrder(std::vector<Map> maps) {
    std::vector<Map> order;
    while (!maps.empty()) {
        // Next is one whose target no other that is left reads.
        const auto next = std::find_if(maps.begin(), maps.end(), [&](const Map& map) {
            return std::none_of(maps.begin(), maps.end(), [&](const Map& other) {
                return other.to != map.to && other.from == map.to;
            });
        });
        if (next == maps.end())
            throw UsageError("--" + maps.front().to +
                             "-from: found grids made of one another, "
                             "expected an order to make them in");
        order.push_back(*next);
        maps.erase(next);
    }
    return order;
}

volume::Law lawOf(const Map& map, const Params& params) {
    volume::Law law;
    // An index holds a contrast of 1e-6 only in double.
    law.inDouble = map.to == "ior";
    switch (map.kind) {
    case Kind::gladstoneDale:
        law.value = [k = map.constant](double density, int) { return 1 + k * density; };
        break;
    case Kind::air: {
        const double scale = params.kelvinScale, offset = params.kelvinOffset;
        law.value = [=, pressure = map.pressure](double value, int) {
            return 1 + optics::airRefractivity(scale * value + offset, pressure,
                                               optics::kReferenceWavelength);
        };
        law.above = 0 - offset / scale;
        law.wanted = "above " + toText(static_cast<float>(law.above)) +
                     ", which is 0 K (--kelvin tells the unit, --ambient what surrounds it)";
        if (params.ambient) law.outside = (*params.ambient - offset) / scale;
        break;
    }
    case Kind::linear:
        law.value = [scale = map.scale, offset = map.offset](double value, int c) {
            return scale[c] * value + offset[c];
        };
        law.vector = map.scale != glm::dvec3(map.scale.x) || map.offset != glm::dvec3(map.offset.x);
        break;
    }
    return law;
}

} // namespace

void Params::check() const {
    requireOption(kelvinScale > 0 && std::isfinite(kelvinScale), "--kelvin", toText(kelvinScale),
                  "a SCALE above 0");
    if (ambient)
        requireOption(*ambient > 0 && std::isfinite(*ambient), "--ambient", toText(*ambient),
                      "a temperature above 0 K");
    const bool needed =
        std::any_of(maps.begin(), maps.end(), [](const Map& map) { return map.kind == Kind::air; });
    if (!needed && ambient) throw UsageError("--ambient: is for --ior-from GRID:air alone");
    if (!needed && (kelvinScale != 1 || kelvinOffset != 0))
        throw UsageError("--kelvin: is for --ior-from GRID:air alone");
}

std::vector<std::string> namesOf(const std::string& grid) {
    static const std::vector<Names> kSame = {
        {"temperature", "heat"}, {"flame", "flames", "burn"}, {"vel", "velocity"}};
    for (const Names& names : kSame)
        if (names.front() == grid) return names;
    return {grid};
}

Plan makePlan(const std::string& path, const Params& params) {
    std::vector<Map> maps;
    const auto choose = [&](const Names& found) {
        maps = params.maps.empty() ? defaultMaps(found) : params.maps;
        volume::GridNames names;
        for (Map& map : maps) {
            map.from = nameIn(found, map.from);
            names.emplace(map.from, map.from); // part of the scene, whatever it is called
        }
        return names;
    };
    Plan plan{volume::Volume::open(path, choose), {}, {}};
    plan.maps = inOrder(maps);
    if (maps.empty()) {
        Names found;
        for (const volume::GridFacts& grid : plan.volume.grids()) found.push_back(grid.name);
        std::sort(found.begin(), found.end());
        throw DataError(plan.volume.path() + ": no grid 'density' or 'flame' (found: " +
                        join(found, ", ") + "), expected one, or --ior-from and its like");
    }
    for (const std::string& to : targets()) {
        const auto map =
            std::find_if(maps.begin(), maps.end(), [&](const Map& one) { return one.to == to; });
        if (map == maps.end())
            plan.effects.push_back({to, false, "not asked for"});
        else
            plan.effects.push_back({to, true, map->text() + " of grid '" + map->from + "'"});
    }
    return plan;
}

std::vector<std::string> run(Plan& plan, const Params& params, Stats& stats) {
    std::vector<std::string> warnings;
    const auto warn = [&](const Map& map, std::int64_t voxels, const char* side, float end) {
        if (voxels == 0) return;
        warnings.push_back("'" + map.to + "' would be " + side + " " + toText(end) + " in " +
                           std::to_string(voxels) + (voxels == 1 ? " voxel" : " voxels") +
                           ": it is " + toText(end) + " there");
        stats.count("voxels_cut", static_cast<double>(voxels));
    };
    for (const Map& map : plan.maps) {
        const volume::GridRule& rule = *volume::ruleFor(map.to);
        const volume::Cut cut = plan.volume.derive(map.from, map.to, lawOf(map, params));
        warn(map, cut.below, "below", rule.least);
        warn(map, cut.above, "above", rule.most);
        stats.count("grids", 1);
    }
    return warnings;
}

} // namespace eikonal::simgrids
