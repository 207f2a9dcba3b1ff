// Refraction in image space: pictures of meshes by rasterising them, without a volume.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "imagespace/imagespace.h"

#include "base/error.h"
#include "camera/irradiance.h"
#include "camera/pattern.h"
#include "gpu/raster.h"
#include "imagespace/follow.h"
#include "imagespace/geometry.h"
#include "imagespace/picture.h"
#include "mesh/check.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace eikonal::imagespace {

namespace {

/// Of the normals of back faces; the shader takes no coarser one.
constexpr int kLevels = 4;

/// Members of a SurfacePath.
constexpr int kPathLayers = sizeof(SurfacePath) / sizeof(vec4);

constexpr auto kFormat = gpu::TexelFormat::rgba32f;

int methodNumber(Method method) {
    return static_cast<int>(method);
}

} // namespace

void requireClosed(const mesh::TriangleMesh& mesh, const std::string& title) {
    const mesh::MeshReport report = mesh::checkTopology(mesh);
    if (report.boundsVolume()) return;
    const std::vector<std::string> sentences = report.sentences();
    std::string faults;
    for (size_t k = 1; k < sentences.size(); ++k) faults += (k > 1 ? "; " : "") + sentences[k];
    throw DataError(title + ": bounds no volume: " + faults +
                    " (expected a closed surface whose faces all look outward; mesh2vol --repair "
                    "mends some)");
}

bool isWithin(const mesh::TriangleMesh& mesh, const glm::dvec3& eye) {
    return mesh::boundingBox(mesh).contains(eye) && std::abs(mesh::windingNumber(mesh, eye)) > 0.5;
}

std::vector<Effect> effectsOf(const Params& params, bool hasMap) {
    const bool glows = params.background != glm::dvec3(0);
    const bool absorbs = params.absorption != glm::dvec3(0);
    const bool exits = params.method != Method::sir;
    return {
        {"refraction", true,
         params.layers > 0 ? "all interfaces that --layers keeps"
         : exits           ? "two interfaces"
                           : "one interface, by --method sir"},
        {"absorption", absorbs && exits,
         !absorbs ? "no --absorption"
         : exits  ? "--absorption, along the way that is found"
                  : "sir finds no way through"},
        {"reflection", true,
         params.layers > 0 ? "by Fresnel's law, on to what it meets"
                           : "of the surroundings, by Fresnel's law"},
        {"total_reflection", params.layers > 0,
         params.layers > 0 ? "--layers" : "rays leave along the surface: no --layers"},
        {"environment", hasMap || glows,
         hasMap  ? "--env"
         : glows ? "--background"
                 : "neither --env nor --background"},
        {"paths", wantsPaths(params),
         !params.aovs.empty()  ? "--aov"
         : params.isColoured() ? "opacities by colour"
                               : "no --aov"},
    };
}

struct Renderer::Impl {
    gpu::Device& device;
    Params params;
    Stats& stats;
    gpu::Profiler profiler;
    gpu::Texture map;
    gpu::Program surface, range, refract, bare;
    gpu::Layers fronts, backs, distances, paths;
    gpu::Canvas canvas;
    gpu::Texture colours;
    gpu::Buffer block, depthRange;
    std::optional<image::Image> around;
    Geometry geometry, plateGeometry;
    std::vector<std::uint32_t> ordered; ///< a body's indices,
    std::vector<std::uint32_t> order;   ///< and how its triangles are drawn
    Sides sides{};                      ///< of the body, but where layers are kept
    gpu::Triangles triangles, plateTriangles;
    std::optional<Follower> follower;
    ImageSpaceParams values{};

    Impl(gpu::Device& onDevice, const Params& toDo, const std::optional<image::Image>& surroundings,
         Stats& toFill)
        : device(onDevice), params(toDo), stats(toFill), profiler(toFill), around(surroundings) {
        const camera::Camera& camera = params.camera;
        requireFit(false);
        profiler.begin("surroundings");
        map = camera::makeMap(device, around);
        profiler.end();
        canvas = gpu::Canvas(device, camera.width, camera.rows);
        block = gpu::Buffer(device, sizeof values);
        colours =
            gpu::Texture(device, {camera.width, camera.rows, 0}, kFormat, gpu::Filter::nearest);
        if (wantsPaths(params))
            paths = gpu::Layers(device, camera.width, camera.rows, kPathLayers, 1, kFormat);
        setValues();
        if (params.layers == 0) makeTwoInterfaces();
    }

    void makeTwoInterfaces() {
        const camera::Camera& camera = params.camera;
        profiler.begin("shaders");
        const bool isr = params.method == Method::isr;
        surface = gpu::Program(device, "imagespace/surface.vert.glsl",
                               "imagespace/surface.frag.glsl", {{"PEELS", 0}, {"EXTRA", isr}});
        range = gpu::Program(device, "imagespace/range.comp.glsl", {});
        refract =
            gpu::Program(device, "imagespace/overall.vert.glsl", "imagespace/refract.frag.glsl",
                         {{"METHOD", methodNumber(params.method)},
                          {"MAP", around.has_value()},
                          {"AOVS", wantsPaths(params)}});
        bare = gpu::Program(device, "imagespace/overall.vert.glsl", "imagespace/bare.frag.glsl",
                            {{"MAP", around.has_value()}, {"AOVS", wantsPaths(params)}});
        profiler.end();

        const int width = camera.width, rows = camera.rows;
        fronts = gpu::Layers(device, width, rows, 1, 1, kFormat);
        if (params.method != Method::sir)
            backs = gpu::Layers(device, width, rows, 1, kLevels, kFormat);
        if (isr) distances = gpu::Layers(device, width, rows, 1, 1, kFormat);
        depthRange = gpu::Buffer(device, 8);
    }

    void makeFollower() {
        const bool plates = plateGeometry.extra > 0;
        requireFit(plates);
        profiler.begin("shaders");
        follower.emplace(device, params, around.has_value(), plates);
        profiler.end();
        if (!plates) return;
        const camera::Irradiance irradiance = camera::irradianceFrom(params, around);
        for (size_t k = 0; k < irradiance.size(); ++k)
            values.irradiance[k] = vec4(irradiance[k], 0);
    }

    void requireFit(bool plates) const {
        const int width = params.camera.width, rows = params.camera.rows;
        const std::int64_t pixels = std::int64_t{width} * rows;
        std::vector<gpu::Need> needs{{"the picture", pixels * 16, false, 0, std::max(width, rows)}};
        if (params.layers > 0)
            for (const gpu::Need& need : Follower::needs(params, plates)) needs.push_back(need);
        else
            needs.push_back({"the layers of surfaces",
                             gpu::Layers::bytesFor(width, rows, 3, kLevels, kFormat)});
        if (wantsPaths(params))
            needs.push_back(
                {"the rays' paths", pixels * static_cast<std::int64_t>(sizeof(SurfacePath))});
        if (around) needs.push_back(camera::mapNeed(*around));
        device.requireFit(needs);
    }

    void setValues() {
        const camera::Camera& camera = params.camera;
        const double half =
            camera.parallel ? 0.5 * camera.height : std::tan(glm::radians(0.5 * camera.fov));
        values.window = vec4(half * camera.aspect(), half, camera.parallel ? 0 : 1, 0);
        values.picture = ivec4(camera.width, camera.rows, 0, 0);
        values.optics = vec4(params.ior, params.cutoff, 0, 0);
        values.limits = ivec4(params.searchSteps, 0, params.maxDepth, 0);
        values.absorption = vec4(params.absorption, 0);
        values.background = camera::backgroundValues(params, around);
        const camera::CameraAxes axes = camera::axesOf(camera);
        const glm::dmat3 rows = glm::transpose(
            camera::mapFromFrame(params, glm::dmat3(axes.right, axes.up, axes.forward)));
        values.mapFromCamera0 = vec4(rows[0], 0);
        values.mapFromCamera1 = vec4(rows[1], 0);
        values.mapFromCamera2 = vec4(rows[2], 0);
        values.worldFromCamera0 = vec4(axes.right, 0);
        values.worldFromCamera1 = vec4(axes.up, 0);
        values.worldFromCamera2 = vec4(axes.forward, 0);
    }

    void upload() {
        block.upload(&values, sizeof values);
        block.bindUniform(kParamsBlock);
    }

    /// The faces of one side, of each pixel the back face that is furthest or the front face that
    /// is nearest.
    void drawSide(bool back) {
        profiler.begin(back ? "back faces" : "front faces");
        std::vector<gpu::Canvas::Target> targets{{back ? &backs : &fronts, 0}};
        if (params.method == Method::isr) targets.push_back({&distances, 0});
        canvas.begin(targets, back);
        canvas.draw(surface, triangles, back ? gpu::Faces::back : gpu::Faces::front,
                    back ? sides.back : sides.front);
        canvas.end(false);
        profiler.end();
    }

    /// Coarser levels of the back faces, and between which depths they lie.
    void summarizeBacks() {
        profiler.begin("mip levels");
        backs.makeLevels();
        profiler.end();
        if (params.method != Method::dir) return;
        profiler.begin("depth range");
        const std::array<std::uint32_t, 2> none{~std::uint32_t{0} >> 1, 0};
        depthRange.upload(none.data(), sizeof none);
        depthRange.bindStorage(kDepthRangeBuffer);
        backs.bindSampler(kBacksUnit);
        const int runs = (params.camera.width + 31) / 32;
        range.dispatch({runs * params.camera.rows, 1, 1});
        gpu::barrier();
        profiler.end();
    }

    void bindPicture() {
        if (map.name() != 0) map.bindSampler(kEnvironmentUnit);
        colours.bindImage(kColoursImage);
        if (wantsPaths(params)) paths.bindImage(kPathsImage);
    }

    void drawTwoInterfaces() {
        values.cameraFromBody = cameraFromBody(params.camera, geometry);
        upload();
        // What is drawn on a software device's other threads need not be waited for until it is
        // read.
        if (params.method != Method::sir) drawSide(true);
        drawSide(false);
        if (params.method != Method::sir) summarizeBacks();
        drawRays();
    }

    void drawPaths() {
        const Drawn body{&triangles, cameraFromBody(params.camera, geometry)};
        Drawn plates{nullptr, glm::mat4(1)};
        if (plateGeometry.extra > 0)
            plates = {&plateTriangles, cameraFromBody(params.camera, plateGeometry)};
        bindPicture();
        follower->draw(
            canvas, body, plates, values, [&] { upload(); }, profiler);
    }

    void drawRays() {
        profiler.begin("refraction");
        bindPicture();
        fronts.bindSampler(kFrontsUnit);
        if (params.method != Method::sir) backs.bindSampler(kBacksUnit);
        if (params.method == Method::isr) distances.bindSampler(kDistancesUnit2d);
        depthRange.bindStorage(kDepthRangeBuffer);
        canvas.addWhere(true, refract, colours);
        canvas.addWhere(false, bare, colours);
        gpu::barrier();
        profiler.end();
    }

    image::Image picture() {
        profiler.begin("download");
        const size_t pixels =
            static_cast<size_t>(params.camera.width) * static_cast<size_t>(params.camera.rows);
        std::vector<vec4> shown(pixels);
        colours.download(shown.data(), static_cast<std::int64_t>(pixels * sizeof(vec4)));
        std::vector<vec4> found(wantsPaths(params) ? kPathLayers * pixels : 0);
        if (!found.empty())
            paths.download(found.data(), static_cast<std::int64_t>(found.size() * sizeof(vec4)));
        profiler.end();
        return assemble(params, shown, found);
    }
};

Renderer::Renderer(gpu::Device& device, const Params& params,
                   const std::optional<image::Image>& map, Stats& stats)
    : mImpl(std::make_unique<Impl>(device, params, map, stats)) {}

Renderer::~Renderer() = default;

void Renderer::setScene(const Body& body, const std::vector<Plate>& plates) {
    Impl& my = *mImpl;
    if (my.params.method == Method::isr && body.distances.size() != body.mesh.points.size())
        throw InternalError("isr: not a distance for each point");
    my.profiler.begin("upload");
    my.geometry = geometryOf(body);
    if (my.ordered != my.geometry.indices) { // a mesh that deforms keeps its own
        my.ordered = my.geometry.indices;
        my.order = nearbyOrder(my.geometry);
    }
    reorder(my.geometry, my.order);
    if (my.params.layers == 0) my.sides = sortBySide(my.geometry, my.params.camera);
    my.triangles = trianglesOf(my.device, my.geometry);
    my.plateGeometry = plates.empty() ? Geometry{} : geometryOf(plates);
    if (!plates.empty()) my.plateTriangles = trianglesOf(my.device, my.plateGeometry);
    my.profiler.end();
    if (my.params.layers > 0 && !my.follower) my.makeFollower();
}

image::Image Renderer::render(const Progress& progress) {
    Impl& my = *mImpl;
    const camera::Camera& camera = my.params.camera;
    std::vector<const Geometry*> all{&my.geometry};
    if (my.plateGeometry.extra > 0) all.push_back(&my.plateGeometry);
    const Depths depths = depthsOf(camera, all);
    my.values.depths = vec4(depths.near, depths.far, 0, 0);
    for (const Geometry* one : all)
        my.values.depths.z +=
            static_cast<float>(glm::length(one->middle - my.geometry.middle) + 2 * one->radius);
    const std::vector<glm::dvec2> places = camera::samplePattern(my.params.samples);
    for (size_t k = 0; k < places.size(); ++k) {
        my.values.clipFromCamera = clipFromCamera(camera, depths, places[k]);
        my.values.pattern = vec4(places[k], 1.0 / my.params.samples, 0);
        my.values.picture.z = static_cast<int>(k);
        if (k == 0) my.colours.clear();
        if (my.follower)
            my.drawPaths();
        else
            my.drawTwoInterfaces();
        report(progress, static_cast<double>(k + 1) / my.params.samples);
    }
    image::Image picture = my.picture();
    my.device.check("refraction in image space");
    my.profiler.collect();
    my.stats.count("rays", static_cast<double>(picture.area()) * my.params.samples);
    my.stats.count("frames", 1);
    if (my.follower) {
        my.stats.raise("layers_used", my.follower->layersUsed());
        my.stats.raise("rays_lost_within", my.follower->lost());
    }
    my.stats.gpuPeakBytes = std::max(my.stats.gpuPeakBytes, my.device.peakBytes());
    return picture;
}

} // namespace eikonal::imagespace
