// The view stage: curved viewing rays through a lit scene volume (Sun et al. 2008, §4.5).
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view.h"

#include "gpu/program.h"
#include "medium/field.h"
#include "medium/surfaces.h"
#include "view/bands.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;
using glm::ivec3;
using glm::ivec4;
using glm::uint;
using glm::vec4;
using gpu::Buffer;
using gpu::TexelFormat;
using gpu::Texture;
#include "shared/bindings.h"
#include "shared/transport_params.h"
#include "shared/view_params.h"
static_assert(sizeof(ViewParams) == 224);
static_assert(sizeof(PixelPath) == 64);

// Adaptive steps get no shorter than this [voxel]: floats hold no position much better.
constexpr double kShortestStep = 1e-3;

// 1/(4π) [1/sr]: fluence to isotropically scattered radiance.
constexpr float kIsotropicPhase = 0.07957747154594767f;

/// One picture: what is on the device for its duration, and the loop over bands.
class Rendering {
public:
    Rendering(gpu::Device& device, const Scene& scene, const Plan& plan, const Params& params,
              const std::optional<image::Image>& map, Stats& stats);
    image::Image run(const Progress& progress);

private:
    /// One τ step is as long as the index says: no longer than asked where it is highest.
    double longestTau() const {
        const bool gathers = mPlan.dims || mPlan.emits || mPlan.opaque;
        const double step = mParams.step > 0 ? mParams.step : mParams.usualStep(gathers);
        return step / static_cast<double>(mPlan.index.most);
    }
    gpu::Switches switches(bool hasMap) const;
    void uploadLight();
    void uploadMedium();
    void uploadDirection();
    void uploadNoDirection();
    void uploadSurface();
    void uploadMap(const image::Image& map);
    void aim(bool hasMap, bool mapByEdges);
    void readBand(int row, int rows);
    void readCounters();
    image::Image assemble();
    template<typename Pack> Texture padded(TexelFormat format, bool floorAtZero, const Pack& pack) {
        return medium::makePadded(mDevice, mPlan.size, format, floorAtZero, pack);
    }

    gpu::Device& mDevice;
    const Scene& mScene;
    const Plan& mPlan;
    const Params& mParams;
    Stats& mStats;
    gpu::Profiler mProfiler;
    glm::dmat4 mVoxelFromWorld, mWorldFromVoxel;
    medium::Field mField;
    medium::Surfaces mSurfaces;
    Texture mDimming, mSource, mLobes, mEmission, mSurface, mFluence, mMap;
    Buffer mBlock, mColours, mPaths, mCounters;
    ViewParams mValues{};
    Buffer mTransport;
    gpu::Program mMarch;
    std::vector<vec4> mPicture;
    std::vector<PixelPath> mPicturePaths;
};

Rendering::Rendering(gpu::Device& device, const Scene& scene, const Plan& plan,
                     const Params& params, const std::optional<image::Image>& map, Stats& stats)
    : mDevice(device), mScene(scene), mPlan(plan), mParams(params), mStats(stats), mProfiler(stats),
      mVoxelFromWorld(scene.frame().indexFromWorld()) {
    mVoxelFromWorld[3] -= glm::dvec4(dvec3(scene.domain().min), 0.0);
    mWorldFromVoxel = glm::inverse(mVoxelFromWorld);
    mProfiler.begin("shaders");
    mMarch = gpu::Program(device, "view/trace.comp.glsl",
                          switches(map.has_value()));
    mProfiler.end();
    mProfiler.begin("medium");
    const bool verlet = params.integrator == Integrator::verlet;
    mField = plan.index.varies() ? medium::Field(device, plan.index.grid,
                                                 {params.sampling(), params.unbiased(),
                                                  verlet && params.unbiased() ? longestTau() : 0})
                                 : medium::Field(device, plan.index.least);
    if (plan.sharp) {
        mSurfaces = medium::Surfaces(device, plan.objects, scene.frame().voxelSize);
        uploadLight();
    } else {
        uploadMedium();
        if (plan.opaque) uploadSurface();
    }
    if (map) uploadMap(*map);
    mProfiler.end();
    aim(map.has_value(), map && map->envmap == image::Envmap::latLong);

    const std::int64_t band = std::int64_t{params.camera.width} * rowsPerBand(params);
    const bool paths = wantsPaths(plan, params);
    mBlock = Buffer(device, sizeof(ViewParams));
    mColours = Buffer(device, band * 16);
    mPaths = Buffer(device, paths ? band * 64 : 64);
    mCounters = Buffer(device, kSlots * kCounters * 8);
    mCounters.clear();
    const size_t pixels = static_cast<size_t>(params.camera.width) * params.camera.rows;
    mPicture.resize(pixels);
    if (paths) mPicturePaths.resize(pixels);
}

gpu::Switches Rendering::switches(bool hasMap) const {
    const bool bends = mPlan.index.varies();
    const bool emits = mPlan.emits && (mPlan.sharp || mPlan.lobes);
    const bool shines = mPlan.scatters || (mPlan.emits && !mPlan.sharp);
    gpu::Switches list{{"INTEGRATOR", mParams.pathSwitch(bends)},
                       {"FIELD", medium::fieldSwitch(bends, mParams.sampling())},
                       {"CHANNELS", mPlan.colour ? 3
                                    : mPlan.dims ? 1
                                                 : 0},
                       {"SOURCE", mPlan.lobes ? 2
                                  : shines    ? 1
                                              : 0},
                       {"EMISSION", emits},
                       {"OPAQUE", mPlan.opaque},
                       {"MAP", hasMap},
                       {"AOVS", wantsPaths(mPlan, mParams)}};
    if (!mPlan.sharp) {
        list.emplace_back("OBJECTS", 0);
        list.emplace_back("VARIES", 0);
        list.emplace_back("WAITING", 1);
    } else {
        const auto depth = static_cast<unsigned>(std::max(mParams.maxDepth, 1));
        for (const auto& item : medium::surfaceSwitches(mPlan.objects)) list.push_back(item);
        list.emplace_back("WAITING", static_cast<int>(std::bit_ceil(depth)));
    }
    return list;
}

/// Light for media and opaque surfaces within sharp boundaries, which know their coefficients.
void Rendering::uploadLight() {
    if (mPlan.fluence.present)
        mFluence = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
            for (int c = 0; c < 3; ++c) out[c] = mPlan.fluence.at(i, c);
        });
    if (mPlan.lightDirection.present) uploadDirection();
    if (mPlan.opaque && mLobes.name() == 0) uploadNoDirection();
}

void Rendering::uploadMedium() {
    const Plan& plan = mPlan;
    const auto h = static_cast<float>(mScene.frame().voxelSize); // 1/unit to 1/voxel
    const bool shines = plan.scatters || plan.emits;
    const auto sigma = [&](size_t i, int c) {
        return (plan.absorption.at(i, c) + plan.scattering.at(i, c)) * h;
    };
    // Radiance gained per voxel of length; the phase function and emission come later with lobes.
    const auto shine = [&](size_t i, int c) {
        const float scattered = plan.scattering.at(i, c) * plan.fluence.at(i, c) * h;
        if (plan.lobes) return scattered;
        return scattered * kIsotropicPhase + plan.emission.at(i, c) * h;
    };
    if (plan.colour) {
        mDimming = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
            for (int c = 0; c < 3; ++c) out[c] = sigma(i, c);
        });
        if (shines)
            mSource = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
                for (int c = 0; c < 3; ++c) out[c] = shine(i, c);
            });
    } else if (shines) {
        mDimming = padded(TexelFormat::rg32f, true, [&](size_t i, float* out) {
            out[0] = sigma(i, 0);
            out[1] = shine(i, 0);
        });
    } else if (plan.dims) {
        mDimming =
            padded(TexelFormat::r32f, true, [&](size_t i, float* out) { out[0] = sigma(i, 0); });
    }
    if (plan.lobes || (plan.opaque && plan.lightDirection.present)) uploadDirection();
    if (plan.lobes && plan.emits)
        mEmission = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
            for (int c = 0; c < 3; ++c) out[c] = plan.emission.at(i, c) * h;
        });
}

/// In voxel space, and g beside it.
void Rendering::uploadDirection() {
    const glm::mat3 turn = glm::transpose(
        glm::mat3(glm::dmat3(mScene.frame().worldFromIndex) / mScene.frame().voxelSize));
    mLobes = padded(TexelFormat::rgba32f, false, [&](size_t i, float* out) {
        const glm::vec3 d =
            turn * glm::vec3(mPlan.lightDirection.at(i, 0), mPlan.lightDirection.at(i, 1),
                             mPlan.lightDirection.at(i, 2));
        out[0] = d.x;
        out[1] = d.y;
        out[2] = d.z;
        out[3] = mPlan.anisotropy.at(i, 0);
    });
}

/// Light without a stored direction falls on surfaces from all sides.
void Rendering::uploadNoDirection() {
    mLobes = Texture(mDevice, ivec3(1), TexelFormat::rgba32f, gpu::Filter::linear);
    mLobes.clear();
}

void Rendering::uploadSurface() {
    mSurface = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
        out[0] = mPlan.opacity.grid.values[i];
        for (int c = 0; c < 3; ++c) out[1 + c] = mPlan.albedo.at(i, c);
    });
    if (mPlan.fluence.present)
        mFluence = padded(TexelFormat::rgba32f, true, [&](size_t i, float* out) {
            for (int c = 0; c < 3; ++c) out[c] = mPlan.fluence.at(i, c);
        });
    if (mLobes.name() == 0) uploadNoDirection();
}

void Rendering::uploadMap(const image::Image& map) {
    std::vector<float> rgba(map.area() * 4);
    for (size_t c = 0; c < 3; ++c) {
        const auto plane = map.plane(c);
        for (size_t i = 0; i < plane.size(); ++i) rgba[4 * i + c] = plane[i];
    }
    mMap = Texture(mDevice, {map.width, map.height, 0}, TexelFormat::rgba32f, gpu::Filter::nearest);
    mMap.upload(rgba.data());
}

void Rendering::aim(bool hasMap, bool mapByEdges) {
    const Camera& camera = mParams.camera;
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const dvec3 up = glm::cross(right, forward);
    const double aspect = static_cast<double>(camera.width) / camera.rows;
    const double h = mScene.frame().voxelSize;
    const double half =
        camera.parallel ? 0.5 * camera.height / h : std::tan(glm::radians(0.5 * camera.fov));
    const glm::dmat3 turn(glm::dmat3(mVoxelFromWorld) * h);
    const dvec3 eye(mVoxelFromWorld * glm::dvec4(camera.eye, 1.0));
    const glm::vec3 eyeHigh(eye);

    ViewParams& v = mValues;
    const ivec3 size = mPlan.size;
    const double tau = longestTau(), step = tau * static_cast<double>(mPlan.index.most);
    const bool adaptive = mParams.integrator == Integrator::adaptive;
    const double usual = adaptive ? std::min(step, 0.25) : step; // what hard places take
    const int crossings = static_cast<int>(16.0 * (size.x + size.y + size.z) / usual) + 1024;
    v.limits = ivec4(mParams.maxSteps > 0 ? mParams.maxSteps : crossings, mParams.maxDepth, 0, 0);
    v.picture = ivec4(camera.width, camera.rows, 0, 0);
    v.eyeHigh = vec4(eyeHigh, camera.parallel ? 0 : 1);
    v.eyeLow = vec4(eye - dvec3(eyeHigh), 0);
    v.forward = vec4(turn * forward, 0);
    v.right = vec4(turn * right * (half * aspect), 0);
    v.up = vec4(turn * up * half, 0);
    // What floats hold of a picture is three decimals: a thousandth of a ray's light is let go.
    const double kLeastThroughput = 1e-3;
    v.medium = vec4(mPlan.index.background, kLeastThroughput,
                    mPlan.opaque && mPlan.fluence.present ? 1 : 0, 0);
    TransportParams transport{};
    transport.halfSize = vec4(0.5f * glm::vec3(size), 0);
    transport.scale = vec4(1.0f / glm::vec3(size + 2), 0);
    transport.steps = vec4(tau, kShortestStep * tau / step,
                           adaptive ? std::min(1.0, step) * tau / step : tau, step);
    transport.tolerance = vec4(mParams.tolerance, glm::length(dvec3(size)), 0, 0);
    mTransport = Buffer(mDevice, sizeof transport, &transport);
    v.background = vec4(mParams.background, hasMap ? (mapByEdges ? 3 : 2) : 1);

    const double angle = glm::radians(mParams.environmentTurn);
    // A turn by +90° brings what the map shows at +X to +Z, as turning the map to the right does.
    glm::dmat3 mapFromWorld(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0,
                            std::cos(angle));
    // A Z-up map's pole +Z is the map's +Y; its +X stays.
    if (mParams.environmentZUp)
        mapFromWorld = mapFromWorld * glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);
    const glm::dmat3 rows =
        glm::transpose(mapFromWorld * glm::dmat3(mScene.frame().worldFromIndex) / h);
    v.mapFromVoxel0 = vec4(rows[0], 0);
    v.mapFromVoxel1 = vec4(rows[1], 0);
    v.mapFromVoxel2 = vec4(rows[2], 0);
}

image::Image Rendering::run(const Progress& progress) {
    const Camera& camera = mParams.camera;
    const Texture* textures[] = {&mDimming, &mSource,  &mLobes, &mEmission,
                                 &mSurface, &mFluence, &mMap};
    for (unsigned unit = 0; unit < 7; ++unit)
        if (textures[unit]->name() != 0) textures[unit]->bindSampler(1 + unit);
    mField.bind();
    if (mPlan.sharp) mSurfaces.bind();
    mColours.bindStorage(0);
    mPaths.bindStorage(1);
    mCounters.bindStorage(2);
    mBlock.bindUniform(kParamsBlock);
    mTransport.bindUniform(kTransportBlock);
    for (int row = 0; row < camera.rows; row += rowsPerBand(mParams)) {
        const int rows = std::min(rowsPerBand(mParams), camera.rows - row);
        mValues.picture.z = row;
        mValues.picture.w = rows;
        mProfiler.begin("view");
        for (int sample = 0; sample < mParams.samples; ++sample) {
            // The plastic number's powers: any number of rays is spread evenly over the pixel, and
            // the first goes through its centre.
            const glm::dvec2 place =
                glm::fract(0.5 + static_cast<double>(sample) *
                                     glm::dvec2(0.7548776662466927, 0.5698402909980532));
            mValues.pattern = vec4(place, sample == 0 ? 1 : 0, 0);
            mValues.weight = vec4(1.0 / mParams.samples);
            mBlock.upload(&mValues, sizeof mValues);
            mMarch.dispatch({camera.width, rows, 1});
            gpu::barrier();
        }
        mProfiler.end();
        mDevice.check("view");
        readBand(row, rows);
        report(progress, static_cast<double>(row + rows) / camera.rows);
    }
    readCounters();
    mProfiler.collect();
    return assemble();
}

void Rendering::readBand(int row, int rows) {
    mProfiler.begin("download");
    const size_t first = static_cast<size_t>(row) * mParams.camera.width;
    const std::int64_t pixels = std::int64_t{rows} * mParams.camera.width;
    mColours.download(mPicture.data() + first, pixels * 16);
    if (!mPicturePaths.empty()) mPaths.download(mPicturePaths.data() + first, pixels * 64);
    mProfiler.end();
}

void Rendering::readCounters() {
    std::array<std::uint64_t, kSlots * kCounters> slots{};
    mCounters.download(slots.data(), sizeof slots);
    const auto value = [&](size_t slot, size_t counter) {
        return slots[slot * kCounters + counter];
    };
    const char* names[] = {"rays", "steps", "trapped"};
    for (size_t counter = 0; counter < 3; ++counter)
        for (size_t slot = 0; slot < kSlots; ++slot)
            mStats.count(names[counter], static_cast<double>(value(slot, counter)));
    if (mPlan.sharp) {
        const auto sum = [&](size_t counter) {
            double all = 0;
            for (size_t slot = 0; slot < kSlots; ++slot)
                all += static_cast<double>(value(slot, counter));
            return all;
        };
        const double kShare = 1048576, rays = std::max(sum(0), 1.0);
        mStats.count("boundaries_met", sum(5));
        mStats.count("light_dropped_by_depth", sum(6) / kShare / rays);
        mStats.count("light_dropped_as_dim", sum(7) / kShare / rays);
    }
    if (mPlan.index.varies() && mParams.integrator == Integrator::adaptive) {
        float worst = 0;
        double over = 0;
        for (size_t slot = 0; slot < kSlots; ++slot) {
            worst =
                std::max(worst, std::bit_cast<float>(static_cast<std::uint32_t>(value(slot, 3))));
            over += static_cast<double>(value(slot, 4));
        }
        mStats.raise("position_error_voxels", static_cast<double>(worst));
        mStats.count("over_tolerance", over);
    }
}

image::Image Rendering::assemble() {
    const Camera& camera = mParams.camera;
    image::Image picture(camera.width, camera.rows);
    picture.addChannels({"R", "G", "B", "A"},
                        {reinterpret_cast<const float*>(mPicture.data()), mPicture.size() * 4}, 4);
    if (mPicturePaths.empty()) return picture;
    const double h = mScene.frame().voxelSize;
    const glm::dmat3 turn(glm::dmat3(mWorldFromVoxel) / h);
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const auto add = [&](const std::vector<std::string>& names, const auto& value) {
        std::vector<float> samples;
        samples.reserve(mPicturePaths.size() * names.size());
        for (const PixelPath& path : mPicturePaths) {
            const dvec3 v = value(path);
            for (int c = 0; c < static_cast<int>(names.size()); ++c)
                samples.push_back(static_cast<float>(v[c]));
        }
        picture.addChannels(names, samples, names.size());
    };
    const auto vector = [](const std::string& name, const char* components) {
        std::vector<std::string> names;
        for (const char* c = components; *c; ++c) names.push_back(name + "." + *c);
        return names;
    };
    const auto place = [&](const PixelPath& path) {
        return dvec3(mWorldFromVoxel * glm::dvec4(dvec3(path.place), 1.0));
    };
    if (mPlan.dims && mPlan.colour)
        add({"AR", "AG", "AB"}, [](const PixelPath& p) { return 1.0 - dvec3(p.through); });
    for (const std::string& aov : mParams.aovs) {
        if (aov == "exit_position") add(vector(aov, "XYZ"), place);
        if (aov == "exit_direction")
            add(vector(aov, "XYZ"),
                [&](const PixelPath& p) { return glm::normalize(turn * dvec3(p.direction)); });
        if (aov == "transmittance")
            add(vector(aov, "RGB"), [](const PixelPath& p) { return dvec3(p.through); });
        if (aov == "optical_path_length")
            add({aov}, [&](const PixelPath& p) { return dvec3(p.place.w * h); });
        if (aov == "path_length")
            add({aov}, [&](const PixelPath& p) { return dvec3(p.direction.w * h); });
        if (aov == "steps") add({aov}, [](const PixelPath& p) { return dvec3(p.through.w); });
        if (aov == "Z")
            add({aov}, [&](const PixelPath& p) {
                return dvec3(glm::dot(place(p) - camera.eye, forward));
            });
        if (aov == "error") add({aov}, [](const PixelPath& p) { return dvec3(p.error.x); });
    }
    return picture;
}

} // namespace

image::Image render(gpu::Device& device, const Scene& scene, const Plan& plan, const Params& params,
                    const std::optional<image::Image>& map, Stats& stats,
                    const Progress& progress) {
    device.requireFit(needsOf(plan, params));
    Rendering rendering(device, scene, plan, params, map, stats);
    image::Image picture = rendering.run(progress);
    stats.gpuPeakBytes = std::max(stats.gpuPeakBytes, device.peakBytes());
    return picture;
}

} // namespace eikonal::view
