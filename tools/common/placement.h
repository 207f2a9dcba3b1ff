// How --place and its like put things where they belong: TX,TY,TZ[:RX,RY,RZ[:S]].
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

namespace eikonal::tool {

/// What is placed, and where it goes.
struct Placement {
    std::string name; ///< what stands before the numbers; empty where nothing may
    glm::dmat4 worldFromOwn{1};
};

/// "TX,TY,TZ[:RX,RY,RZ[:S]]", behind "FILE:" where `named`: turned by degrees about X, then Y, then
/// Z of its own world, scaled, shifted. Throws UsageError naming the option.
inline Placement parsePlacement(const std::string& text, bool named,
                                const std::string& option = "--place") {
    const std::string form = std::string(named ? "FILE:" : "") + "TX,TY,TZ[:RX,RY,RZ[:S]]";
    const auto fail = [&](const std::string& wanted) {
        return UsageError(option + ": found '" + text + "', expected " + wanted);
    };
    // From behind: a file's name may have colons.
    std::vector<std::string> parts = split(text, ':');
    std::vector<std::vector<double>> numbers;
    while (parts.size() > (named ? 1 : 0) && numbers.size() < 3) {
        const auto found = parseNumbers(parts.back());
        if (!found) break;
        numbers.insert(numbers.begin(), *found);
        parts.pop_back();
    }
    const auto isVector = [&](size_t i) { return numbers.size() > i && numbers[i].size() == 3; };
    if (!isVector(0) || (numbers.size() > 1 && !isVector(1)) || (!named && !parts.empty()) ||
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

} // namespace eikonal::tool
