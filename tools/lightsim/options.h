// lightsim's command line, and the simulation that it describes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "common/session.h"
#include "common/tracing.h"
#include "image/lat_long.h"
#include "lightsim/params.h"
#include "scene/surface_voxels.h"
#include "scene_lights.h"

#include <charconv>

namespace options {

using namespace eikonal;

struct Options {
    std::string input, method = "auto", outputs = "auto", detail = "auto", photons = "auto",
                       samples = "auto", proxy, octree, points, fronts;
    double mapTurn = 0;
    bool mapZUp = false;
    std::vector<std::string> lights, lightFiles;
    volume::GridNames names;
    lightsim::Params params;
    std::optional<tool::TracingOptions> tracing;
};

inline void add(tool::Session& session, Options& o) {
    CLI::App& app = session.app();
    lightsim::Params& p = o.params;
    app.add_option("input", o.input, "scene volume; - is standard input")
        ->type_name("IN.vdb")
        ->required();
    app.add_option(
           "--light", o.lights,
           "a light, named NAME=SPEC if wanted; may be given again, and must without --lights: "
           "directional:DX,DY,DZ[:R,G,B[:DEG]], the direction the light travels in, its "
           "irradiance [W/m²] and its disc's diameter (the sun's: 0.53); "
           "point:X,Y,Z[:R,G,B], its position and radiant intensity [W/sr]; "
           "spot:X,Y,Z:DX,DY,DZ:ANGLE[:SOFT][:R,G,B], a point that shines within ANGLE of "
           "its axis [degree], fading within ANGLE ± SOFT; "
           "rect:CX,CY,CZ:UX,UY,UZ:VX,VY,VZ[:R,G,B], centre and two whole edges, radiance "
           "[W/(m² sr)] to the side of U x V; "
           "sphere:X,Y,Z:RADIUS[:R,G,B], radiance; "
           "environment:FILE[:LAYER], a lat-long map of radiance all round. Behind any but the "
           "last :polarizer=X,Y,Z puts a polariser before it, which lets half through, with E in "
           "the plane of X,Y,Z and the ray")
        ->type_name("SPEC")
        ->allow_extra_args(false);
    app.add_option("--lights", o.lightFiles,
                   "the lights of a glTF scene (KHR_lights_punctual; a watt is 683 lumens), before "
                   "those of --light; may be given again")
        ->type_name("SCENE.glb")
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

inline lightsim::Output parseOutputs(const std::string& list) {
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
inline int parseCount(const std::string& option, const std::string& text, int most) {
    if (text == "auto") return 0;
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count < 1)
        throw UsageError(option + ": found '" + text + "', expected auto or 1 to " +
                         std::to_string(most));
    return count;
}

inline std::int64_t parsePhotons(const std::string& text) {
    const auto number = parseNumbers(text, ',');
    if (!number || number->size() != 1)
        throw UsageError("--photons: found '" + text + "', expected auto or a whole number");
    return lightsim::photonCount((*number)[0]);
}

/// Lights with their names, which are their numbers where none is given.
inline void parseLights(Options& o) {
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

/// Makes parameters of what was given. Throws UsageError, and as readers do of files of lights.
inline void finish(tool::Session& session, Options& o) {
    std::vector<std::string> specs;
    for (const std::string& path : o.lightFiles)
        for (const std::string& spec : scene_lights::read(session, path)) specs.push_back(spec);
    o.lights.insert(o.lights.begin(), specs.begin(), specs.end());
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
}

} // namespace options
