// Mesh files to triangles: the first step of mesh2vol.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "mesh/formats.h"
#include "mesh/triangulate.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sys/stat.h>

namespace eikonal::mesh {

namespace {

std::string lowerCaseExtension(const std::string& path) {
    const std::string name = baseName(path);
    const size_t point = name.rfind('.');
    std::string extension = point == std::string::npos ? "" : name.substr(point);
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

PolygonSoup parse(const std::string& path, const std::string& extension, std::string_view bytes) {
    if (extension == ".obj") return parseObj(path, bytes);
    if (extension == ".off") return parseOff(path, bytes);
    if (extension == ".ply") return parsePly(path, bytes);
    return parseStl(path, bytes);
}

TriangleMesh toTriangles(const std::string& path, PolygonSoup soup) {
    const auto pointCount = static_cast<std::int64_t>(soup.points.size());
    TriangleMesh mesh;
    std::vector<std::uint32_t> polygon;
    for (size_t face = 0, begin = 0; face < soup.ends.size(); begin = soup.ends[face++]) {
        polygon.clear();
        for (size_t i = begin; i < soup.ends[face]; ++i) {
            const std::int64_t index = soup.corners[i];
            if (index < 0 || index >= pointCount)
                throw DataError(path + ": face " + std::to_string(face + 1) + " uses point " +
                                std::to_string(index + 1) + ", expected 1 to " +
                                std::to_string(pointCount) + " (counted from 1)");
            polygon.push_back(static_cast<std::uint32_t>(index));
        }
        if (polygon.size() < 3)
            throw DataError(path + ": face " + std::to_string(face + 1) + " has " +
                            std::to_string(polygon.size()) + " corners, expected at least 3");
        appendTriangles(soup.points, polygon, mesh.triangles);
    }
    if (mesh.triangles.empty())
        throw DataError(path + ": found " + std::to_string(pointCount) +
                        " points and no faces, expected at least one face");
    mesh.points = std::move(soup.points);
    return mesh;
}

} // namespace

bool FileText::nextLine(char comment) {
    mWords.clear();
    if (mRest.empty()) return false;
    ++mLine;
    const size_t end = std::min(mRest.find('\n'), mRest.size());
    std::string_view line = mRest.substr(0, end);
    mRest.remove_prefix(std::min(end + 1, mRest.size()));
    if (comment != '\0') line = line.substr(0, std::min(line.find(comment), line.size()));
    constexpr std::string_view kBlanks = " \t\r\f\v";
    for (size_t at = line.find_first_not_of(kBlanks); at < line.size();
         at = line.find_first_not_of(kBlanks, at)) {
        const size_t wordEnd = std::min(line.find_first_of(kBlanks, at), line.size());
        mWords.push_back(line.substr(at, wordEnd - at));
        at = wordEnd;
    }
    return true;
}

void FileText::nextWords(char comment, const std::string& what) {
    while (nextLine(comment))
        if (!mWords.empty()) return;
    fail("the end of the file", what);
}

glm::dvec3 FileText::point(size_t first) const {
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) {
        const size_t word = first + static_cast<size_t>(k);
        const auto number = word < mWords.size() ? parseNumber(mWords[word]) : std::nullopt;
        if (!number) fail(quoted(word), "a finite coordinate");
        p[k] = *number;
    }
    return p;
}

std::int64_t FileText::integer(size_t word, const std::string& what) const {
    // More than any file can list, and far from where sums of two would overflow.
    constexpr std::int64_t kLargest = std::int64_t(1) << 53;
    std::int64_t value = 0;
    if (word < mWords.size()) {
        const std::string_view text = mWords[word];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && value >= -kLargest && value <= kLargest) return value;
    }
    fail(quoted(word), what);
}

void FileText::fail(const std::string& found, const std::string& expected) const {
    throw DataError(mPath + ":" + std::to_string(mLine) + ": found " + found + ", expected " +
                    expected);
}

std::string FileText::quoted(size_t word) const {
    if (word >= mWords.size()) return "the end of the line";
    // A binary file may reach this: the message stays one short line of plain letters.
    std::string text = "'";
    for (char c : mWords[word].substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + "'";
}

TriangleMesh readMesh(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        throw MissingError(path + ": can't open: " + std::strerror(errno));
    if (S_ISDIR(status.st_mode))
        throw MissingError(path + ": is a directory, expected a mesh file");
    const std::string extension = lowerCaseExtension(path);
    if (extension != ".obj" && extension != ".off" && extension != ".ply" && extension != ".stl")
        throw DataError(path + ": found " +
                        (extension.empty() ? "no extension" : "extension '" + extension + "'") +
                        ", expected .obj, .off, .ply or .stl");
    const std::string bytes = readWhole(path);
    if (bytes.empty()) throw DataError(path + ": found an empty file, expected a mesh");
    TriangleMesh mesh = toTriangles(path, parse(path, extension, bytes));
    mergeIdenticalPoints(mesh);
    return mesh;
}

} // namespace eikonal::mesh
