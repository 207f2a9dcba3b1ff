// STL, ASCII and binary: three corners for each triangle, nothing shared.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "mesh/formats.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace eikonal::mesh {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr size_t kHeadBytes = 84;     // 80 of text, then the number of triangles
constexpr size_t kTriangleBytes = 50; // a normal and three corners of 3 floats, 2 bytes to spare
constexpr size_t kNormalBytes = 12;

void addCorner(PolygonSoup& soup, const glm::dvec3& point) {
    soup.corners.push_back(static_cast<std::int64_t>(soup.points.size()));
    soup.points.push_back(point);
}

size_t countedTriangles(std::string_view bytes) {
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
    return triangles;
}

/// The triangles of a binary file by its head, or by its size where the head's count was never
/// filled in, as programs leave it that write to a pipe. Bytes behind them are no harm, but where
/// they make whole triangles it is unclear how many there are.
size_t trianglesOf(const std::string& path, std::string_view bytes) {
    const size_t counted = bytes.size() < kHeadBytes ? 0 : countedTriangles(bytes);
    const size_t promised = kHeadBytes + kTriangleBytes * counted;
    const size_t rest = bytes.size() < kHeadBytes ? 0 : bytes.size() - kHeadBytes;
    const bool whole = rest > 0 && rest % kTriangleBytes == 0;
    if (whole && (counted == 0 || counted == UINT32_MAX)) return rest / kTriangleBytes;
    if (bytes.size() < promised || bytes.size() < kHeadBytes)
        throw DataError(path + ": found " + std::to_string(bytes.size()) +
                        " bytes, expected an ASCII STL file, beginning with 'solid', or a binary "
                        "one of at least " +
                        std::to_string(promised));
    if (whole && rest / kTriangleBytes != counted)
        throw DataError(path + ": found " + std::to_string(rest / kTriangleBytes) +
                        " triangles by the size of the file, expected " + std::to_string(counted) +
                        " by the count in its head");
    return counted;
}

PolygonSoup parseBinary(const std::string& path, std::string_view bytes) {
    const size_t triangles = trianglesOf(path, bytes);
    PolygonSoup soup;
    for (size_t i = 0; i < triangles; ++i) {
        float corners[9];
        std::memcpy(corners, bytes.data() + kHeadBytes + i * kTriangleBytes + kNormalBytes,
                    sizeof corners);
        for (float coordinate : corners)
            if (!std::isfinite(coordinate))
                throw DataError(path + ": triangle " + std::to_string(i + 1) +
                                " has a coordinate that is no number, expected finite ones");
        for (int k = 0; k < 9; k += 3)
            addCorner(soup, {corners[k], corners[k + 1], corners[k + 2]});
        soup.endPolygon();
    }
    return soup;
}

bool isWord(const FileText& text, std::string_view lowerCase) {
    const std::string_view word = text.words()[0];
    if (word.size() != lowerCase.size()) return false;
    for (size_t i = 0; i < word.size(); ++i)
        if ((word[i] | 0x20) != lowerCase[i]) return false; // some programs write capitals
    return true;
}

PolygonSoup parseAscii(const std::string& path, std::string_view bytes) {
    PolygonSoup soup;
    FileText text(path, bytes);
    bool inSolid = false;
    size_t corners = 0;
    while (text.nextLine()) {
        if (text.words().empty()) continue;
        if (isWord(text, "vertex")) {
            addCorner(soup, text.point(1));
            ++corners;
        } else if (isWord(text, "endfacet")) {
            if (corners != 3) text.fail(std::to_string(corners) + " vertices in a facet", "3");
            corners = 0;
            soup.endPolygon();
        } else if (isWord(text, "solid")) {
            inSolid = true;
        } else if (isWord(text, "endsolid")) {
            inSolid = false;
        } else if (!isWord(text, "facet") && !isWord(text, "outer") && !isWord(text, "endloop")) {
            text.fail(text.quoted(0), "a line of an STL file");
        }
    }
    if (inSolid || corners > 0) text.fail("the end of the file", "'endsolid'");
    return soup;
}

} // namespace

bool isBinaryStl(std::string_view bytes) {
    if (bytes.size() >= kHeadBytes &&
        bytes.size() == kHeadBytes + kTriangleBytes * countedTriangles(bytes))
        return true;
    // Binary files whose text begins with "solid" exist; no text has zeros.
    FileText text("", bytes);
    while (text.nextLine() && text.words().empty()) {
    }
    const bool solid = !text.words().empty() && isWord(text, "solid");
    return !solid || (bytes.size() > kHeadBytes && bytes.find('\0') != std::string_view::npos);
}

PolygonSoup parseStl(const std::string& path, std::string_view bytes) {
    return isBinaryStl(bytes) ? parseBinary(path, bytes) : parseAscii(path, bytes);
}

} // namespace eikonal::mesh
