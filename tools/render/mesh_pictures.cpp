// render's pictures of meshes: in image space, or traced exactly.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/mesh_pictures.h"

#include "base/text.h"
#include "gpu/device.h"
#include "image/picture.h"
#include "imagespace/imagespace.h"
#include "mesh/fans.h"
#include "mesh/read.h"
#include "mesh/smooth_surface.h"
#include "raytrace/normal_distances.h"
#include "raytrace/raytrace.h"
#include "render/frames.h"
#include "render/pictures.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace eikonal {

namespace {

struct Plate {
    std::string path;
    glm::dvec3 albedo{0.8};
};

/// "MESH" or "MESH:R,G,B". Throws UsageError.
Plate parsePlate(const std::string& text) {
    Plate plate{text};
    const size_t colon = text.rfind(':');
    if (colon == std::string::npos) return plate;
    const auto numbers = parseNumbers(text.substr(colon + 1));
    if (!numbers) return plate; // a file's name may have colons
    if (numbers->size() != 1 && numbers->size() != 3)
        throw UsageError("--plate: found '" + text + "', expected MESH[:R,G,B]");
    for (int c = 0; c < 3; ++c)
        plate.albedo[c] = (*numbers)[numbers->size() == 1 ? 0 : static_cast<size_t>(c)];
    for (int c = 0; c < 3; ++c)
        requireOption(plate.albedo[c] >= 0 && plate.albedo[c] <= 1, "--plate",
                      "an albedo of " + toText(plate.albedo[c]), "0 to 1");
    plate.path = text.substr(0, colon);
    return plate;
}

/// What the run is to do, apart from the frames' files.
struct Task {
    std::vector<Plate> plates;
    std::vector<int> frames; ///< empty: one picture, of the files as they are named
    imagespace::Params space;
    raytrace::Params exact;
    bool isExact = false;
    std::optional<image::Image> map;
};

void setShared(auto& params, const Options& o, const std::vector<std::string>& aovs) {
    static_cast<camera::Background&>(params) = o.params;
    params.camera = o.params.camera;
    params.samples = o.params.samples;
    params.aovs = o.aovNames(aovs);
    params.maxDepth = o.params.maxDepth;
    params.cutoff = o.params.cutoff;
    params.check();
}

Task taskOf(const Options& o) {
    Task task;
    for (const std::string& text : o.plates) task.plates.push_back(parsePlate(text));
    if (!o.frames.empty()) task.frames = parseFrames(o.frames);
    task.isExact = o.method == "rays";
    requireOption(o.ior > 0, "--ior", o.ior == 0 ? "none" : toText(o.ior),
                  "the index of the meshes");
    task.space.ior = o.ior;
    task.space.absorption = o.absorption;
    task.space.method = o.method == "isr"   ? imagespace::Method::isr
                        : o.method == "sir" ? imagespace::Method::sir
                                            : imagespace::Method::dir;
    task.space.searchSteps = o.searchSteps;
    task.space.layers = o.layers;
    if (task.isExact) {
        task.space.camera = o.params.camera;
        static_cast<camera::Background&>(task.space) = o.params;
        task.space.check();
        setShared(task.exact, o, raytrace::allAovs());
    } else {
        setShared(task.space, o, imagespace::allAovs());
    }
    return task;
}

/// Meshes as they were, to tell whether only their points have moved.
class Checked {
public:
    void check(const mesh::TriangleMesh& mesh, const std::string& title, size_t place) {
        if (mKnown.size() <= place) mKnown.resize(place + 1);
        if (mKnown[place] == mesh.triangles && !mesh.triangles.empty()) return;
        imagespace::requireClosed(mesh, title);
        mKnown[place] = mesh.triangles;
    }

private:
    std::vector<std::vector<glm::uvec3>> mKnown;
};

mesh::TriangleMesh readSmooth(tool::Session& session, const std::string& path) {
    mesh::TriangleMesh mesh;
    session.pass("read", [&] { mesh = mesh::readMesh(path); });
    return mesh;
}

void smooth(tool::Session& session, mesh::TriangleMesh& mesh) {
    session.pass("normals", [&] {
        mesh.normals = mesh::cornerNormals(mesh::findFans(mesh, mesh::kUsualSmooth));
    });
}

/// One picture's meshes.
struct Meshes {
    mesh::TriangleMesh body;
    std::vector<mesh::TriangleMesh> plates;
};

Meshes readMeshes(tool::Session& session, const Options& o, const Task& task, Checked& checked,
                  const std::function<std::string(const std::string&)>& named) {
    Meshes meshes;
    for (size_t k = 0; k < o.inputs.size(); ++k) {
        const std::string path = named(o.inputs[k]);
        mesh::TriangleMesh mesh = readSmooth(session, path);
        session.pass("check", [&] { checked.check(mesh, mesh::meshTitle(path), k); });
        smooth(session, mesh);
        if (k == 0)
            meshes.body = std::move(mesh);
        else
            mesh::append(meshes.body, mesh);
    }
    for (const Plate& plate : task.plates) {
        meshes.plates.push_back(readSmooth(session, named(plate.path)));
        smooth(session, meshes.plates.back());
    }
    if (!task.isExact && imagespace::isWithin(meshes.body, o.params.camera.eye))
        throw UsageError("--eye: found a point within " + named(o.inputs[0]) +
                         ", expected one outside, or --method rays");
    return meshes;
}

/// Makes pictures frame by frame, with what stays between them.
class Painter {
public:
    Painter(tool::Session& session, const Options& o, const Task& task)
        : mSession(session), mOptions(o), mTask(task) {
        if (!task.isExact)
            mRenderer = std::make_unique<imagespace::Renderer>(session.device(), task.space,
                                                               task.map, session.stats());
    }

    image::Image paint(Meshes meshes, const Progress& progress) {
        if (mTask.isExact) return trace(std::move(meshes), progress);
        imagespace::Body body{std::move(meshes.body), {}};
        if (mTask.space.method == imagespace::Method::isr)
            mSession.pass("distances along normals",
                          [&] { body.distances = raytrace::distancesAlongNormals(body.mesh); });
        std::vector<imagespace::Plate> plates;
        for (size_t k = 0; k < meshes.plates.size(); ++k)
            plates.push_back({std::move(meshes.plates[k]), mTask.plates[k].albedo});
        mRenderer->setScene(body, plates);
        image::Image picture;
        mSession.pass("frame", [&] { picture = mRenderer->render(progress); });
        return picture;
    }

private:
    image::Image trace(Meshes meshes, const Progress& progress) {
        std::vector<raytrace::Body> bodies(1);
        bodies[0].name = mesh::meshTitle(mOptions.inputs[0]);
        bodies[0].mesh = std::move(meshes.body);
        bodies[0].ior = mOptions.ior;
        bodies[0].absorption = mOptions.absorption;
        for (size_t k = 0; k < meshes.plates.size(); ++k) {
            raytrace::Body plate;
            plate.name = mTask.plates[k].path;
            plate.mesh = std::move(meshes.plates[k]);
            plate.opaque = true;
            plate.albedo = mTask.plates[k].albedo;
            bodies.push_back(std::move(plate));
        }
        image::Image picture;
        mSession.pass("frame", [&] {
            picture = raytrace::render(mTask.exact, bodies, mTask.map, mSession.stats(), progress);
        });
        return picture;
    }

    tool::Session& mSession;
    const Options& mOptions;
    const Task& mTask;
    std::unique_ptr<imagespace::Renderer> mRenderer;
};

void explain(tool::Session& session, const Options& o, const Task& task, const Meshes& meshes) {
    std::vector<std::pair<std::string, std::string>> facts{
        {"method", o.method},
        {"triangles", std::to_string(meshes.body.triangles.size())},
        {"picture", o.size}};
    if (!task.frames.empty()) facts.emplace_back("frames", std::to_string(task.frames.size()));
    if (!task.isExact && task.space.layers == 0 && task.space.method == imagespace::Method::dir)
        facts.emplace_back("search steps", std::to_string(o.searchSteps));
    if (!task.isExact && task.space.layers > 0)
        facts.emplace_back("layers", std::to_string(2 * task.space.layers));
    session.explain(session.stats().effects, {}, facts);
}

std::vector<Effect> effectsOf(const Task& task) {
    std::vector<Effect> effects = imagespace::effectsOf(task.space, task.map.has_value());
    if (!task.isExact) return effects;
    for (Effect& effect : effects) {
        if (effect.name == "refraction") effect.why = "all interfaces, to --max-depth";
        if (effect.name == "reflection") effect.why = "by Fresnel's law, on to what it meets";
        if (effect.name == "total_reflection") effect = {effect.name, true, "--method rays"};
        if (effect.name == "paths")
            effect = {effect.name, !task.exact.aovs.empty() || task.space.isColoured(),
                      !task.exact.aovs.empty()  ? "--aov"
                      : task.space.isColoured() ? "opacities by colour"
                                                : "no --aov"};
    }
    return effects;
}

/// Says where a run shows nothing, or not all that it should.
void warnOf(tool::Session& session, bool anySeen) {
    if (!anySeen)
        session.warn("no triangle is in view: the pictures show what surrounds the scene");
    const double lost = session.stats().counter("rays_lost_within");
    const double share = lost / std::max(session.stats().counter("rays"), 1.0);
    if (share > 0.01)
        session.warn(toText(std::round(share * 1000) / 10) +
                     " % of the rays got lost within the body: expected more --layers, or all of "
                     "the body in the picture");
}

bool isSeen(const image::Image& picture) {
    const auto alpha = picture.plane(picture.find("A").value());
    return std::any_of(alpha.begin(), alpha.end(), [](float a) { return a > 0; });
}

/// Every file of every frame: none may be read and written.
void guardFiles(tool::Session& session, const Options& o, const Task& task) {
    std::vector<std::string> patterns = o.inputs, inputs;
    for (const Plate& plate : task.plates) patterns.push_back(plate.path);
    if (!o.environment.empty()) inputs.push_back(image::parsePictureName(o.environment).path);
    if (!o.sceneCamera.empty()) inputs.push_back(o.cameraFile());
    std::vector<std::string> outputs = session.outputPaths();
    for (const std::string& path : outputs) checkOutput(path);
    if (task.frames.empty()) {
        inputs.insert(inputs.end(), patterns.begin(), patterns.end());
        return session.guardInputs(inputs);
    }
    std::vector<std::string> written;
    for (const std::string& path : outputs)
        if (!hasFrames(path) && task.frames.size() > 1 && !writtenInPlace(path))
            throw UsageError("--output: found '" + path +
                             "', expected #### in it, for the number of the frame");
    std::set<std::string> read;
    for (const int frame : task.frames) {
        for (const std::string& path : outputs) written.push_back(atFrame(path, frame));
        for (const std::string& path : patterns) read.insert(atFrame(path, frame));
    }
    inputs.insert(inputs.end(), read.begin(), read.end());
    session.nameOutputs(written);
    session.guardInputs(inputs);
}

} // namespace

void renderMeshes(tool::Session& session, Options& o) {
    refuseOptionsFor(session.app(), o.method);
    Task task = taskOf(o);
    guardFiles(session, o, task);
    // Colour, the rays' paths and every AOV are held until the picture is whole.
    const size_t kFloats = 4 + 16 + 24;
    image::checkSize(o.params.camera.width, o.params.camera.rows, kFloats, "--size " + o.size);
    if (!o.environment.empty())
        session.pass("read", [&] {
            image::Environment read =
                image::readEnvironment(image::parsePictureName(o.environment));
            for (const std::string& warning : read.warnings) session.warn(warning);
            task.map = std::move(read.map);
        });
    session.stats().effects = effectsOf(task);
    Checked checked;
    const auto plainly = [](const std::string& name) { return name; };
    const auto read = [&](int frame) {
        return readMeshes(session, o, task, checked,
                          [=](const std::string& name) { return atFrame(name, frame); });
    };
    Meshes meshes =
        task.frames.empty() ? readMeshes(session, o, task, checked, plainly) : read(task.frames[0]);
    if (session.explains()) return explain(session, o, task, meshes);
    if (task.frames.empty()) {
        session.outputs();
        const image::Image picture =
            Painter(session, o, task).paint(std::move(meshes), session.progress());
        warnOf(session, isSeen(picture));
        return session.pass("write",
                            [&] { writePictures(session, session.outputs(), o, "", picture); });
    }
    session.openStats();
    Painter painter(session, o, task);
    const Progress progress = session.progress();
    bool anySeen = false;
    const size_t each = session.outputPaths().size() / task.frames.size();
    for (size_t k = 0; k < task.frames.size(); ++k) {
        if (k > 0) meshes = read(task.frames[k]);
        const double all = static_cast<double>(task.frames.size());
        const image::Image picture =
            painter.paint(std::move(meshes), partOf(progress, static_cast<double>(k) / all,
                                                    static_cast<double>(k + 1) / all));
        anySeen |= isSeen(picture);
        session.pass("write", [&] {
            const auto first = session.extraOutputs(k * each, each);
            writePictures(session, first, o, "", picture);
            for (const auto& out : first) out->finish();
        });
    }
    warnOf(session, anySeen);
}

} // namespace eikonal
