// What render's command line says.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/options.h"

#include "base/text.h"
#include "render/scene_camera.h"

#include <cmath>

namespace eikonal {

namespace {

void addCamera(tool::Session& session, Options& o) {
    CLI::App& app = session.app();
    camera::Camera& camera = o.params.camera;
    const char* const kGroup = "Camera";
    auto* file = app.add_option("--camera", o.sceneCamera,
                                "that of a glTF scene, by its node's name or its own; without one "
                                "the first; instead of the next five")
                     ->type_name("SCENE.glb[:NAME]")
                     ->group(kGroup);
    const auto isFile = [file] { return file->count() > 0; };
    tool::addVector(app, "--eye", camera.eye,
                    "where the camera stands [unit]; needed, as --target, --fov or --ortho, and "
                    "--size, without "
                    "--camera")
        ->excludes(file)
        ->group(kGroup);
    tool::addVector(app, "--target", camera.target, "the point it looks at [unit]")
        ->excludes(file)
        ->group(kGroup);
    tool::addVector(app, "--up", camera.up, "what is up in the picture; default 0,1,0")
        ->excludes(file)
        ->group(kGroup);
    auto* fov = app.add_option("--fov", camera.fov, "vertical angle of view [degree]")
                    ->type_name("DEG")
                    ->excludes(file)
                    ->group(kGroup);
    auto* ortho =
        app.add_option("--ortho", camera.height, "parallel projection of this height [unit]")
            ->type_name("HEIGHT")
            ->excludes(fov)
            ->excludes(file)
            ->group(kGroup);
    fov->excludes(ortho);
    app.add_option("--size", o.size,
                   "width and height of the picture [pixel]; with --camera by default of its "
                   "aspect, 640 along the longer edge")
        ->type_name("WxH")
        ->group(kGroup);
    session.requireOneOf({"--eye"}, isFile);
    session.requireOneOf({"--target"}, isFile);
    session.requireOneOf({"--size"}, isFile);
    session.requireOneOf({"--fov", "--ortho"}, isFile);
}

void addMeshOptions(CLI::App& app, Options& o) {
    const char* const kGroup = "Meshes";
    app.add_option(
           "--method", o.method,
           "trace (volumes); of meshes dir (refraction in image space, by a search in depth "
           "maps), isr (by a guess from distances), sir (one interface), rays (exact)")
        ->check(CLI::IsMember({"trace", "dir", "isr", "sir", "rays"}))
        ->capture_default_str()
        ->group(kGroup);
    app.add_option("--ior", o.ior, "index of the meshes; around them it is 1")
        ->type_name("N")
        ->group(kGroup);
    tool::addVector(app, "--absorption", o.absorption, "their absorption [1/unit]", true)
        ->type_name("R,G,B")
        ->group(kGroup);
    app.add_option("--search-steps", o.searchSteps, "dir: steps of the binary search")
        ->type_name("N")
        ->capture_default_str()
        ->group(kGroup);
    app.add_option(
           "--layers", o.layers,
           "dir: front and back faces behind each other that a pixel keeps, among which rays "
           "are followed until they leave; 0: the furthest back faces alone")
        ->type_name("N")
        ->capture_default_str()
        ->group(kGroup);
    app.add_option(
           "--plate", o.plates,
           "of volumes a picture upright behind the scene, as a photograph; of dir with --layers "
           "and of rays a matt mesh beside the body, lit by the surroundings, default albedo 0.8")
        ->type_name("PICTURE[:LAYER]|MESH[:R,G,B]")
        ->allow_extra_args(false)
        ->group(kGroup);
    app.add_option("--frames", o.frames,
                   "makes these pictures in one run; #### in names of meshes and outputs is the "
                   "frame's number")
        ->type_name("A-B[/STEP]")
        ->group(kGroup);
}

bool isGiven(const CLI::App& app, const std::string& name) {
    const CLI::Option* const option = app.get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
}

} // namespace

void addOptions(tool::Session& session, Options& o) {
    CLI::App& app = session.app();
    view::Params& p = o.params;
    app.add_option(
           "input", o.inputs,
           "scene volumes, - is standard input; of those on one transform the light adds up, "
           "others have places of their own. Or meshes, together one body, for the other methods")
        ->type_name("IN.vdb|MESH")
        ->required();
    app.add_option("--place", o.placed,
                   "moves a volume and its light: shifted [unit], turned about X, Y, Z [degree], "
                   "scaled; given "
                   "again for the same one, it is there again")
        ->type_name("FILE:TX,TY,TZ[:RX,RY,RZ[:S]]")
        ->allow_extra_args(false)
        ->group("Places");
    addCamera(session, o);
    app.add_option("--plate-distance", o.plateDistance,
                   "of the picture of --plate from the eye [unit]")
        ->type_name("D")
        ->group("Background");
    app.add_option("--plate-height", o.plateHeight,
                   "its height [unit]; without, it covers the view")
        ->type_name("H")
        ->group("Background");
    const auto addPolarizer = [&](const char* option, std::optional<double>& angle,
                                  const std::string& before) {
        app.add_option(option, angle,
                       "a linear polariser before " + before +
                           ", by the angle of E that it lets through, from the picture's right "
                           "towards its up [degree]")
            ->type_name("DEG")
            ->group("Polarisers");
    };
    addPolarizer("--polarizer", p.polarizer, "the camera");
    addPolarizer("--back-polarizer", p.backPolarizer,
                 "--env, --background and a picture of --plate");
    app.add_option("--unit", p.unit,
                   "metres in a unit of the scene: then the waves of crystals whose indices differ "
                   "by no more than 0.01 keep their phases, and interfere")
        ->type_name("METRES")
        ->group("Polarisers");
    auto* environment =
        app.add_option("--env", o.environment,
                       "lat-long environment map, EXR or another format; of an EXR a layer or part")
            ->type_name("FILE[:LAYER]")
            ->group("Background");
    tool::addVector(app, "--background", p.background, "radiance all round", true)
        ->type_name("R,G,B")
        ->excludes(environment)
        ->group("Background");
    app.add_option_function<std::string>(
           "--env-up", [&p](const std::string& axis) { p.environmentZUp = axis == "z"; },
           "the map's up axis: y (OpenEXR's), or z")
        ->check(CLI::IsMember({"y", "z"}))
        ->group("Background");
    app.add_option("--env-rotate", p.environmentTurn, "turn the map about its up axis [degree]")
        ->type_name("DEG")
        ->group("Background");
    o.tracing.emplace(
        app,
        "longest step [voxel]; default 1, for verlet 1.5 where no medium is sampled along, "
        "for adaptive 4",
        p.maxDepth, "a ray");
    app.add_option("--samples", p.samples, "rays of a pixel, in a fixed pattern about its middle")
        ->type_name("N")
        ->capture_default_str()
        ->group("Picture");
    app.add_option(
           "--cutoff", p.cutoff,
           "share of a ray's light below which a reflection is not followed: what is refracted "
           "takes it along")
        ->type_name("SHARE")
        ->capture_default_str()
        ->group("Tracing");
    app.add_option("--max-steps", p.maxSteps, "steps after which a ray counts as trapped; 0: ample")
        ->type_name("N")
        ->capture_default_str()
        ->group("Tracing");
    app.add_option("--aov", o.aovs,
                   "pictures beside the colour, a list of " + join(view::allAovs(), ", ") +
                       "; or all")
        ->type_name("NAME,...")
        ->group("Picture");
    app.add_option("--light", o.light,
                   "what lightsim --at wrote for this very picture: the light where a ray's first "
                   "branch ends on an opaque surface")
        ->type_name("LIGHT.exr")
        ->group("Picture");
    app.add_option("--exposure", o.toneMap.exposure, "of a .png, .jpg or .tga output [stop]")
        ->type_name("STOPS")
        ->group("Picture");
    app.add_option("--tone", o.tone, "its tone curve: clip or filmic")
        ->check(CLI::IsMember({"clip", "filmic"}))
        ->capture_default_str()
        ->group("Picture");
    addMeshOptions(app, o);
    tool::addGridNames(app, o.names,
                       {"ior", "absorption", "scattering", "anisotropy", "emission", "opacity",
                        "albedo", "sdf", "fluence", "light_direction"});
}

std::string Options::cameraFile() const {
    return scene_camera::parse(sceneCamera).path;
}

void Options::finish(tool::Session& session) {
    params.camera.parallel = isGiven(session.app(), "--ortho");
    if (!sceneCamera.empty()) {
        const scenefile::Camera found =
            scene_camera::read(session, scene_camera::parse(sceneCamera));
        scene_camera::place(found, params.camera);
        if (size.empty()) size = scene_camera::sizeOf(found);
    }
    const auto parsed = parseNumbers(size, 'x');
    const auto whole = [](double v) { return v >= 1 && v <= 1e6 && v == static_cast<int>(v); };
    if (!parsed || parsed->size() != 2 || !whole((*parsed)[0]) || !whole((*parsed)[1]))
        throw UsageError("--size: found '" + size + "', expected WIDTHxHEIGHT in pixels");
    params.camera.width = static_cast<int>((*parsed)[0]);
    params.camera.rows = static_cast<int>((*parsed)[1]);
    if (!(std::abs(toneMap.exposure) <= 100))
        throw UsageError("--exposure: found " + toText(toneMap.exposure) +
                         ", expected -100 to 100 stops");
    toneMap.curve = tone == "filmic" ? image::ToneCurve::filmic : image::ToneCurve::clip;
}

void Options::finishTracing() {
    params.aovs = aovNames(view::allAovs());
    static_cast<optics::Tracing&>(params) = tracing->finish();
}

image::PictureName Options::takePlate(const CLI::App& app) {
    for (const char* name : {"--plate-distance", "--plate-height"})
        if (isGiven(app, name) && plates.empty())
            throw UsageError(std::string(name) + ": found no --plate, expected one beside it");
    if (plates.empty()) return {};
    if (plates.size() > 1)
        throw UsageError("--plate: found '" + plates[1] + "', expected one picture behind volumes");
    if (!isGiven(app, "--plate-distance"))
        throw UsageError("--plate: found no --plate-distance, expected how far off the picture is");
    requireOption(!isGiven(app, "--plate-height") || plateHeight > 0, "--plate-height",
                  toText(plateHeight), "a height above 0");
    // Its border goes on where nothing else is said to be beyond it.
    const bool endless = !isGiven(app, "--env") && !isGiven(app, "--background");
    params.plate = view::Plate{{}, plateDistance, plateHeight, endless};
    return image::parsePictureName(plates.front());
}

std::vector<std::string> Options::aovNames(const std::vector<std::string>& all) const {
    if (aovs == "all") return all;
    return aovs.empty() ? std::vector<std::string>{} : split(aovs, ',');
}

void refuseMeshOptions(const CLI::App& app) {
    for (const char* name : {"--ior", "--absorption", "--search-steps", "--layers", "--frames"})
        if (isGiven(app, name))
            throw UsageError(std::string(name) +
                             ": is of meshes, expected --method dir, isr, sir or "
                             "rays beside it");
}

void refuseOptionsFor(const CLI::App& app, const std::string& method) {
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0) continue;
        const std::string group = option->get_group();
        const bool branches = name == "--max-depth" || name == "--cutoff";
        const bool layered = method == "dir" && isGiven(app, "--layers");
        const auto refuse = [&](const std::string& wanted) {
            throw UsageError(name + ": --method " + method + " has no use for it, expected " +
                             wanted);
        };
        if ((group == "Tracing" && !branches) || group == "Grid names" || group == "Places" ||
            group == "Polarisers" || name == "--light")
            refuse("it with --method trace");
        if (branches && !(layered || method == "rays"))
            refuse("it with --method trace or rays, or with --layers");
        if (name == "--plate" && !(layered || method == "rays"))
            refuse("--method rays, or dir with --layers");
        if (name == "--plate-distance" || name == "--plate-height")
            refuse("it with --method trace");
        if (name == "--search-steps" && (method != "dir" || layered))
            refuse("it with --method dir, without --layers");
        if (name == "--layers" && method != "dir") refuse("it with --method dir");
    }
}

} // namespace eikonal
