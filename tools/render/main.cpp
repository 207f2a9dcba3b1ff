// render: looks into a lit scene volume along curved rays, or at meshes, and writes the picture.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "common/session.h"
#include "gpu/device.h"
#include "image/exr.h"
#include "image/picture.h"
#include "render/mesh_pictures.h"
#include "render/options.h"
#include "render/pictures.h"
#include "render/places.h"
#include "scene/effects.h"
#include "view/view.h"

#include <cmath>

using namespace eikonal;

namespace {

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

void renderVolumes(tool::Session& session, Options& o) {
    refuseMeshOptions(session.app());
    const image::PictureName plate = o.takePlate(session.app());
    o.finishTracing();
    o.params.check();
    std::vector<places::Place> moved;
    for (const std::string& text : o.placed) moved.push_back(places::parse(text));
    const std::vector<places::Place> placed = places::all(o.inputs, moved);
    std::vector<std::string> inputs = o.inputs;
    for (const places::Place& place : moved) inputs.push_back(place.path);
    const image::PictureName environment = image::parsePictureName(o.environment);
    if (!o.environment.empty()) inputs.push_back(environment.path);
    if (!plate.path.empty()) inputs.push_back(plate.path);
    if (!o.light.empty()) inputs.push_back(o.light);
    if (!o.sceneCamera.empty()) inputs.push_back(o.cameraFile());
    session.guardInputs(inputs);
    for (const std::string& path : session.outputPaths()) checkOutput(path);
    // Colour, the rays' paths and every AOV are held until the picture is whole.
    const size_t kFloats = 4 + 16 + 26 + 6;
    image::checkSize(o.params.camera.width, o.params.camera.rows, kFloats, "--size " + o.size);

    std::vector<scene::Files> files;
    std::vector<view::Plan> plans;
    std::optional<image::Image> map;
    session.pass("read", [&] {
        const auto take = [&](image::Environment read) {
            for (const std::string& warning : read.warnings) session.warn(warning);
            return std::move(read.map);
        };
        if (!o.environment.empty()) map = take(image::readEnvironment(environment));
        if (o.params.plate) o.params.plate->picture = take(image::readPlate(plate));
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
    session.pass("write", [&] {
        writePictures(session, session.outputs(), o, files.front().history(), picture);
    });
}

} // namespace

int main(int argc, char** argv) {
    tool::Session session("render", "Looks into a lit scene volume along curved rays, or at "
                                    "meshes by --method. Output is EXR, or a tone-mapped picture "
                                    "for .png, .jpg, .tga; -o may be given again.");
    Options options;
    addOptions(session, options);
    return session.run(argc, argv, [&](tool::Session&) {
        options.finish(session);
        if (options.method == "trace")
            renderVolumes(session, options);
        else
            renderMeshes(session, options);
    });
}
