// Wavefront OBJ: the lines `v` and `f`; all other lines are about looks, curves and groups.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/formats.h"

#include <charconv>

namespace eikonal::mesh {

namespace {

/// A corner is INDEX, INDEX/TEXTURE, INDEX//NORMAL or all three; negative ones count backwards
/// from the last point so far.
std::int64_t cornerIndex(const FileText& text, size_t word, size_t pointsSoFar) {
    const std::string_view item = text.words()[word];
    const std::string_view digits = item.substr(0, item.find('/'));
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size() || index == 0)
        text.fail(text.quoted(word), "the number of a point, counted from 1");
    return index > 0 ? index - 1 : static_cast<std::int64_t>(pointsSoFar) + index;
}

} // namespace

PolygonSoup parseObj(const std::string& path, std::string_view bytes) {
    PolygonSoup soup;
    FileText text(path, bytes);
    bool continued = false; // a backslash at the end of a face's line
    while (text.nextLine('#')) {
        const std::vector<std::string_view>& words = text.words();
        if (words.empty()) continue;
        if (words[0] == "v" && !continued) soup.points.push_back(text.point(1));
        if (words[0] != "f" && !continued) continue;
        const bool goesOn = words.back() == "\\";
        for (size_t i = continued ? 0 : 1; i < words.size() - (goesOn ? 1 : 0); ++i)
            soup.corners.push_back(cornerIndex(text, i, soup.points.size()));
        continued = goesOn;
        if (!continued) soup.endPolygon();
    }
    if (continued) text.fail("the end of the file", "the rest of a face");
    return soup;
}

} // namespace eikonal::mesh
