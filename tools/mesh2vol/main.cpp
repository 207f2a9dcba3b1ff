// mesh2vol: turns closed surfaces and what they are made of into a scene volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"
#include "gpu/device.h"
#include "mesh/read.h"
#include "mesh2vol/objects.h"
#include "voxelize/accept.h"
#include "voxelize/curve.h"
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

/// Checks a mesh, repairs it where asked for, and tells what was found.
void accept(tool::Session& session, const std::string& title, bool repair, mesh::TriangleMesh& mesh,
            Facts& facts) {
    voxelize::Acceptance found;
    session.pass("check", [&] { found = voxelize::acceptMesh(mesh, title, repair); });
    facts.emplace_back("mesh " + title, join(found.findings, "; "));
    if (!found.repairs.empty())
        facts.emplace_back("repairs to " + title, join(found.repairs, "; "));
    session.say(title + ": " + found.findings.front());
    for (size_t i = 1; i < found.findings.size(); ++i)
        session.note(title + ": " + found.findings[i]);
    for (const std::string& done : found.repairs) session.note(title + ": " + done);
    for (const std::string& warning : found.warnings) session.warn(title + ": " + warning);
}

/// Many objects of a file are one where no option tells them apart.
void joinAlike(tool::Session& session, const mesh2vol::Options& o, const std::string& title,
               std::vector<mesh::Part>& parts) {
    constexpr size_t most = voxelize::kMostAlike;
    if (parts.size() <= most || mesh2vol::tellsObjectsApart(o)) return;
    session.note(title + ": " + std::to_string(parts.size()) +
                 " objects, all alike and more than " + std::to_string(most) +
                 ", are taken as one");
    mesh::Part all;
    for (const mesh::Part& part : parts) mesh::append(all.mesh, part.mesh);
    parts.assign(1, std::move(all));
}

/// Reads and checks every object of every mesh.
Objects readObjects(tool::Session& session, const mesh2vol::Options& o) {
    Objects objects;
    for (size_t file = 0; file < o.meshes.size(); ++file) {
        const std::string& path = o.meshes[file];
        std::vector<mesh::Part> parts;
        session.pass("read", [&] { parts = mesh::readParts(path); });
        for (mesh::Part& part : parts) {
            std::string title = mesh::meshTitle(path);
            if (!part.name.empty()) title += ": '" + part.name + "'";
            accept(session, title, o.repair, part.mesh, objects.facts);
        }
        joinAlike(session, o, mesh::meshTitle(path), parts);
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
    for (size_t k = 0; k < params.objects.size(); ++k)
        params.objects[k].mesh = std::move(objects.meshes[k]);
    session.pass("smooth", [&] {
        for (const std::string& warning : voxelize::curveObjects(params, session.stats()))
            session.warn(warning);
    });
    objects.facts.emplace_back("triangles, curved by --smooth", trianglesOf(params));
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
    return session.run(argc, argv, [&](tool::Session&) { voxelizeMeshes(session, options); });
}
