// The Object File Format in its ASCII form: a head, a line for each point, a line for each face.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/formats.h"

namespace eikonal::mesh {

namespace {

constexpr std::string_view kDigits = "0123456789";

/// Steps to the line of the counts; gives the word that they begin with.
size_t findCounts(FileText& text) {
    text.nextWords('#', "'OFF'");
    const std::string_view word = text.words()[0];
    if (word.find_first_not_of(kDigits) == std::string_view::npos) return 0; // no head at all
    const size_t head = offHeadOf(word);
    if (head == 0) text.fail(text.quoted(0), "'OFF'");
    if (text.words().size() > 1 && text.words()[1] == "BINARY")
        text.fail("a binary file", "the ASCII form of OFF");
    if (head < word.size()) {
        text.trim(head);
        return 0;
    }
    if (text.words().size() > 1) return 1; // some files have the counts on the line of the head
    text.nextWords('#', "the numbers of points and faces");
    return 0;
}

} // namespace

size_t offHeadOf(std::string_view word) {
    // The prefixes tell what follows the coordinates (texture, colour, normal), which is not read.
    // 4OFF and nOFF have other coordinates.
    std::string_view rest = word;
    for (std::string_view prefix : {"ST", "C", "N"})
        if (rest.substr(0, prefix.size()) == prefix) rest.remove_prefix(prefix.size());
    if (rest.substr(0, 3) != "OFF") return 0;
    rest.remove_prefix(3);
    return rest.find_first_not_of(kDigits) == std::string_view::npos ? word.size() - rest.size()
                                                                     : 0;
}

PolygonSoup parseOff(const std::string& path, std::string_view bytes) {
    FileText text(path, bytes);
    const size_t first = findCounts(text);
    const std::int64_t points = text.integer(first, "the number of points");
    const std::int64_t faces = text.integer(first + 1, "the number of faces");
    PolygonSoup soup;
    for (std::int64_t i = 0; i < points; ++i) {
        text.nextWords('#', std::to_string(points) + " points");
        soup.points.push_back(text.point(0));
    }
    for (std::int64_t i = 0; i < faces; ++i) {
        text.nextWords('#', std::to_string(faces) + " faces");
        const std::int64_t corners = text.integer(0, "the number of corners");
        for (std::int64_t k = 1; k <= corners; ++k)
            soup.corners.push_back(text.integer(static_cast<size_t>(k), "the index of a point"));
        soup.endPolygon();
    }
    return soup;
}

} // namespace eikonal::mesh
