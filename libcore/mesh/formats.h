// The file formats behind readMesh(): text or bytes in, polygons out.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// CGAL's readers are not used: they trust a header's counts for memory, dereference null on PLY
// coordinates of integer type and tell only "no" of a file they refuse. Nor are assimp's, which
// keep coordinates as floats, so that a scene far from its origin comes apart, and take a file with
// a fault without a word. Here a count costs nothing until the bytes it promises have been seen.
namespace eikonal::mesh {

/// From a polygon on, what they all belong to.
struct Label {
    std::string name;
    size_t firstPolygon;
    bool isObject; ///< an `o` of OBJ rather than a `g`
};

/// From a polygon on, what they are made of: `usemtl` of OBJ.
struct MaterialLabel {
    std::string name;
    size_t firstPolygon;
};

/// Polygons as a file lists them; indices are not yet checked.
struct PolygonSoup {
    std::vector<glm::dvec3> points;
    std::vector<std::int64_t> corners;    ///< of all polygons, one after the other
    std::vector<size_t> ends;             ///< for each polygon, where its corners end in `corners`
    std::vector<Label> labels;            ///< in the order of their first polygons
    std::vector<MaterialLabel> materials; ///< the same
    std::vector<std::string> libraries;   ///< files of those materials: `mtllib` of OBJ
    std::vector<glm::vec3> normals;       ///< as the file has them; what it has in a bad form is 0
    std::vector<std::int64_t> looks; ///< of each corner its normal, or none if there is none such;
                                     ///< empty if no corner has one

    void endPolygon() { ends.push_back(corners.size()); }
};

/// One file being read, walked line by line; its errors name the line. Lines end by a line feed, a
/// carriage return or both. A byte order mark at the start of a line is no part of it.
class FileText {
public:
    FileText(const std::string& path, std::string_view bytes);

    /// Steps to the next line and splits it at blanks; false at the end. From `comment` on the line
    /// is ignored.
    bool nextLine(char comment = '\0');

    /// The same, and joins the lines behind one that ends with a backslash. Throws DataError where
    /// the file ends there.
    bool nextJoinedLine(char comment);

    /// nextLine() until one has words. Throws DataError("... expected WHAT") at the end.
    void nextWords(char comment, const std::string& what);

    /// Takes letters off the start of the first word.
    void trim(size_t letters) { mWords[0].remove_prefix(letters); }

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
    std::string_view takeLine();
    void split(std::string_view line);

    std::string mPath;
    std::string_view mRest;
    bool mPairs; ///< a line feed behind a carriage return belongs to it
    std::vector<std::string_view> mWords;
    size_t mLine = 0;
};

enum class Format { obj, off, ply, stl };

/// In words, what bytes are of that no reader here takes; empty: nothing known.
std::string foreignFormat(std::string_view bytes);

/// What the bytes look like, whatever the file is called.
std::optional<Format> formatOf(std::string_view bytes);

/// The letters of an OFF file's head at the start of the word, nothing but a number behind them:
/// "OFF8 6 0" is written, too. 0: it is no head.
size_t offHeadOf(std::string_view word);

/// Whether this is an STL file of the binary kind, "solid" at its start or not.
bool isBinaryStl(std::string_view bytes);

PolygonSoup parseObj(const std::string& path, std::string_view bytes);
PolygonSoup parseOff(const std::string& path, std::string_view bytes);
PolygonSoup parsePly(const std::string& path, std::string_view bytes);
PolygonSoup parseStl(const std::string& path, std::string_view bytes);

} // namespace eikonal::mesh
