// mesh2vol: turns closed surfaces and what they are made of into a scene volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/session.h"
#include "gpu/device.h"
#include "mesh/read.h"
#include "mesh2vol/options.h"
#include "voxelize/accept.h"
#include "voxelize/voxelize.h"

#include <algorithm>

using namespace eikonal;

namespace {

/// Reads and checks every mesh; gives "name: text" lines for --explain.
std::vector<std::pair<std::string, std::string>>
readMeshes(tool::Session& session, const mesh2vol::Options& o, voxelize::Params& params) {
    std::vector<std::pair<std::string, std::string>> facts;
    for (size_t k = 0; k < o.meshes.size(); ++k) {
        const std::string& path = o.meshes[k];
        voxelize::Object& object = params.objects[k];
        session.pass("read", [&] { object.mesh = mesh::readMesh(path); });
        voxelize::Acceptance found;
        session.pass("check", [&] { found = voxelize::acceptMesh(object.mesh, path, o.repair); });
        facts.emplace_back("mesh " + path, join(found.findings, "; "));
        if (!found.repairs.empty())
            facts.emplace_back("repairs to " + path, join(found.repairs, "; "));
        session.say(path + ": " + found.findings.front());
        for (size_t i = 1; i < found.findings.size(); ++i)
            session.note(path + ": " + found.findings[i]);
        for (const std::string& repair : found.repairs) session.note(path + ": " + repair);
        if (found.crosses)
            session.warn(path + ": triangles cross each other: what lies between them counts as "
                                "inside where the surface winds around it");
    }
    return facts;
}

void explain(const tool::Session& session, const voxelize::Params& params,
             const voxelize::Plan& plan, std::vector<std::pair<std::string, std::string>> facts) {
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
    voxelize::Params params = mesh2vol::paramsOf(o);
    if (session.outputPaths().size() > 1)
        throw UsageError("-o: given " + std::to_string(session.outputPaths().size()) +
                         " times, expected once");
    session.guardInputs(o.meshes);
    if (!session.explains()) session.outputs(); // a bad path shows before the work
    const auto facts = readMeshes(session, o, params);
    voxelize::Plan plan;
    session.pass("plan", [&] { plan = voxelize::makePlan(params); });
    if (session.explains()) {
        explain(session, params, plan, facts);
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
