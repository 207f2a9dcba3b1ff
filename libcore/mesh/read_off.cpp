// The Object File Format in its ASCII form: a head, a line for each point, a line for each face.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/formats.h"

namespace eikonal::mesh {

namespace {

/// The optional prefixes tell what follows the coordinates (texture, colour, normal), which is not
/// read. 4OFF and nOFF have other coordinates.
bool isKnownHead(std::string_view word) {
    for (std::string_view prefix : {"ST", "C", "N"})
        if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
    return word == "OFF";
}

} // namespace

PolygonSoup parseOff(const std::string& path, std::string_view bytes) {
    FileText text(path, bytes);
    text.nextWords('#', "'OFF'");
    if (!isKnownHead(text.words()[0])) text.fail(text.quoted(0), "'OFF'");
    if (text.words().size() > 1 && text.words()[1] == "BINARY")
        text.fail("a binary file", "the ASCII form of OFF");
    size_t first = 1; // some files have the counts on the line of the head
    if (text.words().size() == 1) {
        text.nextWords('#', "the numbers of points and faces");
        first = 0;
    }
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
