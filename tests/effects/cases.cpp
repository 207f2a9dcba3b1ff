// Scenes that differ from refraction alone by one thing.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.h"

#include "lightsim/lightsim.h"
#include "scene/recorded_lights.h"
#include "view/view.h"
#include "volume/ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

namespace effects {

using namespace eikonal;
using glm::dvec3;

namespace {

using Value = std::function<dvec3(dvec3)>;

/// A box of edge 2 about the origin, every voxel of every grid active.
class SceneVolume {
public:
    explicit SceneVolume(int voxels) : mVoxels(voxels), mVolume(frameOf(voxels)) {}

    SceneVolume& add(const std::string& grid, int components, const Value& value) {
        const double h = 2.0 / mVoxels;
        volume::DenseGrid dense{glm::ivec3(mVoxels), components, {}};
        dense.values.reserve(dense.voxels() * static_cast<size_t>(components));
        for (int z = 0; z < mVoxels; ++z)
            for (int y = 0; y < mVoxels; ++y)
                for (int x = 0; x < mVoxels; ++x) {
                    const dvec3 v = value((dvec3(x, y, z) + 0.5) * h - 1.0);
                    for (int c = 0; c < components; ++c)
                        dense.values.push_back(static_cast<float>(v[c]));
                }
        volume::PutOptions options;
        options.allActive = true;
        options.background = glm::vec3(grid == "ior" ? 1.0f : 0.0f);
        mVolume.put(grid, {glm::ivec3(0), glm::ivec3(mVoxels - 1)}, dense, options);
        return *this;
    }
    SceneVolume& constant(const std::string& grid, int components, const dvec3& value) {
        return add(grid, components, [=](dvec3) { return value; });
    }
    /// A blurred ball of radius ½ and index 1.5.
    SceneVolume& ball() {
        const double blur = 3.0 / mVoxels;
        return add("ior", 1, [=](dvec3 p) {
            return dvec3(1 + 0.25 * std::erfc((glm::length(p) - 0.5) / blur / std::sqrt(2.0)));
        });
    }
    /// An object bounded by distances [unit], in a band as mesh2vol writes it. Without a name the
    /// plain grids are its own.
    SceneVolume& solid(const std::string& name, int order,
                       const std::function<double(dvec3)>& distance) {
        const double h = 2.0 / mVoxels;
        volume::DenseGrid dense{glm::ivec3(mVoxels), 1, {}};
        for (int z = 0; z < mVoxels; ++z)
            for (int y = 0; y < mVoxels; ++y)
                for (int x = 0; x < mVoxels; ++x)
                    dense.values.push_back(
                        static_cast<float>(distance((dvec3(x, y, z) + 0.5) * h - 1.0)));
        mVolume.putLevelSet({name, name.empty() ? "sdf" : "sdf." + name, 0, order},
                            {glm::ivec3(0), glm::ivec3(mVoxels - 1)}, dense, 4);
        return *this;
    }
    SceneVolume& own(const std::string& grid, const std::string& name, float value) {
        mVolume.putConstant(volume::ownGrid(grid, name), glm::vec3(value));
        return *this;
    }
    /// Another boundary for a solid.
    SceneVolume& boundary(const std::string& name, float roughness,
                          const std::optional<volume::Metal>& metal = {}) {
        const std::string sdf = name.empty() ? "sdf" : "sdf." + name;
        const volume::IndexBox box{glm::ivec3(0), glm::ivec3(mVoxels - 1)};
        for (volume::ObjectFacts facts : mVolume.objects()) {
            if (facts.sdf != sdf) continue;
            facts.roughness = roughness;
            facts.metal = metal;
            mVolume.putLevelSet(facts, box, mVolume.dense(sdf, box), 4);
        }
        return *this;
    }
    /// A solid is a crystal, by metadata.
    SceneVolume& crystal(const volume::Crystal& crystal) {
        const volume::IndexBox box{glm::ivec3(0), glm::ivec3(mVoxels - 1)};
        for (volume::ObjectFacts facts : mVolume.objects()) {
            if (facts.sdf != "sdf") continue;
            facts.crystal = crystal;
            mVolume.putLevelSet(facts, box, mVolume.dense(facts.sdf, box), 4);
        }
        return *this;
    }
    /// Light on surfaces, stored all over a corner.
    SceneVolume& shine() {
        volume::FineGrid light;
        light.detail = 1;
        for (int z = mVoxels / 2; z < mVoxels; ++z)
            for (int y = mVoxels / 2; y < mVoxels; ++y)
                for (int x = mVoxels / 2; x < mVoxels; ++x) {
                    light.voxels.emplace_back(x, y, z);
                    light.values.emplace_back(1);
                }
        mVolume.putFine("irradiance", {glm::ivec3(0), glm::ivec3(mVoxels - 1)}, light);
        return *this;
    }
    SceneVolume& say(const std::string& key, const std::string& value) {
        mVolume.setMetadata(key, value);
        return *this;
    }
    volume::Volume take() { return std::move(mVolume); }

private:
    static volume::Frame frameOf(int voxels) {
        volume::Frame frame;
        frame.voxelSize = 2.0 / voxels;
        for (int i = 0; i < 3; ++i) {
            frame.worldFromIndex[i][i] = frame.voxelSize;
            frame.worldFromIndex[3][i] = -1 + 0.5 * frame.voxelSize;
        }
        return frame;
    }
    int mVoxels;
    volume::Volume mVolume;
};

using Fill = std::function<void(SceneVolume&)>;

/// A ball of glass of radius ½, and in a corner what few rays meet.
double ballDistance(const dvec3& p) {
    return glm::length(p) - 0.5;
}
double cornerDistance(const dvec3& p) {
    return glm::length(p - 0.85) - 0.2;
}

/// Index 1.5 within a sharp boundary; its other values are those of the plain grids.
volume::Volume glassOf(const Scale& scale, const Fill& fill) {
    SceneVolume scene(scale.voxels);
    scene.constant("ior", 1, dvec3(1.5)).solid("", 0, ballDistance);
    if (fill) fill(scene);
    return scene.take();
}

/// The same and a second object, of which `fill` says more.
volume::Volume glassBeside(const Scale& scale, const Fill& fill) {
    SceneVolume scene(scale.voxels);
    scene.constant("ior", 1, dvec3(1.5)).solid("glass", 0, ballDistance).own("ior", "glass", 1.5);
    scene.solid("other", 1, cornerDistance).own("ior", "other", 1.5);
    if (fill) fill(scene);
    return scene.take();
}

/// A glass ball and more objects than kernels visit all of.
volume::Volume glassInCrowd(const Scale& scale) {
    SceneVolume scene(scale.voxels);
    scene.constant("ior", 1, dvec3(1.5)).solid("glass", 0, ballDistance).own("ior", "glass", 1.5);
    for (int k = 1; k < 8; ++k) {
        const std::string name = "other" + std::to_string(k);
        const dvec3 corner(k & 1 ? 0.8 : -0.8, k & 2 ? 0.8 : -0.8, k & 4 ? 0.8 : -0.8);
        scene.solid(name, k, [=](dvec3 p) { return glm::length(p - corner) - 0.15; });
        scene.own("ior", name, 1.5);
    }
    return scene.take();
}

/// The glass over an opaque floor.
volume::Volume glassOverFloor(const Scale& scale, const Fill& fill) {
    SceneVolume scene(scale.voxels);
    scene.constant("ior", 1, dvec3(1.5)).solid("", 0, ballDistance);
    scene.solid("floor", 1, [](dvec3 p) { return p.y + 0.6; }).own("ior", "floor", 1);
    scene.own("opacity", "floor", 1).own("albedo", "floor", 0.5f);
    if (fill) fill(scene);
    return scene.take();
}

/// And more objects than kernels visit all of.
void crowd(SceneVolume& scene) {
    for (int k = 2; k < 8; ++k) {
        const std::string name = "other" + std::to_string(k);
        const dvec3 corner(k & 1 ? 0.8 : -0.8, 0.8, 0.3 * k - 1.5);
        scene.solid(name, k, [=](dvec3 p) { return glm::length(p - corner) - 0.12; });
        scene.own("ior", name, 1.5);
    }
}

/// A Luneburg lens of glass, n² = 2.25 (2 − 4 r²), which goes on beyond its rim.
void gradeIndex(SceneVolume& scene) {
    scene.add("ior", 1, [](dvec3 p) {
        return dvec3(1.5 * std::sqrt(std::max(2 - 4 * glm::dot(p, p), 0.5)));
    });
}

volume::Volume volumeOf(const Scale& scale, bool bends, const Fill& fill) {
    SceneVolume scene(scale.voxels);
    if (bends)
        scene.ball();
    else
        scene.constant("ior", 1, dvec3(1));
    if (fill) fill(scene);
    return scene.take();
}

// Thin enough for every photon and ray to go on to its end.
const dvec3 kGrey(0.1), kRgb(0.05, 0.1, 0.15);
const dvec3 kCauchy(0.004); // [µm²]

/// A small cube in a corner, which few rays meet: what is priced is looking out for it.
dvec3 inCorner(const dvec3& p) {
    return dvec3(std::min({p.x, p.y, p.z}) > 0.75 ? 1.0 : 0.0);
}

Fill fill(const std::string& grid, int components, const dvec3& value) {
    return [=](SceneVolume& scene) { scene.constant(grid, components, value); };
}

void addHaze(SceneVolume& scene) {
    scene.constant("scattering", 3, kGrey).constant("fluence", 3, dvec3(1));
}

void addLobes(SceneVolume& scene) {
    addHaze(scene);
    scene.constant("anisotropy", 1, dvec3(0.5)).constant("light_direction", 3, dvec3(0, -1, 0));
}

void addSurface(SceneVolume& scene) {
    scene.add("opacity", 1, inCorner).constant("albedo", 3, dvec3(0.5)).shine();
}

void varyAbsorption(SceneVolume& scene) {
    scene.add("absorption", 3, [](dvec3 p) { return kGrey * (1.0 + p); });
}

/// Beside the glass, a lit object that no light passes.
void opaqueOther(SceneVolume& scene) {
    scene.own("opacity", "other", 1).own("albedo", "other", 0.5f).shine();
}

void roughen(SceneVolume& scene) {
    scene.boundary("", 0.2f);
}

void crystallise(SceneVolume& scene) {
    scene.crystal({1.6f, 0, {0.6f, 0.8f, 0}, {0, 0, 0}});
}

/// The axis turns about the view's.
void crystalliseTurning(SceneVolume& scene) {
    scene.add("axis", 3, [](dvec3 p) { return dvec3(std::cos(p.z), std::sin(p.z), 0); });
    scene.constant("ior_extraordinary", 1, dvec3(1.6));
}

void metalOther(SceneVolume& scene) {
    scene.boundary("other", 0, volume::Metal{glm::vec3(0.5f), glm::vec3(3)});
}

/// A lit ground under the glass, which goes on beyond the domain.
volume::Volume glassOverGround(const Scale& scale) {
    SceneVolume scene(scale.voxels);
    scene.constant("ior", 1, dvec3(1.5)).solid("glass", 0, ballDistance).own("ior", "glass", 1.5);
    scene.solid("ground", 1, [](dvec3 p) { return p.y + 0.6; }).own("ior", "ground", 1);
    scene.own("opacity", "ground", 1).own("albedo", "ground", 0.5f).shine();
    scene.say(volume::kGroundKey, "-0.6 0.5,0.5,0.5 0.3");
    scene.say(scene::kLightsKey, "directional:0.2,-1,0.1\nspot:0,3,0:0,-1,0:30:10\n"
                                 "sphere:2,3,0:0.5\nrect:-2,3,0:0,0,1:1,0,0");
    return scene.take();
}

double passMs(const Stats& stats, const std::string& name) {
    for (const PassTime& pass : stats.passes)
        if (pass.name == name) return pass.gpuMs;
    return 0;
}

view::Params viewParams(const Scale& scale) {
    view::Params params;
    params.camera.eye = {0.2, 0.5, 3.2};
    params.camera.fov = 34;
    params.camera.width = scale.width;
    params.camera.rows = scale.rows;
    params.background = dvec3(0.5);
    return params;
}

/// The effects that a case has, by the names of bindingsOf().
using Effects = std::vector<std::string>;

Case viewCase(const std::string& name, const Effects& effects, volume::Volume volume,
              const view::Params& params, const std::optional<image::Image>& map = {}) {
    std::vector<volume::Volume> volumes;
    volumes.push_back(std::move(volume));
    const auto scene = std::make_shared<scene::Files>(std::move(volumes));
    const auto plan = std::make_shared<view::Plan>(view::makePlan(*scene, params, map.has_value()));
    return {name, effects, false, [=](gpu::Device& device) {
                Stats stats;
                view::render(device, *plan, params, map, stats, {});
                return Outcome{passMs(stats, "view"), stats.counter("steps")};
            }};
}

lightsim::Params photonParams(const Scale& scale) {
    lightsim::Params params;
    params.lights.push_back(lightsim::parseLight("directional:0.2,-1,0.1"));
    params.photons = scale.photons;
    params.smoothing = 0; // a pass of its own
    // In a vacuum nothing asks for light; and where one thing more is stored, it is said.
    params.automaticOutputs = false;
    params.outputs = lightsim::Output::fluence;
    return params;
}

/// Its time is that of photons, or of beams' points, of what becomes of cells, and of laying them
/// down.
Case lightCase(const std::string& name, const Effects& effects, volume::Volume made,
               const lightsim::Params& params) {
    const auto volume = std::make_shared<volume::Volume>(std::move(made));
    const auto plan = std::make_shared<lightsim::Plan>(lightsim::makePlan(*volume, params));
    return {name, effects, false, [=](gpu::Device& device) {
                Stats stats;
                lightsim::simulate(device, *plan, params, stats, {});
                double ms = 0;
                for (const char* pass : {"photons", "beam rays", "beam cells", "beams"})
                    ms += passMs(stats, pass);
                return Outcome{ms, stats.counter("steps") + stats.counter("beam_points")};
            }};
}

lightsim::Params beamParams(const Scale& scale) {
    lightsim::Params params = photonParams(scale);
    params.outputs = lightsim::Output::irradiance;
    params.method = lightsim::Method::beams;
    return params;
}

lightsim::Params withDirection(lightsim::Params params) {
    params.outputs = lightsim::Output::both;
    return params;
}

/// Photons on surfaces, too, where beams would be sent.
lightsim::Params withSurfaces(lightsim::Params params) {
    params.outputs = lightsim::Output::fluence | lightsim::Output::irradiance;
    params.method = lightsim::Method::photons;
    return params;
}

image::Image mapOfStripes() {
    image::Image map(64, 32);
    std::vector<float> samples;
    for (size_t i = 0; i < map.area(); ++i)
        for (int c = 0; c < 3; ++c) samples.push_back(i % 8 < 4 ? 0.2f : 0.9f);
    map.addChannels({"R", "G", "B"}, samples, 3);
    return map;
}

/// One case for every way of stepping that is not the usual one, made by `make` from its Tracing.
template<typename Make> void addTracing(std::vector<Case>& cases, const Make& make) {
    using optics::Integrator;
    using optics::Interpolation;
    const auto add = [&](const char* name, Integrator integrator, Interpolation interpolation) {
        optics::Tracing tracing;
        tracing.integrator = integrator;
        tracing.interpolation = interpolation;
        cases.push_back(make(name, tracing));
        cases.back().isTracing = true;
    };
    add("cubic interpolation", Integrator::verlet, Interpolation::cubic);
    add("Euler", Integrator::euler, Interpolation::linear);
    add("Sharma, linear", Integrator::sharma, Interpolation::linear);
    add("Sharma, cubic", Integrator::sharma, Interpolation::cubic);
    add("RK4, linear", Integrator::rk4, Interpolation::linear);
    add("adaptive, cubic", Integrator::adaptive, Interpolation::cubic);
}

/// Light for every pixel, as if each showed a point.
view::Params withPoints(view::Params params) {
    const int width = params.camera.width, rows = params.camera.rows;
    const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(rows);
    params.points = {width, rows, std::vector<dvec3>(pixels), std::vector<bool>(pixels, true),
                     std::vector<glm::vec3>(pixels, glm::vec3(1))};
    return params;
}

std::vector<Case> viewCases(const Scale& scale) {
    const view::Params params = viewParams(scale);
    std::vector<Case> cases;
    const auto add = [&](const char* name, Effects effects, const Fill& more) {
        effects.push_back("refraction");
        cases.push_back(viewCase(name, effects, volumeOf(scale, true, more), params));
    };
    add("refraction alone", {}, {});
    add("absorption, grey", {"medium"}, fill("absorption", 3, kGrey));
    add("absorption, RGB", {"medium", "paths"}, fill("absorption", 3, kRgb));
    add("scattering, isotropic", {"medium"}, addHaze);
    add("scattering, lobes", {"medium", "lobes"}, addLobes);
    add("emission", {"medium"}, fill("emission", 3, kGrey));
    add("lobes and emission", {"medium", "lobes", "emission beside lobes"}, [](SceneVolume& scene) {
        addLobes(scene);
        scene.constant("emission", 3, kGrey);
    });
    cases.push_back(viewCase("environment map", {"refraction", "environment map"},
                             volumeOf(scale, true, {}), params, mapOfStripes()));
    view::Params plate = params;
    plate.plate = view::Plate{mapOfStripes(), 5};
    cases.push_back(viewCase("plate", {"refraction", "plate"}, volumeOf(scale, true, {}), plate));
    add("opaque surface", {"opaque surface"}, addSurface);
    add("dispersion", {"dispersion"}, fill("dispersion", 1, kCauchy));
    cases.push_back(viewCase("opaque surface, light of points",
                             {"refraction", "opaque surface", "points"},
                             volumeOf(scale, true, addSurface), withPoints(params)));
    view::Params withAovs = params;
    withAovs.aovs = view::allAovs();
    cases.push_back(
        viewCase("all AOVs", {"refraction", "paths"}, volumeOf(scale, true, {}), withAovs));
    addTracing(cases, [&](const char* name, const optics::Tracing& tracing) {
        view::Params changed = params;
        static_cast<optics::Tracing&>(changed) = tracing;
        return viewCase(name, {"refraction"}, volumeOf(scale, true, {}), changed);
    });
    return cases;
}

std::vector<Case> sharpViewCases(const Scale& scale) {
    const view::Params params = viewParams(scale);
    std::vector<Case> cases;
    const auto add = [&](const char* name, const Effects& effects, const Fill& more) {
        cases.push_back(viewCase(name, effects, glassOf(scale, more), params));
    };
    add("refraction alone", {}, {});
    add("absorption, grey", {}, fill("absorption", 3, kGrey));
    add("absorption, RGB", {"paths"}, fill("absorption", 3, kRgb));
    add("absorption that varies", {"paths", "absorption that varies"}, varyAbsorption);
    add("scattering, isotropic", {"scattering"}, addHaze);
    add("scattering, lobes", {"scattering", "lobes"}, addLobes);
    add("emission", {}, fill("emission", 3, kGrey));
    add("dispersion", {"dispersion"}, fill("dispersion", 1, kCauchy));
    add("rough", {}, roughen);
    add("a crystal", {}, crystallise);
    add("a crystal that varies", {"crystals that vary"}, crystalliseTurning);
    cases.push_back(viewCase("a second object, metal", {"several objects"},
                             glassBeside(scale, metalOther), params));
    cases.push_back(viewCase("environment map", {"environment map"}, glassOf(scale, {}), params,
                             mapOfStripes()));
    cases.push_back(
        viewCase("a second object", {"several objects"}, glassBeside(scale, {}), params));
    cases.push_back(viewCase("a second object, opaque", {"several objects", "opaque object"},
                             glassBeside(scale, opaqueOther), params));
    cases.push_back(viewCase("a second object, light of points",
                             {"several objects", "opaque object", "points"},
                             glassBeside(scale, opaqueOther), withPoints(params)));
    cases.push_back(viewCase("a ground, and four lights",
                             {"several objects", "opaque object", "ground"}, glassOverGround(scale),
                             params));
    cases.push_back(viewCase("eight objects", {"several objects", "many objects"},
                             glassInCrowd(scale), params));
    view::Params shallow = params;
    shallow.maxDepth = 8;
    cases.push_back(viewCase("--max-depth 8", {}, glassOf(scale, {}), shallow));
    view::Params withAovs = params;
    withAovs.aovs = view::allAovs();
    cases.push_back(viewCase("all AOVs", {"paths"}, glassOf(scale, {}), withAovs));
    const auto addTraced = [&](const char* name, const optics::Tracing& tracing) {
        view::Params changed = params;
        static_cast<optics::Tracing&>(changed) = tracing;
        return viewCase(name, {"index that varies"}, glassOf(scale, gradeIndex), changed);
    };
    cases.push_back(addTraced("Verlet, linear", {}));
    cases.back().isTracing = true;
    addTracing(cases, addTraced);
    return cases;
}

std::vector<Case> photonCases(const Scale& scale) {
    const lightsim::Params params = photonParams(scale);
    std::vector<Case> cases;
    const auto add = [&](const char* name, Effects effects, const Fill& more) {
        effects.push_back("refraction");
        cases.push_back(lightCase(name, effects, volumeOf(scale, true, more), params));
    };
    add("refraction alone", {}, {});
    add("absorption, grey", {"medium"}, fill("absorption", 3, kGrey));
    add("absorption, RGB", {"medium", "colour"}, fill("absorption", 3, kRgb));
    // Above ¼ along a voxel's diagonal in the corner.
    const double depth = 0.3 * scale.voxels / 2 / std::sqrt(3.0);
    add("absorption, dense", {"medium"}, [=](SceneVolume& scene) {
        scene.add("absorption", 3, [=](dvec3 p) { return kGrey + inCorner(p) * depth; });
    });
    cases.push_back(lightCase("direction", {"refraction", "direction"}, volumeOf(scale, true, {}),
                              withDirection(params)));
    add("dispersion", {"dispersion"}, fill("dispersion", 1, kCauchy));
    add("opaque surface", {"opaque surface"},
        [](SceneVolume& scene) { scene.add("opacity", 1, inCorner); });
    cases.push_back(lightCase(
        "opaque surface, lit", {"refraction", "opaque surface", "lit surface"},
        volumeOf(scale, true, [](SceneVolume& scene) { scene.add("opacity", 1, inCorner); }),
        withSurfaces(params)));
    addTracing(cases, [&](const char* name, const optics::Tracing& tracing) {
        lightsim::Params changed = params;
        changed.tracing = tracing;
        return lightCase(name, {"refraction"}, volumeOf(scale, true, {}), changed);
    });
    return cases;
}

std::vector<Case> sharpPhotonCases(const Scale& scale) {
    const lightsim::Params params = photonParams(scale);
    std::vector<Case> cases;
    const auto add = [&](const char* name, const Effects& effects, const Fill& more) {
        cases.push_back(lightCase(name, effects, glassOf(scale, more), params));
    };
    add("refraction alone", {}, {});
    add("absorption, grey", {}, fill("absorption", 3, kGrey));
    add("absorption, RGB", {"colour"}, fill("absorption", 3, kRgb));
    add("absorption that varies", {"colour", "absorption that varies"}, varyAbsorption);
    add("dispersion", {"dispersion"}, fill("dispersion", 1, kCauchy));
    add("rough", {}, roughen);
    add("a crystal", {"crystals"}, crystallise);
    add("a crystal that varies", {"crystals", "crystals that vary"}, crystalliseTurning);
    cases.push_back(
        lightCase("direction", {"direction"}, glassOf(scale, {}), withDirection(params)));
    cases.push_back(
        lightCase("a second object", {"several objects"}, glassBeside(scale, {}), params));
    cases.push_back(lightCase("a second object, opaque", {"several objects"},
                              glassBeside(scale, opaqueOther), params));
    cases.push_back(lightCase("a second object, opaque and lit", {"several objects", "lit surface"},
                              glassBeside(scale, opaqueOther), withSurfaces(params)));
    cases.push_back(lightCase("eight objects", {"several objects", "many objects"},
                              glassInCrowd(scale), params));
    const auto addTraced = [&](const char* name, const optics::Tracing& tracing) {
        lightsim::Params changed = params;
        changed.tracing = tracing;
        return lightCase(name, {"index that varies"}, glassOf(scale, gradeIndex), changed);
    };
    cases.push_back(addTraced("Verlet, linear", {}));
    cases.back().isTracing = true;
    addTracing(cases, addTraced);
    return cases;
}

std::vector<Case> beamCases(const Scale& scale) {
    const lightsim::Params params = beamParams(scale);
    std::vector<Case> cases;
    const auto add = [&](const char* name, const Effects& effects, const Fill& more) {
        cases.push_back(lightCase(name, effects, glassOverFloor(scale, more), params));
    };
    add("refraction alone", {}, {});
    add("absorption, grey", {}, fill("absorption", 3, kGrey));
    add("absorption, RGB", {"colour"}, fill("absorption", 3, kRgb));
    add("absorption that varies", {"colour", "absorption that varies"}, varyAbsorption);
    add("dispersion", {"dispersion"}, fill("dispersion", 1, kCauchy));
    add("a crystal", {"crystals"}, crystallise);
    add("a crystal that varies", {"crystals", "crystals that vary"}, crystalliseTurning);
    lightsim::Params faded = params;
    faded.lights = {lightsim::parseLight("spot:0,5,0:0,-1,0:30:10")};
    cases.push_back(lightCase("a spot", {}, glassOverFloor(scale, {}), faded));
    add("eight objects", {"many objects"}, crowd);
    const auto addTraced = [&](const char* name, const optics::Tracing& tracing) {
        lightsim::Params changed = params;
        changed.tracing = tracing;
        return lightCase(name, {"index that varies"}, glassOverFloor(scale, gradeIndex), changed);
    };
    cases.push_back(addTraced("Verlet, linear", {}));
    cases.back().isTracing = true;
    addTracing(cases, addTraced);
    return cases;
}

bool isView(Family family) {
    return family == Family::view || family == Family::sharpView;
}

bool isSharp(Family family) {
    return family == Family::sharpView || family == Family::sharpPhotons;
}

} // namespace

std::string nameOf(Family family) {
    if (family == Family::beams) return "beams";
    return std::string(isView(family) ? "view" : "photons") + (isSharp(family) ? ", sharp" : "");
}

std::vector<Case> casesOf(Family family, const Scale& scale) {
    switch (family) {
    case Family::view:
        return viewCases(scale);
    case Family::sharpView:
        return sharpViewCases(scale);
    case Family::photons:
        return photonCases(scale);
    case Family::sharpPhotons:
        return sharpPhotonCases(scale);
    default:
        return beamCases(scale);
    }
}

std::vector<Case> casesAndStraight(Family family, const Scale& scale) {
    std::vector<Case> cases = casesOf(family, scale);
    volume::Volume volume = volumeOf(scale, false, fill("absorption", 3, kGrey));
    if (family == Family::view)
        cases.push_back(
            viewCase("absorption alone", {"medium"}, std::move(volume), viewParams(scale)));
    if (family == Family::photons)
        cases.push_back(
            lightCase("absorption alone", {"medium"}, std::move(volume), photonParams(scale)));
    return cases;
}

Case emptyGridsCase(Family family, const Scale& scale) {
    const auto zeros = [](SceneVolume& scene) {
        for (const char* grid : {"absorption", "scattering", "emission", "fluence"})
            scene.constant(grid, 3, dvec3(0));
        for (const char* grid : {"anisotropy", "opacity"}) scene.constant(grid, 1, dvec3(0));
    };
    if (family == Family::beams)
        return lightCase("empty grids", {}, glassOverFloor(scale, zeros), beamParams(scale));
    volume::Volume volume = isSharp(family) ? glassOf(scale, zeros) : volumeOf(scale, true, zeros);
    return isView(family) ? viewCase("empty grids", {}, std::move(volume), viewParams(scale))
                          : lightCase("empty grids", {}, std::move(volume), photonParams(scale));
}

} // namespace effects
