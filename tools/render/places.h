// Where render's volumes lie: those on one transform are one scene, others have places of their
// own. SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "scene/files.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace eikonal::places {

/// A volume that is moved.
struct Place {
    std::string path;
    glm::dmat4 worldFromFile{1};
};

/// "FILE:TX,TY,TZ[:RX,RY,RZ[:S]]": turned by degrees about X, then Y, then Z of the file's own
/// world, scaled, shifted. Throws UsageError.
inline Place parse(const std::string& text) {
    const auto fail = [&](const std::string& wanted) {
        return UsageError("--place: found '" + text + "', expected " + wanted);
    };
    // From behind: a file's name may have colons.
    std::vector<std::string> parts = split(text, ':');
    std::vector<std::vector<double>> numbers;
    while (parts.size() > 1 && numbers.size() < 3) {
        const auto found = parseNumbers(parts.back());
        if (!found) break;
        numbers.insert(numbers.begin(), *found);
        parts.pop_back();
    }
    const auto isVector = [&](size_t i) { return numbers.size() > i && numbers[i].size() == 3; };
    const std::string form = "FILE:TX,TY,TZ[:RX,RY,RZ[:S]]";
    if (!isVector(0) || (numbers.size() > 1 && !isVector(1)) ||
        (numbers.size() > 2 && numbers[2].size() != 1))
        throw fail(form);
    const double scale = numbers.size() > 2 ? numbers[2][0] : 1;
    if (!(scale >= 1e-6 && scale <= 1e6)) throw fail(form + ", S from 1e-6 to 1e6");
    const auto vector = [&](size_t i) {
        return numbers.size() > i ? glm::dvec3(numbers[i][0], numbers[i][1], numbers[i][2])
                                  : glm::dvec3(0);
    };
    glm::dmat4 moved = glm::translate(glm::dmat4(1), vector(0));
    for (int axis = 2; axis >= 0; --axis) {
        glm::dvec3 about(0);
        about[axis] = 1;
        moved = glm::rotate(moved, glm::radians(vector(1)[axis]), about);
    }
    return {join(parts, ":"), glm::scale(moved, glm::dvec3(scale))};
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
