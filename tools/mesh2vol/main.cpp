// mesh2vol: turns closed surfaces and what they are made of into a scene volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"
#include "gpu/device.h"
#include "mesh/read.h"
#include "mesh2vol/material_facts.h"
#include "voxelize/accept.h"
#include "voxelize/curve.h"
#include "voxelize/ground.h"
#include "voxelize/voxelize.h"

#include <algorithm>

using namespace eikonal;

namespace {

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

/// Whether the objects of a file are one, as they are where they are many and no option tells them
/// apart.
bool areOne(const mesh2vol::Options& o, const std::vector<mesh::Part>& parts) {
    return parts.size() > voxelize::kMostAlike && !mesh2vol::tellsObjectsApart(o);
}

void joinAlike(tool::Session& session, const std::string& title, std::vector<mesh::Part>& parts) {
    session.note(title + ": " + std::to_string(parts.size()) +
                 " objects, all alike and more than " + std::to_string(voxelize::kMostAlike) +
                 ", are taken as one");
    mesh::Part all;
    for (const mesh::Part& part : parts) mesh::append(all.mesh, part.mesh);
    parts.assign(1, std::move(all));
}

/// Reads and checks every object of every mesh.
Objects readObjects(tool::Session& session, const mesh2vol::Options& o) {
    std::vector<std::vector<mesh::Part>> files(o.meshes.size());
    size_t count = 0;
    for (size_t file = 0; file < files.size(); ++file) {
        session.pass("read", [&] { files[file] = mesh::readParts(o.meshes[file]); });
        count += areOne(o, files[file]) ? 1 : files[file].size();
    }
    const voxelize::Params scene = mesh2vol::sceneOf(o);
    Objects objects;
    for (size_t file = 0; file < files.size(); ++file) {
        std::vector<mesh::Part>& parts = files[file];
        const std::string path = mesh::meshTitle(o.meshes[file]);
        const bool one = areOne(o, parts);
        for (size_t part = 0; part < parts.size(); ++part) {
            const size_t object = objects.sources.size() + (one ? 0 : part);
            const mesh2vol::ObjectValues values(o, {object, count, file, files.size()});
            std::string title = path;
            if (!parts[part].name.empty()) title += ": '" + parts[part].name + "'";
            accept(session, title, o.repair,
                   voxelize::sheetDomainOf(scene, values.yes("--fill-below")), parts[part].mesh,
                   objects.facts);
        }
        if (one) joinAlike(session, path, parts);
        for (mesh::Part& part : parts) {
            objects.sources.push_back({file, part.name});
            objects.meshes.push_back(std::move(part.mesh));
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
    session.requireOneOf({"--ior", "--material", "--metal"});
    return session.run(argc, argv, [&](tool::Session&) { voxelizeMeshes(session, options); });
}
