// The frames of --frames, and their files' names.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace eikonal {

/// "A-B" or "A-B/STEP", whole numbers from 0 on; "A" is one frame. Throws UsageError.
inline std::vector<int> parseFrames(const std::string& text) {
    const auto fail = [&](const std::string& wanted) {
        return UsageError("--frames: found '" + text + "', expected " + wanted);
    };
    const auto whole = [&](const std::string& part) {
        const auto number = parseNumber(part);
        if (!number || *number < 0 || *number > 1e9 || *number != static_cast<int>(*number))
            throw fail("A-B or A-B/STEP in whole numbers from 0 to 1e9");
        return static_cast<int>(*number);
    };
    const std::vector<std::string> parts = split(text, '/');
    const std::vector<std::string> ends = split(parts[0], '-');
    if (parts.size() > 2 || ends.size() > 2) throw fail("A-B or A-B/STEP");
    const int first = whole(ends.front()), last = whole(ends.back());
    const int step = parts.size() > 1 ? whole(parts[1]) : 1;
    if (step < 1) throw fail("a STEP from 1 on");
    if (last < first) throw fail("B not before A");
    if ((last - first) / step >= 100000) throw fail("100000 frames at most");
    std::vector<int> frames;
    for (long long frame = first; frame <= last; frame += step)
        frames.push_back(static_cast<int>(frame));
    return frames;
}

/// The name with its last run of # made the frame's number, with so many digits at least.
inline std::string atFrame(const std::string& name, int frame) {
    const size_t last = name.find_last_of('#');
    if (last == std::string::npos) return name;
    size_t first = last;
    while (first > 0 && name[first - 1] == '#') --first;
    std::string number = std::to_string(frame);
    const size_t digits = last - first + 1;
    if (number.size() < digits) number.insert(0, digits - number.size(), '0');
    return name.substr(0, first) + number + name.substr(last + 1);
}

inline bool hasFrames(const std::string& name) {
    return name.find('#') != std::string::npos;
}

} // namespace eikonal
