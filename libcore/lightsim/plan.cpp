// What a light simulation of a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/plan.h"

#include "base/error.h"
#include "base/text.h"
#include "lightsim/beams.h"
#include "lightsim/fronts.h"
#include "lightsim/photons.h"
#include "lightsim/points.h"
#include "lightsim/surfaces.h"
#include "lightsim/voxels.h"
#include "scene/crystals.h"
#include "scene/effects.h"
#include "scene/transport.h"
#include "scene/voxel_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace eikonal::lightsim {

namespace {

using scene::Region;

// Sources that stand for an extended light, where nothing else is asked for. Many share a batch of
// photons; each has beams or a front of its own.
constexpr int kPhotonSources = 256;
constexpr int kBeamSources = 64;
constexpr int kFrontSources = 16;
constexpr int kLeastSources = 8;

bool isGrey(const glm::dvec3& rgb) {
    return rgb.x == rgb.y && rgb.y == rgb.z;
}

bool isGrey(const image::Image& map) {
    for (size_t i = 0; i < map.area(); ++i)
        if (map.plane(0)[i] != map.plane(1)[i] || map.plane(0)[i] != map.plane(2)[i]) return false;
    return true;
}

bool receives(const scene::Scene& scene) {
    return scene.anyMatt();
}

/// "'glass' is", "'a', 'b' are".
std::string roughNames(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const Region& region : scene.regions)
        if (region.roughness > 0) names.push_back("'" + region.name + "'");
    return join(names, ", ") + (names.size() == 1 ? " is" : " are");
}

/// What a render of the file would read: light where it scatters or falls on an opaque surface.
Output neededOutputs(const scene::Scene& scene) {
    Output needed = Output::none;
    if (scene.anyHas(&Region::scattering)) {
        needed = Output::fluence;
        if (scene.anyHas(&Region::anisotropy)) needed = Output::both;
    }
    if (receives(scene)) needed = needed | Output::irradiance;
    return needed;
}

/// The largest optical depth of a voxel's diagonal in any region and traced channel, or more.
double deepestVoxel(const Plan& plan) {
    float most = 0;
    for (const Region& region : plan.scene.regions)
        for (int c = 0; c < plan.tracedChannels(); ++c)
            most = std::max(
                most, std::max(region.absorption.most(c), region.absorptionExtraordinary.most(c)) +
                          region.scattering.most(c));
    return std::sqrt(3.0) * plan.scene.voxelSize() * static_cast<double>(most);
}

/// Whether an output is simulated, and why: asked for, or what calls for it.
Effect outputEffect(const Plan& plan, const Params& params, const char* name, Output output,
                    const Effect& cause) {
    if (!params.automaticOutputs) return {name, plan.wants(output), "--outputs"};
    const bool tells = plan.scene.sharp && cause.on;
    return {name, plan.wants(output), tells ? cause.name + ": " + cause.why : cause.why};
}

void listEffects(Plan& plan, const Params& params) {
    const std::vector<Effect> all = scene::effectsOf(plan.scene, params.tracing);
    const bool sharp = plan.scene.sharp, runs = plan.outputs != Output::none;
    const auto add = [&plan](Effect effect) { plan.effects.push_back(std::move(effect)); };
    const auto named = [&](const std::string& name) {
        Effect effect = scene::effectNamed(all, name);
        effect.on = effect.on && runs;
        return effect;
    };
    const auto nothing = [&](Effect effect) {
        return runs ? effect : Effect{effect.name, false, "nothing to simulate"};
    };
    add(named("sharp_boundaries"));
    const Effect scattering = scene::effectNamed(all, "scattering");
    Effect anisotropy = scene::effectNamed(all, "anisotropy");
    if (!scattering.on) anisotropy = {"anisotropy", false, "nothing is scattered"};
    add(outputEffect(plan, params, "fluence", Output::fluence, scattering));
    add(outputEffect(plan, params, "light_direction", Output::direction, anisotropy));
    Effect irradiance = outputEffect(plan, params, "irradiance", Output::irradiance,
                                     scene::effectNamed(all, "opaque"));
    if (irradiance.on && !plan.surfaces.empty()) {
        const std::string edge = std::to_string(plan.surfaces.detail);
        irradiance.why += ", by " + edge + " x " + edge + " x " + edge + " fine voxels a voxel";
    }
    add(irradiance);
    const bool aimed =
        plan.isPlainBetween() && params.proxy.empty() && (plan.surfaces.empty() || plan.beams);
    add({"photons", plan.photons,
         plan.photons     ? !plan.receivesInVolume() ? "irradiance is made of them"
                            : aimed ? "fluence is made of them, but of one sun's or lamp's light that "
                                      "meets nothing"
                                    : "fluence is made of them"
         : plan.wavefront ? "--method wavefront"
                          : "no volume receives light"});
    const bool rough = plan.scene.anyRough() && !plan.surfaces.empty();
    add({"beams", plan.beams,
         plan.beams ? "irradiance is made of them"
         : rough    ? roughNames(plan.scene) + " rough: photons carry light to surfaces"
                    : "no surface receives light"});
    add({"bounces", plan.bounces > 0,
         plan.bounces > 0        ? "--bounces " + std::to_string(plan.bounces) + ", by photons"
         : params.bounces == 0   ? "--bounces 0"
         : plan.surfaces.empty() ? "no surface receives light"
                                 : "no opaque surface has an albedo"});
    if (params.method == Method::wavefront)
        add({"wavefront", plan.wavefront,
             plan.wavefront ? "fluence is made of it" : "no volume receives light"});
    add(nothing(named("refraction")));
    if (sharp) add(nothing(named("curved_rays")));
    add(named("absorption"));
    add(named("scattering"));
    add({"colour", runs && plan.colour,
         plan.colouredSources ? "parts of an environment differ by wavelength"
         : plan.colour        ? (sharp ? "coefficients or mirrors differ by wavelength"
                                       : "coefficients differ by wavelength")
         : sharp              ? "media and mirrors are grey"
         : plan.attenuates    ? "the medium is grey"
                              : "nothing absorbs or scatters"});
    add(named("opaque"));
    add(nothing(named("coat")));
    add(nothing(named("metal")));
    add(nothing(named("roughness")));
    add(nothing(named("crystals")));
    add(nothing(named("dispersion")));
}

} // namespace

Plan makePlan(const volume::Volume& volume, const Params& params) {
    Plan plan;
    scene::Wanted wanted;
    wanted.boundary = params.tracing.boundary;
    wanted.wavelengths = params.tracing.wavelengths;
    wanted.onlyIfLightShows = params.automaticOutputs;
    wanted.surfaces = params.bounces > 0;
    plan.scene = scene::read(scene::Files(volume), wanted);
    const scene::Scene& scene = plan.scene;
    plan.outputs = params.automaticOutputs ? neededOutputs(scene) : params.outputs;
    if (!params.points.empty()) plan.outputs = receives(scene) ? Output::irradiance : Output::none;
    plan.bends = scene.index.varies();
    plan.attenuates = scene.anyHas(&Region::absorption) ||
                      scene.anyHas(&Region::absorptionExtraordinary) ||
                      scene.anyHas(&Region::scattering);
    plan.colour = scene.anyColoured({&Region::absorption, &Region::absorptionExtraordinary,
                                     &Region::scattering}) ||
                  (scene.sharp && scene.anyColoured({&Region::reflectance})) || scene.anyMetal();
    plan.dense = deepestVoxel(plan) > 0.25;
    plan.opaque = scene.anyOpaque();
    for (const Light& light : params.lights) {
        plan.colouredLight |= !isGrey(light.rgb);
        plan.sourcesDiffer |= light.isExtended() || light.kind == Light::Kind::spot;
        plan.polarised |= scene.sharp && light.polarizer != glm::dvec3(0);
    }
    if (plan.wants(Output::irradiance)) plan.surfaces = findSurfaces(scene, params.surfaceDetail);
    if (!params.points.empty()) {
        plan.points = pointsInVoxels(params.points, scene);
        plan.surfaces = surfacesNear(plan.surfaces, plan.points, params.points.width, scene.size(),
                                     params.surfaceDetail);
        if (plan.surfaces.empty()) plan.outputs = Output::none;
    }
    if (params.method == Method::beams && plan.receivesInVolume())
        throw UsageError("--method: beams carry light to surfaces alone, and " + volume.path() +
                         " scatters light; expected auto or photons");
    for (const Light& light : params.lights)
        if (const Region* crystal =
                light.hasPlace() ? scene::crystalAt(scene, light.vector) : nullptr)
            throw DataError(volume.path() + ": a light is within the crystal '" + crystal->name +
                            "', expected it outside");
    if (scene.anyCrystal() && params.method == Method::wavefront)
        throw UsageError("--method: " + volume.path() +
                         " has crystals, through which no wavefronts are traced; expected auto, "
                         "beams or photons");
    if (plan.polarised && (scene.anyMetal() || scene.anyRough()))
        throw DataError(volume.path() +
                        ": has metal or rough boundaries, which a light's polarizer "
                        "expects none of");
    if (plan.polarised && params.method == Method::wavefront)
        throw UsageError("--light: found a polarizer, which wavefronts do not carry; expected "
                         "--method auto, beams or photons");
    const bool rough = scene.anyRough();
    if (rough && (params.method == Method::beams || params.method == Method::wavefront))
        throw UsageError(
            "--method: " + roughNames(scene) + " of " + volume.path() +
            " rough, where light is carried by photons alone; expected auto or photons");
    plan.beams = params.method != Method::photons && !plan.surfaces.empty() && !rough;
    plan.wavefront = params.method == Method::wavefront && plan.receivesInVolume();
    plan.photons =
        (plan.receivesInVolume() && !plan.wavefront) || (!plan.beams && !plan.surfaces.empty());
    if (!plan.surfaces.empty() && scene.anyHas(&Region::albedo)) plan.bounces = params.bounces;
    plan.colour |= plan.bounces > 0 && scene.anyColoured({&Region::albedo});
    // Parts of an environment differ in colour, and their photons share batches.
    for (const Light& light : params.lights)
        plan.colouredSources |= plan.sendsPhotons() && light.map && !isGrey(*light.map);
    plan.colour |= plan.colouredSources;
    listEffects(plan, params);
    if (!volume.holdsScene()) plan.warnings = scene::idleWarnings(scene::Files(volume), {});
    if (plan.outputs == Output::none) return plan;
    if (plan.receivesInVolume()) plan.receiving = receivingBricks(scene, params);
    for (const std::string& warning : scene::warningsOf(scene)) plan.warnings.push_back(warning);
    if (!params.proxy.empty() && plan.attenuates)
        plan.warnings.push_back("--proxy skips the medium between the domain's faces and the "
                                "proxy: it neither dims nor receives light there");
    return plan;
}

int samplesFor(const Plan& plan, const Params& params, const Light& light, Method method) {
    if (!light.isExtended()) return 1;
    if (params.lightSamples > 0) return params.lightSamples;
    if (method == Method::photons) return kPhotonSources;
    if (method == Method::wavefront) return kFrontSources;
    if (light.kind != Light::Kind::directional) return kBeamSources;
    // The widest penumbra of the domain fades by steps of a fine voxel.
    const double across = glm::length(glm::dvec3(plan.scene.size())) * plan.surfaces.detail;
    const double wide = 2 * std::tan(glm::radians(0.5 * std::min(light.angle, 90.0))) * across;
    return std::clamp(static_cast<int>(std::ceil(wide)), kLeastSources, kBeamSources);
}

std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params) {
    const glm::ivec3 size = plan.scene.size();
    const std::int64_t voxels = plan.voxels();
    const int edge = std::max({size.x, size.y, size.z});
    std::vector<gpu::Need> needs = scene::transportNeeds(plan.scene, params.tracing);
    const auto add = [&needs](const std::vector<gpu::Need>& more) {
        needs.insert(needs.end(), more.begin(), more.end());
    };
    if (plan.receivesInVolume()) add(voxelNeeds(plan, params));
    if (!plan.surfaces.empty()) add(surfaceNeeds(plan));
    if (!plan.points.empty()) add(pointNeeds(plan.points));
    if (plan.beams) add(beamNeeds(plan, params));
    if (plan.wavefront) add(frontNeeds(plan, params));
    if (plan.usesOctree()) needs.push_back({"the octree", voxels / 2, false, (edge + 1) / 2});
    if (plan.attenuates && !plan.scene.sharp)
        needs.push_back(
            scene::voxelNeed(plan.scene.layout, "the coefficients", plan.colour ? 32 : 8));
    if (!plan.sendsPhotons()) return needs;
    const std::int64_t pixels =
        params.photons > 0 ? std::min<std::int64_t>(params.photons, kBatchPixels) : kBatchPixels;
    const std::int64_t photon =
        kBytesPerPhoton + (scene::areMany(plan.scene.objects) ? kBytesPerSet : 0);
    needs.push_back({"the photons", pixels * photon, true, 0});
    if (plan.polarises())
        needs.push_back({"the photons' polarisations", pixels * kBytesPerPolarisation, true, 0});
    return needs;
}

} // namespace eikonal::lightsim
