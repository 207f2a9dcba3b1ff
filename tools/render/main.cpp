// render: looks into a lit scene volume along curved rays and writes the picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/session.h"
#include "common/tracing.h"
#include "gpu/device.h"
#include "image/exr.h"
#include "image/picture.h"
#include "render/places.h"
#include "scene/effects.h"
#include "view/view.h"

#include <cctype>
#include <cmath>
#include <filesystem>

using namespace eikonal;

namespace {

struct Options {
    std::vector<std::string> inputs, placed;
    std::string size, environment, aovs, light, tone = "clip";
    volume::GridNames names;
    view::Params params;
    std::optional<tool::TracingOptions> tracing;
    image::ToneMap toneMap;
};

void addCamera(CLI::App& app, view::Camera& camera, std::string& size) {
    tool::addVector(app, "--eye", camera.eye, "where the camera stands [unit]")
        ->required()
        ->group("Camera");
    tool::addVector(app, "--target", camera.target, "the point it looks at [unit]")
        ->required()
        ->group("Camera");
    tool::addVector(app, "--up", camera.up, "what is up in the picture; default 0,1,0")
        ->group("Camera");
    auto* fov = app.add_option("--fov", camera.fov, "vertical angle of view [degree]")
                    ->type_name("DEG")
                    ->group("Camera");
    auto* ortho =
        app.add_option("--ortho", camera.height, "parallel projection of this height [unit]")
            ->type_name("HEIGHT")
            ->excludes(fov)
            ->group("Camera");
    fov->excludes(ortho);
    app.add_option("--size", size, "width and height of the picture [pixel]")
        ->type_name("WxH")
        ->required()
        ->group("Camera");
}

void addOptions(CLI::App& app, Options& o) {
    view::Params& p = o.params;
    app.add_option(
           "input", o.inputs,
           "scene volumes, - is standard input; of those on one transform the light adds up, "
           "others have places of their own")
        ->type_name("IN.vdb")
        ->required();
    app.add_option("--place", o.placed,
                   "moves a volume and its light: shifted [unit], turned about X, Y, Z [degree], "
                   "scaled; given "
                   "again for the same one, it is there again")
        ->type_name("FILE:TX,TY,TZ[:RX,RY,RZ[:S]]")
        ->allow_extra_args(false)
        ->group("Places");
    addCamera(app, p.camera, o.size);
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
    tool::addGridNames(app, o.names,
                       {"ior", "absorption", "scattering", "anisotropy", "emission", "opacity",
                        "albedo", "sdf", "fluence", "light_direction"});
}

void parseTexts(Options& o) {
    const auto size = parseNumbers(o.size, 'x');
    const auto whole = [](double v) { return v >= 1 && v <= 1e6 && v == static_cast<int>(v); };
    if (!size || size->size() != 2 || !whole((*size)[0]) || !whole((*size)[1]))
        throw UsageError("--size: found '" + o.size + "', expected WIDTHxHEIGHT in pixels");
    o.params.camera.width = static_cast<int>((*size)[0]);
    o.params.camera.rows = static_cast<int>((*size)[1]);
    if (o.aovs == "all")
        o.params.aovs = view::allAovs();
    else if (!o.aovs.empty())
        o.params.aovs = split(o.aovs, ',');
    static_cast<optics::Tracing&>(o.params) = o.tracing->finish();
    if (!(std::abs(o.toneMap.exposure) <= 100))
        throw UsageError("--exposure: found " + toText(o.toneMap.exposure) +
                         ", expected -100 to 100 stops");
    o.toneMap.curve = o.tone == "filmic" ? image::ToneCurve::filmic : image::ToneCurve::clip;
}

void writePictures(tool::Session& session, const Options& o, const scene::Files& files,
                   const image::Image& picture) {
    const History history = session.history();
    image::ImageAttributes attributes;
    attributes.strings = {{"eikonal:tool", history.tool},
                          {"eikonal:version", history.version},
                          {"eikonal:command", appendHistory(files.history(), history.command)}};
    camera::describeCamera(o.params.camera, attributes);
    for (const auto& out : session.outputs()) {
        if (image::isDisplayPicture(out->path()))
            image::writePicture(picture, *out, o.toneMap);
        else
            image::writeExr(picture, attributes, *out, session.threads());
    }
}

/// A name that promises a format we don't write is refused; devices and FIFOs get EXR.
void checkOutput(const std::string& path) {
    if (image::isDisplayPicture(path)) return image::requirePictureModule();
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!writtenInPlace(path) && extension != ".exr")
        throw UsageError("--output: found '" + path +
                         "', expected a name ending in .exr, .png, "
                         ".jpg or .tga");
}

/// What lightsim --at wrote. Throws DataError where it is no light for a picture of this size.
view::PointLights readPoints(const std::string& path, const view::Camera& camera) {
    const image::Image picture = image::readExrChannels(
        path, {"irradiance.R", "irradiance.G", "irradiance.B", "position.X", "position.Y",
               "position.Z", "normal.X", "normal.Y", "normal.Z"});
    const auto sizeText = [](int width, int rows) {
        return std::to_string(width) + "x" + std::to_string(rows);
    };
    if (picture.width != camera.width || picture.height != camera.rows)
        throw DataError(path + ": is of " + sizeText(picture.width, picture.height) +
                        " pixels, expected --size " + sizeText(camera.width, camera.rows));
    for (size_t c = 0; c < picture.channels.size(); ++c)
        for (const float value : picture.plane(c))
            if (!std::isfinite(value))
                throw DataError(path + ": channel '" + picture.channels[c] + "' holds " +
                                toText(value) + ", expected a finite number");
    view::PointLights points{picture.width, picture.height, {}, {}, {}};
    for (size_t i = 0; i < picture.area(); ++i) {
        const auto at = [&](size_t channel) { return picture.plane(channel)[i]; };
        points.lights.emplace_back(at(0), at(1), at(2));
        points.places.emplace_back(at(3), at(4), at(5));
        points.isPoint.push_back(at(6) != 0 || at(7) != 0 || at(8) != 0);
    }
    return points;
}

void render(tool::Session& session, Options& o) {
    parseTexts(o);
    o.params.camera.parallel = session.app().count("--ortho") > 0;
    o.params.check();
    std::vector<places::Place> moved;
    for (const std::string& text : o.placed) moved.push_back(places::parse(text));
    const std::vector<places::Place> placed = places::all(o.inputs, moved);
    std::vector<std::string> inputs = o.inputs;
    for (const places::Place& place : moved) inputs.push_back(place.path);
    const image::PictureName environment = image::parsePictureName(o.environment);
    if (!o.environment.empty()) inputs.push_back(environment.path);
    if (!o.light.empty()) inputs.push_back(o.light);
    session.guardInputs(inputs);
    for (const std::string& path : session.outputPaths()) checkOutput(path);
    // Colour, the rays' paths and every AOV are held until the picture is whole.
    const size_t kFloats = 4 + 16 + 24 + 6;
    image::checkSize(o.params.camera.width, o.params.camera.rows, kFloats, "--size " + o.size);

    std::vector<scene::Files> files;
    std::vector<view::Plan> plans;
    std::optional<image::Image> map;
    session.pass("read", [&] {
        if (!o.environment.empty()) {
            image::Environment read = image::readEnvironment(environment);
            for (const std::string& warning : read.warnings) session.warn(warning);
            map = std::move(read.map);
        }
        if (!o.light.empty()) o.params.points = readPoints(o.light, o.params.camera);
        files = places::grouped(placed, o.names);
        plans = view::makePlans(files, o.params, map.has_value());
    });
    const view::Plan& plan = plans.front();
    if (session.explains()) {
        std::string sizes;
        bool bends = false;
        for (const view::Plan& one : plans) {
            sizes += (sizes.empty() ? "" : ", ") + scene::sizeText(one.scene);
            bends |= one.scene.index.varies();
        }
        session.explain(plan.effects, plan.warnings,
                        {{"voxels", sizes},
                         {"picture", o.size},
                         {"tracing", bends ? o.params.text() : "straight"}});
        return;
    }
    session.stats().effects = plan.effects;
    for (const std::string& warning : plan.warnings) session.warn(warning);
    session.outputs();
    const image::Image picture =
        view::render(session.device(), plans, o.params, map, session.stats(), session.progress());
    o.tracing->warnOf(session, "rays");
    tool::warnOfDropped(
        session, {{"light_dropped_by_depth", "--max-depth"}, {"light_dropped_as_dim", "--cutoff"}});
    session.pass("write", [&] { writePictures(session, o, files.front(), picture); });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("render", "Looks into a lit scene volume along curved rays. Output is "
                                    "EXR, or a tone-mapped picture for .png, .jpg, .tga; -o may be "
                                    "given again.");
    Options options;
    addOptions(session.app(), options);
    session.requireOneOf({"--fov", "--ortho"});
    return session.run(argc, argv, [&](tool::Session&) { render(session, options); });
}
