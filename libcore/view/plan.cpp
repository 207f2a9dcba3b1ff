// What a picture of a scene calls for, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/effects.h"
#include "scene/transport.h"
#include "view/picture.h"
#include "view/rays.h"
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

Plan makePlan(const scene::Files& files, const Params& params, bool hasMap) {
    Plan plan;
    scene::Wanted wanted;
    wanted.boundary = params.boundary;
    wanted.wavelengths = params.wavelengths;
    wanted.emission = wanted.surfaces = wanted.light = true;
    plan.scene = scene::read(files, wanted);
    const scene::Scene& scene = plan.scene;
    plan.map = hasMap;
    plan.bends = scene::effectNamed(scene::effectsOf(scene, params), "refraction").on;
    plan.dims = scene.anyHas(&Region::absorption) || scene.anyHas(&Region::scattering);
    plan.emits = scene.anyHas(&Region::emission);
    plan.opaque = scene.anyOpaque();
    plan.scatters = scene.anyHas(&Region::scattering) && plan.lit();
    plan.anisotropic =
        plan.scatters && scene.anyHas(&Region::anisotropy) && !scene.light.direction.isZero();
    plan.colour =
        scene.anyColoured({&Region::absorption, &Region::scattering, &Region::emission}) ||
        (scene.sharp && scene.anyColoured({&Region::reflectance})) || scene.anyMetal() ||
        (plan.scatters && !scene.light.fluence.grey());
    plan.ground = scene::readGround(files, scene);
    listEffects(plan, params, files);
    if (!scene.sharp) plan.ground.reset();
    return plan;
}

std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params) {
    std::vector<gpu::Need> needs = scene::transportNeeds(plan.scene, params);
    for (const gpu::Need& need : mediaNeeds(plan)) needs.push_back(need);
    for (const gpu::Need& need : pictureNeeds(plan, params)) needs.push_back(need);
    if (!params.points.empty())
        needs.push_back({"the light of points",
                         32 * static_cast<std::int64_t>(params.points.places.size()), false,
                         std::max(params.points.width, params.points.rows)});
    return needs;
}

} // namespace eikonal::view
