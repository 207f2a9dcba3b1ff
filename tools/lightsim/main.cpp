// lightsim: sends the light of a scene through its volume and stores what arrives in each voxel.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/session.h"
#include "common/tracing.h"
#include "front_files.h"
#include "image/lat_long.h"
#include "image/picture.h"
#include "lightsim/lightsim.h"
#include "mesh/check.h"
#include "mesh/read.h"
#include "mesh/smooth_surface.h"
#include "picture_points.h"
#include "scene/effects.h"
#include "scene/surface_voxels.h"

#include <charconv>
#include <filesystem>

using namespace eikonal;

namespace {

struct Options {
    std::string input, method = "auto", outputs = "auto", detail = "auto", photons = "auto",
                       samples = "auto", proxy, octree, points, fronts;
    double mapTurn = 0;
    bool mapZUp = false;
    std::vector<std::string> lights;
    volume::GridNames names;
    lightsim::Params params;
    std::optional<tool::TracingOptions> tracing;
};

void addOptions(tool::Session& session, Options& o) {
    CLI::App& app = session.app();
    lightsim::Params& p = o.params;
    app.add_option("input", o.input, "scene volume; - is standard input")
        ->type_name("IN.vdb")
        ->required();
    app.add_option("--light", o.lights,
                   "a light, named NAME=SPEC if wanted; may be given again: "
                   "directional:DX,DY,DZ[:R,G,B[:DEG]], the direction the light travels in, its "
                   "irradiance [W/m²] and its disc's diameter (the sun's: 0.53); "
                   "point:X,Y,Z[:R,G,B], its position and radiant intensity [W/sr]; "
                   "spot:X,Y,Z:DX,DY,DZ:ANGLE[:SOFT][:R,G,B], a point that shines within ANGLE of "
                   "its axis [degree], fading within ANGLE ± SOFT; "
                   "rect:CX,CY,CZ:UX,UY,UZ:VX,VY,VZ[:R,G,B], centre and two whole edges, radiance "
                   "[W/(m² sr)] to the side of U x V; "
                   "sphere:X,Y,Z:RADIUS[:R,G,B], radiance; "
                   "environment:FILE[:LAYER], a lat-long map of radiance all round")
        ->type_name("SPEC")
        ->required()
        ->allow_extra_args(false);
    app.add_option("--light-samples", o.samples,
                   "points or directions that stand for a light with an extent; auto: of photons "
                   "256, of beams up to 64")
        ->type_name("N")
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--env-up", [&o](const std::string& axis) { o.mapZUp = axis == "z"; },
           "an environment's up axis: y (OpenEXR's), or z")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option("--env-rotate", o.mapTurn, "turn environments about their up axis [degree]")
        ->type_name("DEG");
    app.add_option("--method", o.method,
                   "how light is carried: photons, beams, auto (to surfaces by beams, through "
                   "volumes by photons), or wavefront (to surfaces by beams, through volumes by "
                   "wavefronts)")
        ->capture_default_str();
    app.add_option("--outputs", o.outputs,
                   "auto (what a render of the file needs, possibly nothing), or a list of "
                   "fluence,light_direction,irradiance")
        ->type_name("LIST")
        ->capture_default_str();
    app.add_option("--photons", o.photons,
                   "pixels of each light's photon map; auto: thirty-six, and a cell of beams, a "
                   "voxel of what the light sees")
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--surface-detail", o.detail,
                   "fine voxels along an edge of a voxel, by which surfaces receive light; auto: "
                   "up to 8, some two millions in all")
        ->type_name("K")
        ->capture_default_str();
    app.add_option("--at", o.points,
                   "light for the points of a picture: its layers position and normal, as render "
                   "--aov writes them; the output is an .exr with the layers irradiance, "
                   "irradiance_direction")
        ->type_name("POINTS.exr");
    app.add_flag("--lights-apart", p.lightsApart,
                 "beside OUT.vdb, which has all light, OUT.NAME.vdb of each light, which is its "
                 "number where it has no name; with --at its layers irradiance_NAME and so on");
    app.add_option("--beam-error", p.beamError,
                   "how far off what is inside a beam may be, about [fine voxel]")
        ->type_name("E")
        ->default_str("1/3");
    app.add_option("--shadow-cull", p.shadowCull,
                   "beams: a part of the light's map of which so much leads to no surface that "
                   "receives, being in shadow, is not split; 1: what is wholly so")
        ->type_name("SHARE")
        ->capture_default_str();
    app.add_option("--bounces", p.bounces,
                   "times that opaque surfaces send on what falls on them, by their albedo")
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--octree-tolerance", p.octreeTolerance,
                   "index range within which a leaf of the octree is constant")
        ->type_name("E")
        ->capture_default_str();
    auto* second = app.add_option("--octree-tolerance2", p.octreeTolerance2,
                                  "index range within which a leaf limits steps")
                       ->type_name("E")
                       ->capture_default_str();
    app.add_option("--step-limit", p.stepLimit, "longest step within --octree-tolerance2 [voxel]")
        ->type_name("VOXELS")
        ->capture_default_str();
    app.add_option("--step-min", p.stepMin, "shortest step [voxel]")
        ->type_name("VOXELS")
        ->capture_default_str();
    app.add_option("--max-steps", p.maxSteps, "steps after which a photon counts as trapped")
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--drop-below", p.dropBelow, "drop a photon at this share of its power")
        ->type_name("SHARE")
        ->capture_default_str();
    app.add_option("--thin-to", p.thinTo, "stop when this share of the photons is left")
        ->type_name("SHARE")
        ->capture_default_str();
    app.add_option("--smoothing", p.smoothing, "rounds of 3x3x3 smoothing of the result")
        ->type_name("N")
        ->capture_default_str();
    o.tracing.emplace(app, "longest step [voxel]; default: as the octree allows", p.maxDepth,
                      "a photon");
    session.acceptOldName(o.tracing->toleranceOption(), "--trace-tolerance");
    session.acceptOldName(second, "--tolerance2",
                          ", and the octree's other one --octree-tolerance: --tolerance is the "
                          "error of a photon's exit");
    app.add_option(
           "--proxy", o.proxy,
           "closed mesh on which photons start, not on the domain's box; curved as mesh2vol "
           "--smooth does by default")
        ->type_name("MESH");
    app.add_option("--dump-octree", o.octree,
                   "write the octree that photons step by: grids octree_level, octree_step [voxel]")
        ->type_name("FILE.vdb");
    app.add_option("--dump-fronts", o.fronts,
                   "with --method wavefront: write the front after each step of time as a mesh of "
                   "quads, front_0001.ply and so on, each with its power [W] and irradiance [W/m²]")
        ->type_name("DIR");
    tool::addGridNames(app, o.names,
                       {"ior", "absorption", "scattering", "anisotropy", "opacity", "sdf"});
}

lightsim::Output parseOutputs(const std::string& list) {
    unsigned outputs = 0;
    for (const std::string& item : split(list, ',')) {
        if (item == "fluence")
            outputs |= static_cast<unsigned>(lightsim::Output::fluence);
        else if (item == "light_direction")
            outputs |= static_cast<unsigned>(lightsim::Output::direction);
        else if (item == "irradiance")
            outputs |= static_cast<unsigned>(lightsim::Output::irradiance);
        else
            throw UsageError("--outputs: found '" + item +
                             "', expected auto, fluence, light_direction or irradiance");
    }
    return static_cast<lightsim::Output>(outputs);
}

/// A whole number from 1 on, or 0 for auto.
int parseCount(const std::string& option, const std::string& text, int most) {
    if (text == "auto") return 0;
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count < 1)
        throw UsageError(option + ": found '" + text + "', expected auto or 1 to " +
                         std::to_string(most));
    return count;
}

std::int64_t parsePhotons(const std::string& text) {
    const auto number = parseNumbers(text, ',');
    if (!number || number->size() != 1)
        throw UsageError("--photons: found '" + text + "', expected auto or a whole number");
    return lightsim::photonCount((*number)[0]);
}

/// The proxy. Photons start where light first meets it, so it must be closed and outward.
mesh::TriangleMesh readProxy(const std::string& path) {
    const mesh::TriangleMesh mesh = mesh::readMesh(path);
    const mesh::MeshReport report = mesh::checkTopology(mesh);
    if (!report.boundsVolume())
        throw DataError(path + ": " + join(report.sentences(), "; ") +
                        "; expected a closed surface that looks outward");
    return mesh;
}

/// Lights with their names, which are their numbers where none is given.
void parseLights(Options& o) {
    for (const std::string& spec : o.lights) {
        lightsim::Light light = lightsim::parseLight(spec);
        if (light.name.empty()) light.name = std::to_string(o.params.lights.size() + 1);
        for (const lightsim::Light& other : o.params.lights)
            if (other.name == light.name)
                throw UsageError("--light: two are named " + light.name +
                                 ", expected different names");
        light.mapFromWorld = image::mapFromWorld(o.mapTurn, o.mapZUp);
        o.params.lights.push_back(std::move(light));
    }
}

std::vector<std::string> inputsOf(const Options& o) {
    std::vector<std::string> inputs{o.input, o.proxy, o.points};
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

/// Where a light stands that sends all its rays from a few points.
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

/// Light that is there replaces what the volume held.
void putGrids(volume::Volume& volume, const lightsim::Plan& plan, const lightsim::Result& light) {
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
    parseLights(o);
    o.params.method = lightsim::parseMethod(o.method);
    if (o.photons != "auto") o.params.photons = parsePhotons(o.photons);
    o.params.surfaceDetail = parseCount("--surface-detail", o.detail, scene::kMostDetail);
    o.params.lightSamples = parseCount("--light-samples", o.samples, lightsim::kMostLightSamples);
    o.params.automaticOutputs = o.outputs == "auto";
    if (!o.params.automaticOutputs) o.params.outputs = parseOutputs(o.outputs);
    o.params.seed = session.seed();
    o.params.tracing = o.tracing->finish();
    if (session.app().count("--octree-tolerance2") == 0)
        o.params.octreeTolerance2 = std::max(o.params.octreeTolerance2, o.params.octreeTolerance);
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
        if (proxy) o.params.proxy = curvedProxy(*proxy, volume->frame().voxelSize, o);
        if (!o.points.empty()) {
            points = picture_points::read(o.points);
            o.params.points = picture_points::pointsOf(points);
        }
        plan = lightsim::makePlan(*volume, o.params);
    });
    if (session.explains()) {
        session.explain(plan->effects, plan->warnings,
                        {{"voxels", scene::sizeText(plan->scene)},
                         {"lights", std::to_string(o.params.lights.size())},
                         {"photons", o.photons == "auto" ? "auto: 36 a voxel that the light sees"
                                                         : o.photons + " per light at most"},
                         {"tracing", plan->bends ? o.params.tracing.text() : "straight"}});
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
            putGrids(*volume, *plan, its);
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
        if (o.points.empty()) session.pass("grids", [&] { putGrids(*volume, *plan, result); });
    }
    if (fronts) fronts->write(session);
    if (!o.points.empty()) return writeLight(session, o, *volume, points, result);
    session.pass("write", [&] { volume->write(out, session.history()); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("lightsim", "Sends light through a scene volume along curved paths and "
                                      "writes fluence and direction per voxel.");
    Options options;
    addOptions(session, options);
    return session.run(argc, argv, [&](tool::Session&) { simulate(session, options); });
}
