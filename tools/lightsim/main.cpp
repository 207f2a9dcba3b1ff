// lightsim: sends the light of a scene through its volume and stores what arrives in each voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "front_files.h"
#include "image/picture.h"
#include "lightsim/environment.h"
#include "lightsim/lightsim.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "mesh/smooth_surface.h"
#include "options.h"
#include "picture_points.h"
#include "scene/effects.h"
#include "scene/recorded_lights.h"
#include "volume/ground.h"

#include <filesystem>

using namespace eikonal;
using options::Options;

namespace {

/// The proxy. Photons start where light first meets it, so it must be closed and outward.
mesh::TriangleMesh readProxy(const std::string& path) {
    const mesh::TriangleMesh mesh = mesh::readMesh(path);
    const mesh::MeshReport report = mesh::checkTopology(mesh);
    if (!report.boundsVolume())
        throw DataError(path + ": " + join(report.sentences(), "; ") +
                        "; expected a closed surface that looks outward");
    return mesh;
}

std::vector<std::string> inputsOf(const Options& o) {
    std::vector<std::string> inputs{o.input, o.proxy, o.points};
    inputs.insert(inputs.end(), o.lightFiles.begin(), o.lightFiles.end());
    for (const lightsim::Light& light : o.params.lights)
        inputs.push_back(image::parsePictureName(light.file).path);
    return inputs;
}

void readEnvironments(tool::Session& session, Options& o) {
    for (lightsim::Light& light : o.params.lights) {
        if (light.kind != lightsim::Light::Kind::environment) continue;
        image::Environment read = image::readEnvironment(image::parsePictureName(light.file));
        for (const std::string& warning : read.warnings) session.warn(warning);
        light.map = std::make_shared<image::Image>(std::move(read.map));
    }
}

/// Whether a light, or the middle of an extended one, stands within a closed mesh.
bool isInside(const lightsim::Light& light, const mesh::TriangleMesh& mesh) {
    return light.hasPlace() && mesh::windingNumber(mesh, light.vector) > 0.5;
}

/// A proxy's triangles, curved as mesh2vol does by default: an object's own mesh then holds all of
/// the object, and its outline is the object's. No light may be inside.
lightsim::Triangles curvedProxy(const mesh::TriangleMesh& flat, double voxelSize,
                                const Options& o) {
    mesh::SmoothCounts counts;
    const mesh::TriangleMesh mesh = mesh::curved(flat, mesh::findFans(flat, mesh::kUsualSmooth),
                                                 mesh::kSagitta * voxelSize, counts);
    for (const lightsim::Light& light : o.params.lights)
        if (isInside(light, mesh))
            throw UsageError("--proxy: a light is inside " + o.proxy + ", expected outside");
    lightsim::Triangles corners;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i) corners.push_back(mesh.points[triangle[i]]);
    return corners;
}

void writeOctree(tool::Session& session, const Options& o, const volume::Volume& in,
                 const lightsim::Plan& plan) {
    const lightsim::OctreeDump dump = lightsim::dumpOctree(plan, o.params);
    volume::Volume out(in.frame());
    volume::PutOptions options;
    options.allActive = true;
    out.put("octree_level", in.domain(), dump.level, options);
    out.put("octree_step", in.domain(), dump.stepLimit, options);
    out.write(session.extraOutput(o.octree), session.history());
}

/// Whether the lights are recorded: beyond the domain a ground has no voxels that hold light.
bool recordsLights(const volume::Volume& volume, const lightsim::Plan& plan) {
    return plan.wants(lightsim::Output::irradiance) && volume::groundOf(volume).has_value();
}

/// A line a light.
void recordLights(volume::Volume& volume, const std::vector<lightsim::Light>& lights) {
    std::vector<std::string> lines;
    for (const lightsim::Light& light : lights)
        lines.push_back(
            scene::recordOf(light, light.map ? lightsim::upwardIrradiance(light) : glm::dvec3(0)));
    volume.setMetadata(scene::kLightsKey, join(lines, "\n"));
}

/// Light that is there, of these lights, replaces what the volume held.
void putGrids(volume::Volume& volume, const lightsim::Plan& plan, const lightsim::Result& light,
              const std::vector<lightsim::Light>& lights) {
    if (recordsLights(volume, plan)) recordLights(volume, lights);
    volume::PutOptions options;
    options.vectorType = "color";
    if (plan.wants(lightsim::Output::fluence))
        volume.put("fluence", volume.domain(), light.fluence, options);
    options.vectorType = "vector";
    if (plan.wants(lightsim::Output::direction))
        volume.put("light_direction", volume.domain(), light.direction, options);
    if (!light.irradiance.empty()) volume.putFine("irradiance", volume.domain(), light.irradiance);
}

/// The file of a light apart: OUT.NAME.vdb.
std::string pathOf(const tool::Session& session, const lightsim::Light& light) {
    std::filesystem::path path = session.outputPaths().at(0);
    const std::string extension = path.extension();
    return path.replace_extension(light.name + extension);
}

/// What --lights-apart writes beside the output.
std::vector<std::string> filesApart(const tool::Session& session, const Options& o) {
    std::vector<std::string> files;
    if (!o.params.lightsApart || !o.points.empty()) return files;
    const std::string& path = session.outputPaths().at(0);
    if (path == "-" || writtenInPlace(path))
        throw UsageError("--lights-apart: found the output " + path +
                         ", expected a file's name, beside which each light's is written");
    for (const lightsim::Light& light : o.params.lights) files.push_back(pathOf(session, light));
    return files;
}

/// What fell on a picture's points, as a picture.
void writeLight(tool::Session& session, const Options& o, const volume::Volume& volume,
                const image::Image& points, const lightsim::Result& result) {
    const History history = session.history();
    image::ImageAttributes attributes;
    attributes.strings = {
        {"eikonal:tool", history.tool},
        {"eikonal:version", history.version},
        {"eikonal:command", appendHistory(volume.metadata("eikonal:command"), history.command)}};
    std::vector<std::string> apart;
    for (const lightsim::Light& light : o.params.lights)
        if (o.params.lightsApart) apart.push_back(light.name);
    const image::Image light = picture_points::lightOf(points, apart, result.points);
    session.pass("write", [&] {
        image::writeExr(light, attributes, *session.outputs().at(0), session.threads());
    });
}

/// --at stands beside options that it leaves no meaning, and its output is a picture.
void checkPoints(tool::Session& session, const Options& o) {
    if (!o.params.automaticOutputs)
        throw UsageError(
            "--outputs: given with --at, which writes irradiance; expected one of them");
    const std::string& path = session.outputPaths().at(0);
    if (!writtenInPlace(path) && !path.ends_with(".exr") && !path.ends_with(".EXR"))
        throw UsageError("--output: found '" + path +
                         "', expected a name ending in .exr with --at");
}

void simulate(tool::Session& session, Options& o) {
    options::finish(session, o);
    std::optional<FrontFiles> fronts;
    if (!o.fronts.empty())
        o.params.seeFront = [&](int step, const auto& front) { fronts->add(step, front); };
    o.params.check();
    std::vector<std::string> further = filesApart(session, o);
    further.push_back(o.octree);
    session.guardInputs(inputsOf(o), further);
    if (!o.points.empty()) checkPoints(session, o);
    std::optional<mesh::TriangleMesh> proxy;
    if (!o.proxy.empty()) proxy = readProxy(o.proxy);

    std::optional<volume::Volume> volume;
    std::optional<lightsim::Plan> plan;
    image::Image points;
    session.pass("read", [&] {
        readEnvironments(session, o);
        volume.emplace(volume::Volume::open(o.input, o.names));
        volume::groundOf(*volume); // refused, if it is, before the work
        if (proxy) o.params.proxy = curvedProxy(*proxy, volume->frame().voxelSize, o);
        if (!o.points.empty()) {
            points = picture_points::read(o.points);
            o.params.points = picture_points::pointsOf(points);
        }
        plan = lightsim::makePlan(*volume, o.params);
    });
    if (session.explains()) {
        std::vector<std::pair<std::string, std::string>> facts{
            {"voxels", scene::sizeText(plan->scene)},
            {"lights", std::to_string(o.params.lights.size())},
            {"photons", o.photons == "auto" ? "auto: 36 a voxel that the light sees"
                                            : o.photons + " per light at most"},
            {"tracing", plan->bends ? o.params.tracing.text() : "straight"}};
        if (recordsLights(*volume, *plan))
            facts.emplace_back("ground", "the lights are recorded for what lies beyond the domain");
        session.explain(plan->effects, plan->warnings, facts);
        return;
    }
    session.stats().effects = plan->effects;
    for (const std::string& warning : plan->warnings) session.warn(warning);
    AtomicFile& out = *session.outputs().at(0);
    if (!o.octree.empty()) writeOctree(session, o, *volume, *plan);
    if (!o.fronts.empty()) fronts.emplace(o.fronts);
    lightsim::Result result;
    if (plan->outputs == lightsim::Output::none) {
        for (const std::string& path : filesApart(session, o))
            volume->write(session.extraOutput(path), session.history());
        session.note(o.points.empty() ? "nothing in " + volume->path() +
                                            " scatters or receives light: nothing to simulate"
                                      : "no point of " + o.points + " is on an opaque surface of " +
                                            volume->path() + ": nothing to simulate");
    } else {
        const auto takeLight = [&](size_t light, const lightsim::Result& its) {
            putGrids(*volume, *plan, its, {o.params.lights[light]});
            volume->write(session.extraOutput(pathOf(session, o.params.lights[light])),
                          session.history());
        };
        result = lightsim::simulate(session.device(), *plan, o.params, session.stats(),
                                    session.progress(), takeLight);
        o.tracing->warnOf(session, "photons");
        tool::warnOfDropped(session, {{"light_dropped_by_depth", "--max-depth"},
                                      {"light_dropped_by_steps", "--max-steps"},
                                      {"light_dropped_by_thinning", "--thin-to"},
                                      {"light_dropped_as_dim", "--drop-below"}});
        if (o.points.empty())
            session.pass("grids", [&] { putGrids(*volume, *plan, result, o.params.lights); });
    }
    if (fronts) fronts->write(session);
    if (!o.points.empty()) return writeLight(session, o, *volume, points, result);
    session.pass("write", [&] { volume->write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("lightsim", "Sends light through a scene volume along curved paths and "
                                      "writes fluence and direction per voxel.");
    Options o;
    options::add(session, o);
    session.requireOneOf({"--light", "--lights"});
    return session.run(argc, argv, [&](tool::Session&) { simulate(session, o); });
}
