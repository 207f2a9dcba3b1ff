// Wavefront OBJ: the lines `v`, `f`, `o` and `g`; all others are about looks and curves.
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

/// What stands behind the keyword, words apart by one blank.
std::string nameBehind(const std::vector<std::string_view>& words) {
    std::string name;
    for (size_t i = 1; i < words.size(); ++i) name += (i > 1 ? " " : "") + std::string(words[i]);
    return name;
}

} // namespace

PolygonSoup parseObj(const std::string& path, std::string_view bytes) {
    PolygonSoup soup;
    FileText text(path, bytes);
    while (text.nextJoinedLine('#')) {
        const std::vector<std::string_view>& words = text.words();
        if (words.empty()) continue;
        // A keyword that something invisible hides would be skipped with its point or face.
        if (words[0][0] < ' ' || words[0][0] > '~') text.fail(text.quoted(0), "a keyword of OBJ");
        if (words[0] == "v") {
            soup.points.push_back(text.point(1));
        } else if (words[0] == "f") {
            for (size_t i = 1; i < words.size(); ++i)
                soup.corners.push_back(cornerIndex(text, i, soup.points.size()));
            soup.endPolygon();
        } else if (words[0] == "o" || words[0] == "g") {
            soup.labels.push_back({nameBehind(words), soup.ends.size(), words[0] == "o"});
        }
    }
    return soup;
}

} // namespace eikonal::mesh
