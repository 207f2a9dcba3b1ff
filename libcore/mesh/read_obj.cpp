// Wavefront OBJ: the lines `v`, `vn`, `f`, `o`, `g`, `usemtl` and `mtllib`; all others are about
// looks and curves. Nor is `s` read, the smoothing of faces without normals: many write `s off`
// whatever they mean. SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/formats.h"

#include "base/text.h"

#include <algorithm>
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

/// The normal behind a corner's second slash, counted likewise; -1: none that can be read.
std::int64_t normalIndex(std::string_view item, size_t normalsSoFar) {
    const size_t first = item.find('/');
    const size_t second = first == std::string_view::npos ? first : item.find('/', first + 1);
    if (second == std::string_view::npos) return -1;
    const std::string_view digits = item.substr(second + 1);
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size() || index == 0) return -1;
    if (index > 0) return index - 1;
    // So that what is far before the first does not become one.
    return std::max<std::int64_t>(index, -1 - static_cast<std::int64_t>(normalsSoFar)) +
           static_cast<std::int64_t>(normalsSoFar);
}

/// A line `vn`; 0 where a number is missing or bad, so that the others keep their places.
glm::vec3 normalOn(const std::vector<std::string_view>& words) {
    glm::vec3 normal(0);
    for (size_t k = 0; k < 3; ++k) {
        const auto number = k + 1 < words.size() ? parseNumber(words[k + 1]) : std::nullopt;
        if (!number) return glm::vec3(0);
        normal[static_cast<int>(k)] = static_cast<float>(*number);
    }
    return normal;
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
            for (size_t i = 1; i < words.size(); ++i) {
                soup.corners.push_back(cornerIndex(text, i, soup.points.size()));
                soup.looks.push_back(normalIndex(words[i], soup.normals.size()));
            }
            soup.endPolygon();
        } else if (words[0] == "vn") {
            soup.normals.push_back(normalOn(words));
        } else if (words[0] == "o" || words[0] == "g") {
            soup.labels.push_back({nameBehind(words), soup.ends.size(), words[0] == "o"});
        } else if (words[0] == "usemtl") {
            soup.materials.push_back({nameBehind(words), soup.ends.size()});
        } else if (words[0] == "mtllib") {
            soup.libraries.push_back(nameBehind(words));
        }
    }
    if (soup.normals.empty()) soup.looks.clear();
    return soup;
}

} // namespace eikonal::mesh
