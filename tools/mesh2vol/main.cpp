// mesh2vol: turns closed surfaces and what they are made of into a scene volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"
#include "gpu/device.h"
#include "mesh/check.h"
#include "mesh/plate.h"
#include "mesh/read.h"
#include "mesh2vol/material_facts.h"
#include "voxelize/accept.h"
#include "voxelize/curve.h"
#include "voxelize/ground.h"
#include "voxelize/voxelize.h"

#include <algorithm>

using namespace eikonal;

namespace {

using mesh2vol::Piece;
using Facts = std::vector<std::pair<std::string, std::string>>; ///< "name: text" for --explain

struct Objects {
    std::vector<mesh2vol::Source> sources;
    std::vector<mesh::TriangleMesh> meshes;
    Facts facts;
};

/// Checks a mesh, closes it as a sheet, repairs it where asked for, and tells what was found.
void accept(tool::Session& session, const std::string& title, bool repair,
            const std::optional<mesh::SheetDomain>& sheet, mesh::TriangleMesh& mesh, Facts& facts) {
    voxelize::Acceptance found;
    session.pass("check", [&] { found = voxelize::acceptMesh(mesh, title, repair, sheet); });
    facts.emplace_back("mesh " + title, join(found.findings, "; "));
    if (!found.closing.empty()) {
        session.stats().count("sheets_closed", 1);
        facts.emplace_back("sheet " + title, found.closing);
        session.note(title + ": " + found.closing);
        found.findings.resize(1); // that it is open has been said
    }
    if (!found.repairs.empty())
        facts.emplace_back("repairs to " + title, join(found.repairs, "; "));
    session.say(title + ": " + found.findings.front());
    for (size_t i = 1; i < found.findings.size(); ++i)
        session.note(title + ": " + found.findings[i]);
    for (const std::string& done : found.repairs) session.note(title + ": " + done);
    for (const std::string& warning : found.warnings) session.warn(title + ": " + warning);
}

/// Where the pieces of a file are many and no option tells them apart, those of one material are
/// one.
void joinAlike(tool::Session& session, const mesh2vol::Options& o, const std::string& title,
               std::vector<Piece>& pieces) {
    if (pieces.size() <= voxelize::kMostAlike || mesh2vol::tellsObjectsApart(o)) return;
    std::vector<Piece> joined;
    for (Piece& piece : pieces) {
        const auto same = std::find_if(joined.begin(), joined.end(), [&](const Piece& other) {
            return other.material == piece.material;
        });
        if (same == joined.end()) {
            if (piece.material) piece.name = piece.material->name;
            joined.push_back(std::move(piece));
        } else {
            mesh::append(same->mesh, piece.mesh);
        }
    }
    if (joined.size() == pieces.size()) return;
    session.note(title + ": " + std::to_string(pieces.size()) + " objects, " +
                 (joined.size() == 1 ? "all alike and more than " : "more than ") +
                 std::to_string(voxelize::kMostAlike) + ", are taken as " +
                 (joined.size() == 1 ? "one" : std::to_string(joined.size()) + ", one a material"));
    if (joined.size() == 1) joined.front().name.clear();
    pieces = std::move(joined);
}

/// Open pieces that their file calls opaque become plates behind their faces, thick enough for the
/// voxels.
void makePlates(tool::Session& session, const voxelize::Params& scene, const std::string& title,
                double voxelSize, std::vector<Piece>& pieces) {
    constexpr double kThickness = voxelize::kThinnestWall + 1; // [voxel]
    std::vector<std::string> names;
    for (Piece& piece : pieces) {
        if (piece.isGlass() || scene.bounds) continue;
        if (mesh::checkTopology(piece.mesh).boundaryEdges == 0) continue;
        if (mesh::makePlate(piece.mesh, kThickness * voxelSize).empty())
            names.push_back(piece.name.empty() ? title : "'" + piece.name + "'");
    }
    if (!names.empty())
        session.warn(title + ": open and opaque, made plates of " + toText(kThickness) +
                     " voxels behind their faces: " + join(names, ", "));
}

/// The edge of a voxel, before objects are checked.
double voxelSizeOf(voxelize::Params scene, const std::vector<mesh2vol::ReadFile>& files) {
    mesh::Box box;
    for (const mesh2vol::ReadFile& file : files)
        for (const Piece& piece : file.pieces) box.include(mesh::boundingBox(piece.mesh));
    voxelize::Object all;
    all.mesh = {{box.min, box.max}, {{0, 1, 1}}};
    scene.objects.push_back(std::move(all));
    return voxelize::voxelSizeOf(scene);
}

/// Reads and checks every object of every mesh.
Objects readObjects(tool::Session& session, const mesh2vol::Options& o) {
    std::vector<mesh2vol::ReadFile> files(o.meshes.size());
    const voxelize::Params scene = mesh2vol::sceneOf(o);
    size_t count = 0;
    for (size_t i = 0; i < files.size(); ++i) {
        session.pass("read", [&] {
            files[i] = mesh2vol::readFile(o.meshes[i], !mesh2vol::tellsAnyMatter(o));
        });
        for (const std::string& warning : files[i].warnings) session.warn(warning);
        for (const std::string& note : files[i].notes) session.note(note);
        count += files[i].pieces.size();
    }
    const bool opaque = std::any_of(files.begin(), files.end(), [](const auto& file) {
        return std::any_of(file.pieces.begin(), file.pieces.end(),
                           [](const Piece& piece) { return !piece.isGlass(); });
    });
    if (opaque && !o.repair) {
        const double voxelSize = voxelSizeOf(scene, files);
        for (size_t i = 0; i < files.size(); ++i)
            makePlates(session, scene, mesh::meshTitle(o.meshes[i]), voxelSize, files[i].pieces);
    }
    Objects objects;
    for (size_t file = 0; file < files.size(); ++file) {
        std::vector<Piece>& pieces = files[file].pieces;
        const std::string path = mesh::meshTitle(o.meshes[file]);
        for (size_t k = 0; k < pieces.size(); ++k) {
            const mesh2vol::ObjectValues values(
                o, {objects.sources.size() + k, count, file, files.size()});
            std::string title = path;
            if (!pieces[k].name.empty()) title += ": '" + pieces[k].name + "'";
            accept(session, title, o.repair,
                   voxelize::sheetDomainOf(scene, values.yes("--fill-below")), pieces[k].mesh,
                   objects.facts);
        }
        joinAlike(session, o, path, pieces);
        for (Piece& piece : pieces) {
            mesh2vol::Source source{file, piece.name};
            if (piece.material) {
                source.material = mesh2vol::materialOf(*piece.material, piece.mesh);
                source.materialText = mesh2vol::materialText(*piece.material);
            }
            objects.sources.push_back(std::move(source));
            objects.meshes.push_back(std::move(piece.mesh));
        }
    }
    return objects;
}

void explain(const tool::Session& session, const voxelize::Params& params,
             const voxelize::Plan& plan, Facts facts) {
    const voxelize::Lattice& lattice = plan.lattice;
    const auto three = [](const auto& v) {
        return toText(static_cast<double>(v.x)) + ", " + toText(static_cast<double>(v.y)) + ", " +
               toText(static_cast<double>(v.z));
    };
    facts.emplace_back("voxels", three(lattice.size));
    facts.emplace_back("voxel size", toText(lattice.voxelSize));
    facts.emplace_back("low corner", three(lattice.low));
    facts.emplace_back("samples per voxel", std::to_string(lattice.most()));
    facts.emplace_back("memory for grids", bytesText(static_cast<double>(plan.hostBytes)));
    if (const auto wall = voxelize::thinnestWallVoxels(plan))
        facts.emplace_back("thinnest wall", toText(*wall) + " voxels");
    session.explain(plan.effects, voxelize::thinWallWarnings(params, plan), facts);
}

std::string trianglesOf(const voxelize::Params& params) {
    size_t triangles = 0;
    for (const voxelize::Object& object : params.objects) triangles += object.mesh.triangles.size();
    return std::to_string(triangles);
}

/// lightsim holds a float a voxel in one buffer: more than fits is told before it is lit.
void warnOfLightsim(tool::Session& session, const volume::Volume& volume) {
    const std::int64_t most = session.device().limits().storageBufferBytes / 4;
    const auto lit = [](const volume::GridFacts& grid) {
        return grid.name.rfind("scattering", 0) == 0 || grid.name.rfind("opacity", 0) == 0;
    };
    const std::vector<volume::GridFacts> grids = volume.grids();
    if (volume.domain().voxels() <= most || std::none_of(grids.begin(), grids.end(), lit)) return;
    const glm::ivec3 size = volume.domain().size();
    session.warn(std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                 std::to_string(size.z) +
                 " voxels are more than lightsim can light on this device, " +
                 std::to_string(most) + " at most: expected a lower --resolution");
}

void voxelizeMeshes(tool::Session& session, const mesh2vol::Options& o) {
    mesh2vol::checkBeforeReading(o);
    if (session.outputPaths().size() > 1)
        throw UsageError("-o: given " + std::to_string(session.outputPaths().size()) +
                         " times, expected once");
    session.guardInputs(o.meshes);
    if (!session.explains()) session.outputs(); // a bad path shows before the work
    Objects objects = readObjects(session, o);
    voxelize::Params params = mesh2vol::paramsOf(o, objects.sources);
    for (const auto& fact : mesh2vol::materialFacts(o, objects.sources, params))
        objects.facts.push_back(fact);
    if (o.unit && !mesh2vol::absorbsByName(o, objects.sources))
        session.warn("--unit: nothing absorbs by its material's name: does nothing");
    for (size_t k = 0; k < params.objects.size(); ++k)
        params.objects[k].mesh = std::move(objects.meshes[k]);
    session.pass("smooth", [&] {
        for (const std::string& warning : voxelize::curveObjects(params, session.stats()))
            session.warn(warning);
    });
    objects.facts.emplace_back("triangles, curved by --smooth", trianglesOf(params));
    voxelize::addGround(params);
    if (params.ground) objects.facts.emplace_back("ground", mesh2vol::groundText(*params.ground));
    voxelize::Plan plan;
    session.pass("plan", [&] { plan = voxelize::makePlan(params); });
    if (session.explains()) {
        explain(session, params, plan, objects.facts);
        return;
    }
    const voxelize::Result result =
        voxelize::voxelize(session.device(), params, plan, session.stats(), session.progress());
    for (const std::string& warning : result.warnings) session.warn(warning);
    warnOfLightsim(session, result.volume);
    AtomicFile& out = *session.outputs().at(0);
    session.pass("write", [&] { result.volume.write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("mesh2vol", "Turns closed surfaces and what they are made of into a "
                                      "scene volume.");
    mesh2vol::Options options;
    mesh2vol::addOptions(session.app(), options);
    session.requireOneOf({"--ior", "--material", "--metal"}, [&] {
        return std::any_of(options.meshes.begin(), options.meshes.end(),
                           mesh2vol::mayBringMaterials);
    });
    return session.run(argc, argv, [&](tool::Session&) { voxelizeMeshes(session, options); });
}
