// Viewing rays on the device: the kernel, the media and the light that it reads.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/rays.h"

#include "scene/voxel_textures.h"
#include "view/camera_ray.h"
#include "view/ground.h"
#include "view/picture.h"
#include "view/plate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::view {

namespace {

using glm::dvec3;
using gpu::TexelFormat;
using gpu::Texture;

// 1/(4π) [1/sr]: fluence to isotropically scattered radiance.
constexpr float kIsotropicPhase = 0.07957747154594767f;

double stepOf(const Plan& plan, const Params& params) {
    const bool samples = plan.gathers() || plan.opaque;
    return params.step > 0 ? params.step : params.usualStep(samples);
}

scene::StepLengths stepsOf(const Plan& plan, const Params& params) {
    const double step = stepOf(plan, params);
    const bool adaptive = params.integrator == Integrator::adaptive;
    return {step, 1e-3, adaptive ? std::min(1.0, step) : step, true, params.unit};
}

gpu::Switches switchesOf(const Plan& plan, const Params& params) {
    // Blurred, emission is part of the source unless scattering prefers a direction, as it does
    // not.
    const bool sharp = plan.scene.sharp;
    const bool glows = plan.scatters || (plan.emits && !sharp);
    gpu::Switches list = scene::transportSwitches(plan.scene, params, params.polarises());
    list.emplace_back("CHANNELS", plan.colour ? 3 : plan.dims ? 1 : 0);
    list.emplace_back("SOURCE", plan.anisotropic ? 2 : glows ? 1 : 0);
    list.emplace_back("EMISSION", plan.emits && (sharp || plan.anisotropic));
    list.emplace_back("MAP", plan.map);
    list.emplace_back("AOVS", wantsPaths(plan, params));
    list.emplace_back("POINTS", !params.points.empty());
    list.emplace_back("GROUND", plan.ground.has_value());
    list.emplace_back("PLATE", params.plate.has_value());
    list.emplace_back("DOMAINS", plan.several);
    const scene::SurfaceLight& surfaces = plan.scene.light.surfaces;
    list.emplace_back("SURFACES", surfaces.empty() ? 0 : surfaces.grey() ? 1 : 3);
    list.emplace_back("WAITING", sharp ? branchesWaiting(params) : 1);
    return list;
}

template<typename Pack>
Texture voxelTexture(gpu::Device& device, const Plan& plan, TexelFormat format, bool floorAtZero,
                     const Pack& pack) {
    return scene::makeVoxelTexture(device, plan.scene.layout, format, floorAtZero, pack);
}

/// Per voxel the three components of some values, times a factor.
Texture rgbTexture(gpu::Device& device, const Plan& plan, const scene::Values& values,
                   float factor) {
    return voxelTexture(device, plan, TexelFormat::rgba32f, true,
                        [&](const glm::ivec3& i, float* out) {
                            for (int c = 0; c < 3; ++c) out[c] = values.at(i, c) * factor;
                        });
}

/// In voxel space, times the fluence's sum over rgb, and g beside it: an interpolated mean
/// direction is that of the light there only if each voxel's counts by its light.
Texture makeDirection(gpu::Device& device, const Plan& plan) {
    // Directions are those of the world that the file was lit in.
    const glm::mat3 voxelFromWorld(glm::transpose(plan.scene.worldFromVoxelTurn()) *
                                   plan.scene.turned);
    const scene::Values& direction = plan.scene.light.direction;
    const scene::Values& fluence = plan.scene.light.fluence;
    return voxelTexture(
        device, plan, TexelFormat::rgba32f, false, [&](const glm::ivec3& i, float* out) {
            const float light = fluence.at(i, 0) + fluence.at(i, 1) + fluence.at(i, 2);
            const glm::vec3 d =
                light * (voxelFromWorld *
                         glm::vec3(direction.at(i, 0), direction.at(i, 1), direction.at(i, 2)));
            out[0] = d.x;
            out[1] = d.y;
            out[2] = d.z;
            out[3] = plan.scene.medium().anisotropy.at(i, 0);
        });
}

/// Extinction and source of blurred media.
void makeBlurred(gpu::Device& device, const Plan& plan, Media& media) {
    const scene::Region& medium = plan.scene.medium();
    const auto h = static_cast<float>(plan.scene.voxelSize()); // 1/unit to 1/voxel
    const bool glows = plan.scatters || plan.emits;
    const auto sigma = [&](const glm::ivec3& i, int c) {
        return (medium.absorption.at(i, c) + medium.scattering.at(i, c)) * h;
    };
    // Radiance gained per voxel of length; the phase function and emission come later where
    // scattering prefers a direction.
    const auto source = [&](const glm::ivec3& i, int c) {
        const float scattered =
            plan.scatters ? medium.scattering.at(i, c) * plan.scene.light.fluence.at(i, c) * h : 0;
        if (plan.anisotropic) return scattered;
        return scattered * kIsotropicPhase + medium.emission.at(i, c) * h;
    };
    const auto pack = [&](int components, TexelFormat format, const auto& values) {
        return voxelTexture(device, plan, format, true, [&](const glm::ivec3& i, float* out) {
            for (int c = 0; c < components; ++c) out[c] = values(i, c);
        });
    };
    if (plan.colour) {
        media.extinction = pack(3, TexelFormat::rgba32f, sigma);
        if (glows) media.source = pack(3, TexelFormat::rgba32f, source);
    } else if (glows) {
        media.extinction = pack(2, TexelFormat::rg32f, [&](const glm::ivec3& i, int c) {
            return c == 0 ? sigma(i, 0) : source(i, 0);
        });
    } else if (plan.dims) {
        media.extinction = pack(1, TexelFormat::r32f, sigma);
    }
    if (plan.anisotropic && plan.emits)
        media.emission = rgbTexture(device, plan, medium.emission, h);
    if (plan.opaque)
        media.opacity = voxelTexture(device, plan, TexelFormat::rgba32f, true,
                                     [&](const glm::ivec3& i, float* out) {
                                         out[0] = medium.opacity.at(i, 0);
                                         for (int c = 0; c < 3; ++c)
                                             out[1 + c] = medium.albedo.at(i, c);
                                     });
}

} // namespace

Media::Media(gpu::Device& device, const Plan& plan) {
    if (!plan.scene.sharp) makeBlurred(device, plan, *this);
    const bool reads = plan.scene.sharp || plan.anisotropic;
    if (plan.lit() && reads) fluence = rgbTexture(device, plan, plan.scene.light.fluence, 1);
    if (plan.anisotropic) direction = makeDirection(device, plan);
    if (!plan.scene.light.surfaces.empty())
        surfaces = scene::SurfaceLightTable(device, plan.scene.light.surfaces);
}

void Media::bind() const {
    const std::pair<const Texture*, unsigned> textures[] = {
        {&extinction, kExtinctionUnit}, {&source, kSourceUnit},   {&direction, kDirectionUnit},
        {&emission, kEmissionUnit},     {&opacity, kOpacityUnit}, {&fluence, kFluenceUnit}};
    for (const auto& [texture, unit] : textures)
        if (texture->name() != 0) texture->bindSampler(unit);
    surfaces.bind();
}

std::vector<gpu::Need> mediaNeeds(const Plan& plan) {
    const bool blurred = !plan.scene.sharp;
    std::vector<gpu::Need> needs;
    const auto texture = [&](const char* what, std::int64_t bytes) {
        needs.push_back(scene::voxelNeed(plan.scene.layout, what, bytes));
    };
    if (blurred && plan.gathers())
        texture("the medium", plan.colour ? 16 : plan.scatters || plan.emits ? 8 : 4);
    if (blurred && plan.colour && (plan.scatters || plan.emits)) texture("the scattered light", 16);
    if (blurred && plan.anisotropic && plan.emits) texture("the emission", 16);
    if (blurred && plan.opaque) texture("the opaque surfaces", 16);
    if (plan.lit() && (!blurred || plan.anisotropic)) texture("the light", 16);
    if (plan.anisotropic) texture("the light's direction", 16);
    const scene::SurfaceLight& surfaces = plan.scene.light.surfaces;
    if (!surfaces.empty())
        for (const gpu::Need& need : scene::surfaceLightNeeds(surfaces)) needs.push_back(need);
    return needs;
}

Rays::Rays(gpu::Device& device, const Plan& plan, const Params& params,
           const std::optional<image::Image>& map, gpu::Profiler& profiler)
    : mBlock(device, sizeof(ViewParams)), mWidth(params.camera.width) {
    profiler.begin("shaders");
    mProgram = gpu::Program(device, "view/trace.comp.glsl", switchesOf(plan, params));
    profiler.end();
    profiler.begin("medium");
    mTransport = scene::Transport(device, plan.scene, params, stepsOf(plan, params));
    mMedia = Media(device, plan);
    mMap = camera::makeMap(device, map);
    if (!params.points.empty()) uploadPoints(device, plan, params.points);
    if (plan.ground) {
        const GroundParams ground = groundParams(*plan.ground, plan.scene);
        mGround = gpu::Buffer(device, sizeof ground, &ground);
    }
    if (params.plate) {
        const PlateParams plate = plateParams(*params.plate, params.camera, plan.scene);
        mPlate = gpu::Buffer(device, sizeof plate, &plate);
        mPlatePicture = makePlateTexture(device, *params.plate);
    }
    profiler.end();
    const scene::Scene& scene = plan.scene;
    const double step = stepOf(plan, params);
    const double usual = params.integrator == Integrator::adaptive
                             ? std::min(step, 0.25) // what hard places take
                             : step;
    const glm::ivec3 size = scene.size();
    const int crossings = static_cast<int>(16.0 * (size.x + size.y + size.z) / usual) + 1024;
    mValues.limits =
        ivec4(params.maxSteps > 0 ? params.maxSteps : crossings, params.maxDepth, 0, 0);
    const float outside = scene.index.background;
    mValues.medium =
        vec4(outside, params.cutoff, scene.index.backgroundDispersion, 1 / (outside * outside));
    setCamera(mValues, params.camera, scene);
    const auto polariser = [&](const std::optional<double>& degrees) {
        if (!degrees) return vec4(0);
        const double angle = glm::radians(*degrees);
        const dvec3 right = glm::normalize(dvec3(mValues.right)),
                    up = glm::normalize(dvec3(mValues.up));
        return vec4(glm::vec3(std::cos(angle) * right + std::sin(angle) * up), 1);
    };
    mValues.polarizer = polariser(params.polarizer);
    mValues.backPolarizer = polariser(params.backPolarizer);
    mValues.background = camera::backgroundValues(params, map);
    const glm::dmat3 rows =
        glm::transpose(camera::mapFromFrame(params, scene.worldFromVoxelTurn()));
    mValues.mapFromVoxel0 = vec4(rows[0], 0);
    mValues.mapFromVoxel1 = vec4(rows[1], 0);
    mValues.mapFromVoxel2 = vec4(rows[2], 0);
}

void Rays::uploadPoints(gpu::Device& device, const Plan& plan, const PointLights& points) {
    const glm::ivec3 size(points.width, points.rows, 0);
    const glm::dmat4 voxelFromWorld = plan.scene.voxelFromWorld();
    std::vector<vec4> places(points.places.size()), lights(places.size());
    // Beyond the domain no light was stored, and beside its sides not the ground's alone: see
    // isAtSide() of shaders/view/ground.glsl.
    const auto isKnown = [&](const dvec3& place) {
        return !plan.ground ||
               place == glm::clamp(place, plan.ground->low + 1.0, plan.ground->high - 1.0);
    };
    for (size_t i = 0; i < places.size(); ++i) {
        const dvec3 place(voxelFromWorld * glm::dvec4(points.places[i], 1.0));
        places[i] = vec4(glm::vec3(place), points.isPoint[i] && isKnown(place));
        lights[i] = vec4(points.lights[i], 0);
    }
    mPointPlaces = Texture(device, size, TexelFormat::rgba32f, gpu::Filter::nearest);
    mPointLights = Texture(device, size, TexelFormat::rgba32f, gpu::Filter::nearest);
    mPointPlaces.upload(places.data());
    mPointLights.upload(lights.data());
}

void Rays::bind() const {
    mTransport.bind();
    mMedia.bind();
    if (mMap.name() != 0) mMap.bindSampler(kEnvironmentUnit);
    if (mPointPlaces.name() != 0) {
        mPointPlaces.bindSampler(kPointPlacesUnit);
        mPointLights.bindSampler(kPointLightsUnit);
    }
    if (mGround.bytes() > 0) mGround.bindUniform(kGroundBlock);
    if (mPlate.bytes() > 0) {
        mPlate.bindUniform(kPlateBlock);
        mPlatePicture.bindSampler(kPlateUnit);
    }
    mBlock.bindUniform(kParamsBlock);
}

void Rays::trace(int row, int rows, const Launch& one) {
    mValues.picture.z = row;
    mValues.picture.w = rows;
    mValues.pattern = vec4(one.place, one.first, 0);
    mValues.ray = ivec4(one.number, one.shift, 0, 0);
    mValues.weight = one.weight;
    mValues.limits.z = 0;
    mValues.limits.w = 0;
    launch(mWidth, rows);
}

void Rays::goOn(int resting, int half) {
    mValues.limits.z = resting;
    mValues.limits.w = half;
    launch(resting, 1);
}

void Rays::launch(int width, int rows) {
    mBlock.upload(&mValues, sizeof mValues);
    mProgram.dispatch({width, rows, 1});
    gpu::barrier();
}

} // namespace eikonal::view
