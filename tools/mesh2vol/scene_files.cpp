// Mesh files and scene files as mesh2vol reads them: objects, and what a file says of their matter.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh2vol/scene_files.h"

#include "base/error.h"
#include "base/input_file.h"
#include "base/text.h"
#include "mesh/check.h"
#include "mesh/parts.h"
#include "mesh/read.h"
#include "optics/materials.h"
#include "scenefile/gltf.h"
#include "scenefile/mtl.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace eikonal::mesh2vol {

namespace {

using Kind = scenefile::Material::Kind;

bool isOpen(const mesh::TriangleMesh& mesh) {
    return mesh::checkTopology(mesh).boundaryEdges > 0;
}

/// Joins what is closed only together, where glass is in it or all of it is closed: open pieces
/// that are opaque stay apart, each of its own colour.
void joinPieces(ReadFile& file, const std::string& title) {
    std::vector<Piece>& pieces = file.pieces;
    mesh::TriangleMesh all;
    std::vector<std::uint32_t> labels;
    for (size_t i = 0; i < pieces.size(); ++i) {
        mesh::append(all, pieces[i].mesh);
        labels.resize(all.triangles.size(), static_cast<std::uint32_t>(i));
    }
    mesh::mergeIdenticalPoints(all);
    const std::vector<std::uint32_t> groups = mesh::objectsOf(all, labels, pieces.size());
    std::map<std::uint32_t, std::vector<size_t>> members;
    for (size_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
    std::vector<Piece> joined;
    for (const auto& [first, group] : members) {
        const auto open = [&](size_t i) { return isOpen(pieces[i].mesh); };
        const auto glass =
            std::find_if(group.begin(), group.end(), [&](size_t i) { return pieces[i].isGlass(); });
        const bool apart = glass == group.end() && std::any_of(group.begin(), group.end(), open);
        if (group.size() == 1 || apart) {
            for (const size_t i : group) joined.push_back(std::move(pieces[i]));
            continue;
        }
        Piece whole{pieces[first].name, pieces[glass == group.end() ? first : *glass].material};
        for (const size_t i : group) {
            if (pieces[i].material != whole.material)
                file.warnings.push_back(title + ": '" + pieces[i].name + "' and '" + whole.name +
                                        "' are closed only together: one object of '" +
                                        (whole.material ? whole.material->name : "no material") +
                                        "'");
            mesh::append(whole.mesh, pieces[i].mesh);
        }
        mesh::mergeIdenticalPoints(whole.mesh);
        joined.push_back(std::move(whole));
    }
    pieces = std::move(joined);
    if (pieces.size() == 1) pieces.front().name.clear();
}

ReadFile readGltf(const std::string& path, const std::string& bytes, bool fillIn) {
    const std::string title = mesh::meshTitle(path);
    scenefile::Objects read = scenefile::readGltfObjects(path, bytes);
    ReadFile file;
    if (!read.unknown.empty())
        file.warnings.push_back(title + ": not understood: " + join(read.unknown, ", "));
    if (read.thinGlass)
        file.notes.push_back(title + ": what transmits has no thickness there (thicknessFactor): "
                                     "closed meshes are taken as solid");
    for (scenefile::Object& object : read.objects) {
        mesh::TriangleMesh mesh{std::move(object.points), std::move(object.triangles),
                                std::move(object.normals)};
        mesh::mergeIdenticalPoints(mesh); // apart where normals or textures have a seam
        if (fillIn && !object.material)
            object.material = {Kind::matt, "no material", glm::dvec3(0.8), 1};
        file.pieces.push_back({object.name, std::move(object.material), std::move(mesh)});
    }
    joinPieces(file, title);
    return file;
}

/// The materials of an OBJ file's libraries, which lie beside it.
std::map<std::string, scenefile::Material>
readMaterials(const std::string& path, const std::vector<std::string>& libraries, ReadFile& file) {
    std::map<std::string, scenefile::Material> materials;
    for (const std::string& library : libraries) {
        const std::string at = (std::filesystem::path(path).parent_path() / library).string();
        std::string bytes;
        try {
            bytes = readWhole(at);
        } catch (const MissingError& fault) {
            file.warnings.push_back(mesh::meshTitle(path) +
                                    ": goes without its materials: " + fault.what());
            continue;
        }
        const scenefile::Materials read = scenefile::readMtl(at, bytes);
        if (!read.unknown.empty())
            file.warnings.push_back(at + ": not understood: " + join(read.unknown, ", "));
        for (const scenefile::Material& material : read.materials)
            materials.insert_or_assign(material.name, material);
    }
    return materials;
}

ReadFile readObjWithMaterials(const std::string& path, const std::string& bytes,
                              const std::map<std::string, scenefile::Material>& materials,
                              ReadFile file) {
    const std::string title = mesh::meshTitle(path);
    std::vector<mesh::Part> parts = mesh::readPieces(path, bytes);
    std::map<std::string, int> times; // that an object's name occurs
    for (const mesh::Part& part : parts) ++times[part.name];
    std::vector<std::string> missing;
    for (mesh::Part& part : parts) {
        const auto found = materials.find(part.material);
        std::string name = part.name;
        if (name.empty())
            name = part.material.empty() ? "no material" : part.material;
        else if (times[part.name] > 1)
            name += "." + (part.material.empty() ? "no material" : part.material);
        Piece piece{name, {}, std::move(part.mesh)};
        mesh::dropUnusedPoints(piece.mesh);
        if (found != materials.end())
            piece.material = found->second;
        else if (!part.material.empty() &&
                 std::find(missing.begin(), missing.end(), part.material) == missing.end())
            missing.push_back(part.material);
        file.pieces.push_back(std::move(piece));
    }
    if (!missing.empty())
        file.warnings.push_back(title + ": its .mtl has no material " + join(missing, ", "));
    joinPieces(file, title);
    return file;
}

double leastExtent(const mesh::TriangleMesh& mesh) {
    const mesh::Box box = mesh::boundingBox(mesh);
    const glm::dvec3 edges = box.max - box.min;
    return std::min({edges.x, edges.y, edges.z});
}

} // namespace

bool mayBringMaterials(const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension().string();
    const auto is = [&](const char* known) {
        return std::equal(ending.begin(), ending.end(), known, known + std::string(known).size(),
                          [](char a, char b) { return std::tolower(a) == b; });
    };
    return !is(".off") && !is(".ply") && !is(".stl");
}

ReadFile readFile(const std::string& path, bool fillIn) {
    const std::string bytes = readWhole(path);
    if (scenefile::isGltf(path, bytes)) return readGltf(path, bytes, fillIn);
    ReadFile file;
    const std::vector<std::string> libraries = mesh::materialLibraries(path, bytes);
    if (!libraries.empty()) {
        const auto materials = readMaterials(path, libraries, file);
        if (!materials.empty())
            return readObjWithMaterials(path, bytes, materials, std::move(file));
    }
    for (mesh::Part& part : mesh::readParts(path, bytes))
        file.pieces.push_back({part.name, {}, std::move(part.mesh)});
    return file;
}

voxelize::Material materialOf(const scenefile::Material& given, const mesh::TriangleMesh& mesh) {
    voxelize::Material m;
    m.roughness = given.roughness;
    switch (given.kind) {
    case Kind::glass: {
        m.ior = given.ior;
        m.dispersion = optics::dispersionOf(given.ior, given.abbe);
        m.absorption = given.absorption;
        const double chord = 4 * std::abs(mesh::signedVolume(mesh)) / mesh::surfaceArea(mesh);
        if (given.colour != glm::dvec3(1) && chord > 0)
            m.absorption -= glm::log(glm::clamp(given.colour, 1e-6, 1.0)) / chord;
        break;
    }
    case Kind::metal: {
        const optics::NamedMetal metal = optics::metalOfReflectance(given.colour);
        m.metal = volume::Metal{metal.index, metal.extinction};
        m.opacity = 1;
        break;
    }
    case Kind::matt: {
        // A coat's reflection shows where it is a mirror; where it is rough, it lightens the
        // colour.
        constexpr double kSmoothCoat = 0.01;
        if (m.roughness <= kSmoothCoat) m.ior = given.ior;
        m.roughness = 0;
        m.opacity = 1;
        m.albedo = given.colour;
        break;
    }
    case Kind::glow: {
        const double thickness = leastExtent(mesh);
        constexpr double kDepths = 200; // to its other side
        m.roughness = 0;
        m.absorption = glm::dvec3(thickness > 0 ? kDepths / thickness : 0);
        m.emission = m.absorption * given.radiance;
        break;
    }
    }
    return m;
}

std::string materialText(const scenefile::Material& given) {
    const auto rgb = [](const glm::dvec3& c) {
        return toText(static_cast<float>(c.x)) + "," + toText(static_cast<float>(c.y)) + "," +
               toText(static_cast<float>(c.z));
    };
    const std::string rough =
        given.roughness > 0 ? ", roughness " + toText(static_cast<float>(given.roughness)) : "";
    const std::string of = "'" + given.name + "' of the file: ";
    switch (given.kind) {
    case Kind::matt:
        return of + "opaque, albedo " + rgb(given.colour);
    case Kind::metal:
        return of + "metal, reflectance " + rgb(given.colour) + rough;
    case Kind::glow:
        return of + "emits " + rgb(given.radiance);
    case Kind::glass:
        break;
    }
    std::string text = of + "ior " + toText(static_cast<float>(given.ior)) + rough;
    if (given.abbe > 0) text += ", abbe " + toText(static_cast<float>(given.abbe));
    if (given.absorption != glm::dvec3(0)) text += ", absorption " + rgb(given.absorption);
    if (given.colour != glm::dvec3(1)) text += ", tint " + rgb(given.colour);
    return text;
}

} // namespace eikonal::mesh2vol
