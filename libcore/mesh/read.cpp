// Mesh files to triangles: the first step of mesh2vol.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/read.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "mesh/formats.h"
#include "mesh/parts.h"
#include "mesh/triangulate.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>

namespace eikonal::mesh {

namespace {

std::string lowerCaseExtension(const std::string& path) {
    const std::string name = baseName(path);
    const size_t point = name.rfind('.');
    std::string extension = point == std::string::npos ? "" : name.substr(point);
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

Format chooseFormat(const std::string& path, std::string_view bytes) {
    const std::string extension = lowerCaseExtension(path);
    if (extension == ".obj") return Format::obj;
    if (extension == ".off") return Format::off;
    if (extension == ".ply") return Format::ply;
    if (extension == ".stl") return Format::stl;
    const auto format = formatOf(bytes);
    if (!format)
        throw DataError(meshTitle(path) + ": found " +
                        (extension.empty() ? "no extension" : "extension '" + extension + "'") +
                        " and no content that tells, expected OBJ, OFF, PLY or STL");
    return *format;
}

PolygonSoup parse(const std::string& path, std::string_view bytes) {
    const std::string title = meshTitle(path);
    if (bytes.empty()) throw DataError(title + ": found an empty file, expected a mesh");
    const std::string foreign = formatOf(bytes) ? "" : foreignFormat(bytes);
    if (!foreign.empty()) throw DataError(title + ": found " + foreign + ", expected a mesh");
    switch (chooseFormat(path, bytes)) {
    case Format::obj:
        return parseObj(title, bytes);
    case Format::off:
        return parseOff(title, bytes);
    case Format::ply:
        return parsePly(title, bytes);
    case Format::stl:
        break;
    }
    return parseStl(title, bytes);
}

/// A corner's normal, of length 1; 0 if it has none, or one that says nothing.
glm::vec3 normalAt(const PolygonSoup& soup, size_t corner) {
    const std::int64_t look = soup.looks[corner];
    if (look < 0 || look >= static_cast<std::int64_t>(soup.normals.size())) return glm::vec3(0);
    const glm::dvec3 normal = soup.normals[static_cast<size_t>(look)];
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0);
}

/// Appends a polygon's triangles with their corners' normals; `first` is the polygon's first
/// corner.
void addWithNormals(const PolygonSoup& soup, size_t first,
                    const std::vector<std::uint32_t>& polygon, TriangleMesh& mesh) {
    // Triangles of corners rather than points, so that each finds its normal.
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t point : polygon) {
        numbers.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(soup.points[point]);
    }
    std::vector<glm::uvec3> triangles;
    appendTriangles(points, numbers, triangles);
    for (const glm::uvec3& t : triangles) {
        mesh.triangles.emplace_back(polygon[t.x], polygon[t.y], polygon[t.z]);
        mesh.normals.push_back({normalAt(soup, first + t.x), normalAt(soup, first + t.y),
                                normalAt(soup, first + t.z)});
    }
}

/// Appends a polygon's triangles.
void addFace(const std::string& title, const PolygonSoup& soup, size_t face, TriangleMesh& mesh) {
    const auto pointCount = static_cast<std::int64_t>(soup.points.size());
    std::vector<std::uint32_t> polygon;
    for (size_t i = face == 0 ? 0 : soup.ends[face - 1]; i < soup.ends[face]; ++i) {
        const std::int64_t index = soup.corners[i];
        if (index < 0 || index >= pointCount)
            throw DataError(title + ": face " + std::to_string(face + 1) + " uses point " +
                            std::to_string(index + 1) + ", expected 1 to " +
                            std::to_string(pointCount) + " (counted from 1)");
        polygon.push_back(static_cast<std::uint32_t>(index));
    }
    if (polygon.size() < 3)
        throw DataError(title + ": face " + std::to_string(face + 1) + " has " +
                        std::to_string(polygon.size()) + " corners, expected at least 3");
    if (soup.looks.empty())
        appendTriangles(soup.points, polygon, mesh.triangles);
    else
        addWithNormals(soup, soup.ends[face] - polygon.size(), polygon, mesh);
}

/// Numbers names in the order in which they come.
class Names {
public:
    std::uint32_t numberOf(const std::string& name) {
        const auto [at, isNew] = mNumbers.try_emplace(name, mNumbers.size());
        if (isNew) mNames.push_back(name);
        return at->second;
    }
    const std::vector<std::string>& all() const { return mNames; }

private:
    std::map<std::string, std::uint32_t> mNumbers;
    std::vector<std::string> mNames;
};

struct Labelled {
    TriangleMesh mesh;
    std::vector<std::uint32_t> labels; ///< one for each triangle
    Names names;
};

/// Triangles labelled by their objects' names, or by those and their materials', a line feed
/// between.
Labelled toTriangles(const std::string& title, PolygonSoup soup, bool byMaterial) {
    const bool hasObjects = std::any_of(soup.labels.begin(), soup.labels.end(),
                                        [](const Label& label) { return label.isObject; });
    std::erase_if(soup.labels, [&](const Label& label) { return label.isObject != hasObjects; });
    if (!byMaterial) soup.materials.clear();
    Labelled result;
    std::string name, material;
    for (size_t face = 0, next = 0, nextMaterial = 0; face < soup.ends.size(); ++face) {
        for (; next < soup.labels.size() && soup.labels[next].firstPolygon <= face; ++next)
            name = soup.labels[next].name;
        for (; nextMaterial < soup.materials.size() &&
               soup.materials[nextMaterial].firstPolygon <= face;
             ++nextMaterial)
            material = soup.materials[nextMaterial].name;
        addFace(title, soup, face, result.mesh);
        const std::string label = byMaterial ? name + "\n" + material : name;
        result.labels.resize(result.mesh.triangles.size(), result.names.numberOf(label));
    }
    if (result.mesh.triangles.empty())
        throw DataError(title + ": found " + std::to_string(soup.points.size()) +
                        " points and no faces, expected at least one face");
    result.mesh.points = std::move(soup.points);
    mergeIdenticalPoints(result.mesh);
    return result;
}

} // namespace

std::string meshTitle(const std::string& path) {
    return path == "-" ? "standard input" : path;
}

TriangleMesh readMesh(const std::string& path) {
    const std::string bytes = readWhole(path);
    return toTriangles(meshTitle(path), parse(path, bytes), false).mesh;
}

std::vector<Part> readParts(const std::string& path) {
    return readParts(path, readWhole(path));
}

std::vector<Part> readParts(const std::string& path, std::string_view bytes) {
    Labelled read = toTriangles(meshTitle(path), parse(path, bytes), false);
    const std::vector<std::string>& names = read.names.all();
    std::vector<std::uint32_t> objects(names.size(), 0);
    if (names.size() > 1) objects = objectsOf(read.mesh, read.labels, names.size());
    std::vector<TriangleMesh> meshes = split(read.mesh, read.labels, objects);
    std::vector<Part> parts;
    for (size_t i = 0; i < names.size(); ++i)
        if (objects[i] == i)
            parts.push_back(
                {names[i].empty() ? "part " + std::to_string(parts.size() + 1) : names[i],
                 std::move(meshes[i])});
    if (parts.size() == 1) parts.front() = {"", std::move(read.mesh)};
    return parts;
}

std::vector<Part> readPieces(const std::string& path, std::string_view bytes) {
    const Labelled read = toTriangles(meshTitle(path), parse(path, bytes), true);
    const std::vector<std::string>& names = read.names.all();
    std::vector<std::uint32_t> each(names.size());
    std::iota(each.begin(), each.end(), 0u);
    std::vector<TriangleMesh> meshes = split(read.mesh, read.labels, each);
    std::vector<Part> pieces;
    for (size_t i = 0; i < names.size(); ++i) {
        const size_t end = names[i].find('\n');
        pieces.push_back({names[i].substr(0, end), std::move(meshes[i]), names[i].substr(end + 1)});
    }
    return pieces;
}

std::vector<std::string> materialLibraries(const std::string& path, std::string_view bytes) {
    if (bytes.find("mtllib") == std::string_view::npos || bytes.empty() ||
        chooseFormat(path, bytes) != Format::obj)
        return {};
    return parse(path, bytes).libraries;
}

} // namespace eikonal::mesh
