// Where render's volumes lie: on one transform they are one scene, others have their own places.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/placement.h"
#include "scene/files.h"

#include <algorithm>
#include <string>
#include <vector>

namespace eikonal::places {

/// A volume that is moved.
struct Place {
    std::string path;
    glm::dmat4 worldFromFile{1};
};

/// "FILE:TX,TY,TZ[:RX,RY,RZ[:S]]". Throws UsageError.
inline Place parse(const std::string& text) {
    const tool::Placement placement = tool::parsePlacement(text, true);
    return {placement.name, placement.worldFromOwn};
}

/// The volumes to open: those of --place, once each, and the inputs that none of them names.
inline std::vector<Place> all(const std::vector<std::string>& inputs,
                              const std::vector<Place>& places) {
    std::vector<Place> found;
    for (const std::string& input : inputs)
        if (std::none_of(places.begin(), places.end(),
                         [&](const Place& place) { return place.path == input; }))
            found.push_back({input});
    found.insert(found.end(), places.begin(), places.end());
    return found;
}

/// Those on one transform that are not moved are one scene, lit by all of them.
inline std::vector<scene::Files> grouped(const std::vector<Place>& places,
                                         const volume::GridNames& names) {
    std::vector<std::vector<volume::Volume>> groups;
    std::vector<const Place*> firsts;
    for (const Place& place : places) {
        volume::Volume volume = volume::Volume::open(place.path, names);
        const bool moved = place.worldFromFile != glm::dmat4(1);
        size_t group = groups.size();
        for (size_t i = 0; i < groups.size() && !moved; ++i)
            if (firsts[i]->worldFromFile == glm::dmat4(1) &&
                scene::areOnOneTransform(groups[i].front(), volume))
                group = i;
        if (group == groups.size()) {
            groups.emplace_back();
            firsts.push_back(&place);
        }
        groups[group].push_back(std::move(volume));
    }
    std::vector<scene::Files> files;
    for (size_t i = 0; i < groups.size(); ++i) {
        files.emplace_back(std::move(groups[i]));
        files.back().place(firsts[i]->worldFromFile);
    }
    return files;
}

} // namespace eikonal::places
