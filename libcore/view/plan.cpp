// What a picture of a scene calls for, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "scene/crystals.h"
#include "scene/effects.h"
#include "scene/transport.h"
#include "view/domains.h"
#include "view/overlaps.h"
#include "view/picture.h"
#include "view/plate.h"
#include "view/rays.h"
#include "view/shared.h"
#include "view/view.h"

#include <algorithm>

namespace eikonal::view {

namespace {

using scene::Region;

void listEffects(Plan& plan, const Params& params, const scene::Files& files) {
    const scene::Scene& scene = plan.scene;
    const std::vector<Effect> all = scene::effectsOf(scene, params);
    const auto add = [&plan](Effect effect) { plan.effects.push_back(std::move(effect)); };
    const auto named = [&](const char* name) { return scene::effectNamed(all, name); };
    add(named("sharp_boundaries"));
    add(named("refraction"));
    if (scene.sharp) add(named("curved_rays"));
    add(named("absorption"));
    const Effect scattering = named("scattering"), anisotropy = named("anisotropy");
    const std::string dimmer = scene.sharp ? "it" : "grid 'scattering'";
    add({"scattering", plan.scatters,
         scattering.on && !plan.lit() ? dimmer + " only dims: no grid 'fluence', or 0 everywhere"
                                      : scattering.why});
    add({"phase_function", plan.anisotropic,
         !plan.scatters   ? "nothing is scattered"
         : !anisotropy.on ? (scene.sharp ? "nothing has anisotropy" : anisotropy.why)
         : scene.light.direction.isZero() ? "no grid 'light_direction', or 0 everywhere"
                                          : anisotropy.why});
    add(named("emission"));
    add(named("opaque"));
    add(named("coat"));
    add(named("metal"));
    add(named("roughness"));
    add(named("crystals"));
    const bool stored = !scene.light.surfaces.empty(), points = !params.points.empty();
    const bool matt = scene.anyMatt();
    add({"irradiance", matt && (stored || points),
         matt && points
             ? stored ? "--light, and grid 'irradiance' where that has no point" : "--light"
         : matt && stored ? "grid 'irradiance'"
         : matt           ? "no grid 'irradiance'"
                          : "nothing is opaque and no metal"});
    add({"colour", plan.colour,
         plan.colour ? "coefficients or light differ by wavelength" : "medium and light are grey"});
    const bool glows = params.background != glm::dvec3(0);
    add({"environment", plan.map || glows,
         plan.map ? "--env"
         : glows  ? "--background"
                  : "neither --env nor --background"});
    add({"plate", params.plate.has_value(), params.plate ? "--plate" : "no --plate"});
    add({"ground", plan.ground && scene.sharp,
         !plan.ground  ? "no metadata 'eikonal:ground'"
         : scene.sharp ? "metadata 'eikonal:ground'"
                       : "boundaries are blurred"});
    add({"aovs", !params.aovs.empty(), params.aovs.empty() ? "no --aov" : "--aov"});
    add(named("dispersion"));
    plan.warnings = scene::warningsOf(scene);
    for (const std::string& idle : scene::idleWarnings(files, all)) plan.warnings.push_back(idle);
    if (scattering.on && !plan.lit())
        plan.warnings.push_back(scene.path + " scatters light but holds none: run lightsim first");
    if (plan.ground && !scene.sharp)
        plan.warnings.push_back("the ground of " + scene.path +
                                " ends with the domain: boundaries are blurred");
    if (matt && scene.light.surfaces.empty() && params.points.empty())
        plan.warnings.push_back("what is opaque in " + scene.path +
                                " is black, since no light is stored on it: run lightsim first");
}

} // namespace

namespace {

/// Where the waves of a weak crystal interfere light is traced by wavelength, even if nothing
/// disperses.
void letInterfere(scene::Scene& scene, const optics::Wavelengths& wavelengths) {
    const double kWeak = 0.01; // as shaders/transport/regions.glsl has it
    const bool any = std::any_of(scene.regions.begin(), scene.regions.end(), [&](const Region& r) {
        return r.crystal && std::abs(r.crystal->index - r.index.value.x) <= kWeak;
    });
    if (!any || scene.disperses || !wavelengths.disperse()) return;
    scene.disperses = true;
    scene.index.dispersed = scene.index.grid;
    scene.index.dispersedRest = scene.index.rest;
}

} // namespace

void tellEffects(Plan& plan, const Params& params) {
    const scene::Scene& scene = plan.scene;
    plan.bends = scene::effectNamed(scene::effectsOf(scene, params), "refraction").on;
    plan.dims = scene.anyHas(&Region::absorption) ||
                scene.anyHas(&Region::absorptionExtraordinary) || scene.anyHas(&Region::scattering);
    plan.emits = scene.anyHas(&Region::emission);
    plan.opaque = scene.anyOpaque();
    plan.scatters = scene.anyHas(&Region::scattering) && plan.lit();
    plan.anisotropic =
        plan.scatters && scene.anyHas(&Region::anisotropy) && !scene.light.direction.isZero();
    plan.colour = scene.anyColoured({&Region::absorption, &Region::absorptionExtraordinary,
                                     &Region::scattering, &Region::emission}) ||
                  (scene.sharp && scene.anyColoured({&Region::reflectance})) || scene.anyMetal() ||
                  (plan.scatters && !scene.light.fluence.grey());
}

Plan makePlan(const scene::Files& files, const Params& params, bool hasMap) {
    Plan plan;
    scene::Wanted wanted;
    wanted.boundary = params.boundary;
    wanted.wavelengths = params.wavelengths;
    wanted.emission = wanted.surfaces = wanted.light = true;
    plan.scene = scene::read(files, wanted);
    const scene::Scene& scene = plan.scene;
    if (const Region* crystal = scene::crystalAt(scene, params.camera.eye))
        throw DataError(scene.path + ": the eye is within the crystal '" + crystal->name +
                        "', expected it outside");
    if (params.polarises() && (scene.anyMetal() || scene.anyRough()))
        throw DataError(scene.path + ": has metal or rough boundaries, which --polarizer and "
                                     "--back-polarizer expect none of");
    if (params.unit > 0) letInterfere(plan.scene, params.wavelengths);
    plan.map = hasMap;
    tellEffects(plan, params);
    plan.ground = scene::readGround(files, scene);
    listEffects(plan, params, files);
    if (!scene.sharp) plan.ground.reset();
    return plan;
}

std::vector<gpu::Need> needsOf(const std::vector<Plan>& plans, const Params& params) {
    std::vector<gpu::Need> needs;
    const auto add = [&](const std::vector<gpu::Need>& more) {
        needs.insert(needs.end(), more.begin(), more.end());
    };
    for (const Plan& plan : plans) {
        add(scene::transportNeeds(plan.scene, params));
        add(mediaNeeds(plan));
    }
    add(pictureNeeds(plans, params));
    if (plans.size() > 1) add(domainNeeds(params));
    if (params.plate) needs.push_back(plateNeed(*params.plate));
    if (!params.points.empty())
        needs.push_back({"the light of points",
                         32 * static_cast<std::int64_t>(params.points.places.size()), false,
                         std::max(params.points.width, params.points.rows)});
    return needs;
}

namespace {

// Round the objects that a domain is cut to: what splines and stored light reach [voxel].
constexpr int kRoundObjects = 2;

/// The part of a scene's domain that has anything but the surrounding medium in it, where that is
/// clear and even.
volume::IndexBox partWithObjects(const scene::Scene& scene) {
    volume::IndexBox part;
    for (const scene::Object& object : scene.objects)
        if (!object.inside.empty()) part.include(object.inside);
    if (!scene.isClearAround() || part.empty()) return scene.domain;
    return {glm::max(part.min + scene.domain.min - kRoundObjects, scene.domain.min),
            glm::min(part.max + scene.domain.min + kRoundObjects, scene.domain.max)};
}

/// All of them see the one ground.
void shareGround(std::vector<Plan>& plans) {
    std::optional<scene::Ground> ground;
    for (const Plan& plan : plans)
        if (plan.ground && !ground) ground = plan.ground;
    if (!ground) return;
    ground->region = -1;
    for (Plan& plan : plans)
        if (!plan.ground) plan.ground = ground;
}

} // namespace

void joinEffects(std::vector<Plan>& plans) {
    Plan& first = plans.front();
    for (size_t i = 1; i < plans.size(); ++i) {
        for (size_t e = 0; e < first.effects.size(); ++e) {
            const Effect other = scene::effectNamed(plans[i].effects, first.effects[e].name);
            if (!first.effects[e].on && other.on) first.effects[e] = other;
        }
        for (const Effect& other : plans[i].effects)
            if (std::none_of(first.effects.begin(), first.effects.end(),
                             [&](const Effect& known) { return known.name == other.name; }))
                first.effects.push_back(other);
        first.warnings.insert(first.warnings.end(), plans[i].warnings.begin(),
                              plans[i].warnings.end());
    }
}

std::vector<Plan> makePlans(std::vector<scene::Files>& files, const Params& params, bool hasMap) {
    std::vector<Plan> plans;
    for (scene::Files& one : files) {
        plans.push_back(makePlan(one, params, hasMap));
        if (files.size() == 1) return plans;
        const volume::IndexBox part = partWithObjects(plans.back().scene);
        if (part.voxels() == plans.back().scene.voxels()) continue;
        one.crop(part);
        plans.back() = makePlan(one, params, hasMap);
    }
    mergeOverlapping(plans, params);
    if (plans.size() == 1) return plans;
    if (params.polarises())
        throw UsageError("--polarizer: found volumes in places of their own, expected one place");
    if (plans.size() > static_cast<size_t>(kMostDomains))
        throw DataError(std::to_string(plans.size()) +
                        " volumes in places of their own, expected " +
                        std::to_string(kMostDomains) + " at most");
    shareDispersion(plans);
    shareGround(plans);
    const bool paths = std::any_of(plans.begin(), plans.end(),
                                   [&](const Plan& plan) { return wantsPaths(plan, params); });
    for (Plan& plan : plans) {
        plan.several = true;
        plan.paths = paths;
    }
    joinEffects(plans);
    return plans;
}

} // namespace eikonal::view
