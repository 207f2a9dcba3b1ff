// The file formats behind readMesh(): text or bytes in, polygons out.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

// CGAL's readers are not used: they trust a header's counts for memory, dereference null on PLY
// coordinates of integer type and tell only "no" of a file they refuse. Here a count costs
// nothing until the bytes it promises have been seen.
namespace eikonal::mesh {

/// Polygons as a file lists them; indices are not yet checked.
struct PolygonSoup {
    std::vector<glm::dvec3> points;
    std::vector<std::int64_t> corners; ///< of all polygons, one after the other
    std::vector<size_t> ends;          ///< for each polygon, where its corners end in `corners`

    void endPolygon() { ends.push_back(corners.size()); }
};

/// One file being read, walked line by line; its errors name the line.
class FileText {
public:
    FileText(const std::string& path, std::string_view bytes) : mPath(path), mRest(bytes) {}

    /// Steps to the next line and splits it at blanks; false at the end. A carriage return counts
    /// as a blank; from `comment` on the line is ignored.
    bool nextLine(char comment = '\0');

    /// nextLine() until one has words. Throws DataError("... expected WHAT") at the end.
    void nextWords(char comment, const std::string& what);

    const std::vector<std::string_view>& words() const { return mWords; }
    std::string_view rest() const { return mRest; }

    /// The words at `first` and the two after it as coordinates. Throws DataError.
    glm::dvec3 point(size_t first) const;

    /// A word as an integer. Throws DataError saying that `what` was expected.
    std::int64_t integer(size_t word, const std::string& what) const;

    /// Throws DataError: "PATH:LINE: found FOUND, expected EXPECTED".
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

    /// The word in quotes, or "the end of the line".
    std::string quoted(size_t word) const;

private:
    std::string mPath;
    std::string_view mRest;
    std::vector<std::string_view> mWords;
    size_t mLine = 0;
};

PolygonSoup parseObj(const std::string& path, std::string_view bytes);
PolygonSoup parseOff(const std::string& path, std::string_view bytes);
PolygonSoup parsePly(const std::string& path, std::string_view bytes);
PolygonSoup parseStl(const std::string& path, std::string_view bytes);

} // namespace eikonal::mesh
