// What is turned round an axis: points of (radius, height), from a table or a drawing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes/profile.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "shapes/curves.h"
#include "shapes/svg.h"

#include <algorithm>
#include <sstream>

namespace eikonal::shapes {

namespace {

void readTable(std::string_view text, Profile& profile) {
    size_t number = 0;
    for (std::string line : split(text, '\n')) {
        ++number;
        line = line.substr(0, line.find('#'));
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
        std::istringstream words(line);
        std::vector<std::string> found;
        for (std::string word; words >> word;) found.push_back(word);
        if (found.empty()) continue;
        const std::string place = "line " + std::to_string(number);
        const auto radius = found.size() == 2 ? parseNumber(found[0]) : std::nullopt;
        const auto height = found.size() == 2 ? parseNumber(found[1]) : std::nullopt;
        if (!radius || !height)
            throw DataError(profile.title + ": " + place + ": found '" + join(found, " ") +
                            "', expected a radius and a height");
        profile.points.emplace_back(*radius, *height);
        profile.places.push_back(place);
    }
    auto& points = profile.points;
    if (points.size() > 2 && points.front() == points.back()) {
        profile.loop = true;
        points.pop_back();
        profile.places.pop_back();
    }
}

void readDrawing(std::string_view text, double tolerance, Profile& profile) {
    const SvgOutline outline = readSvg(text, profile.title);
    glm::dvec2 low = outline.curves[0][0], high = low;
    for (const auto& control : outline.curves)
        for (const glm::dvec2& p : control) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    if (tolerance == 0) tolerance = std::max(high.x - low.x, high.y - low.y) / 2000;
    auto& points = profile.points;
    const auto place = [&](size_t curve) {
        profile.places.resize(points.size(),
                              "part " + std::to_string(curve + 1) + " of the outline");
    };
    points.push_back(outline.curves[0][0]);
    place(0);
    for (size_t k = 0; k < outline.curves.size(); ++k) {
        appendCurve(outline.curves[k], tolerance, points);
        place(k);
    }
    double bottom = points[0].y;
    for (const glm::dvec2& p : points) bottom = std::max(bottom, p.y);
    for (glm::dvec2& p : points) p.y = bottom - p.y;
    if (points.size() > 2 && points.front() == points.back()) {
        profile.loop = true;
        points.pop_back();
        profile.places.pop_back();
    }
}

} // namespace

Profile readProfile(const std::string& path, double tolerance) {
    return profileFrom(readWhole(path), path == "-" ? "standard input" : path, tolerance);
}

Profile profileFrom(std::string_view bytes, const std::string& title, double tolerance) {
    const std::string_view text = withoutByteOrderMark(bytes);
    Profile read;
    read.title = title;
    const size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && text[first] == '<')
        readDrawing(text, tolerance, read);
    else
        readTable(text, read);

    Profile profile{read.title, {}, {}, read.loop};
    for (size_t i = 0; i < read.points.size(); ++i) {
        if (read.points[i].x < 0)
            throw DataError(read.title + ": " + read.places[i] + ": found a radius of " +
                            toText(read.points[i].x) + ", expected 0 or more");
        if (!profile.points.empty() && profile.points.back() == read.points[i]) continue;
        profile.points.push_back(read.points[i]);
        profile.places.push_back(read.places[i]);
    }
    if (profile.points.size() < 2)
        throw DataError(read.title + ": found " + std::to_string(profile.points.size()) +
                        (profile.points.size() == 1 ? " point" : " points") +
                        " of a profile, expected 2 or more");
    return profile;
}

} // namespace eikonal::shapes
