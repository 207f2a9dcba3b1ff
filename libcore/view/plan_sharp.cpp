// What a picture of objects with sharp boundaries calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/plan_sharp.h"

#include "medium/regions.h"

namespace eikonal::view {

using medium::anyHas;
using medium::Region;
using medium::whoHas;

void planSharp(Plan& plan, const Scene& scene) {
    plan.objects = scene.objects();
    const medium::Objects& objects = plan.objects;
    medium::requireConstants(objects, scene.path(),
                             {{"albedo", &Region::albedo}, {"reflectance", &Region::reflectance}});
    plan.index = medium::varyingIndex(objects, scene.path());
    plan.bends = medium::whatRefracts(objects).first;
    plan.opaque = objects.any([](const Region& region) { return region.opaque; });
    plan.colour = objects.any([](const Region& region) {
        return !region.absorption.grey() || !region.scattering.grey() || !region.emission.grey() ||
               !region.reflectance.grey();
    });
    plan.warnings = medium::distanceWarnings(objects);
    const bool scatters = anyHas(objects, &Region::scattering);
    const bool lobes = anyHas(objects, &Region::anisotropy);
    plan.dims = scatters || anyHas(objects, &Region::absorption);
    plan.emits = anyHas(objects, &Region::emission);
    if (scatters || plan.opaque) plan.fluence = scene.fluence();
    plan.scatters = scatters && plan.fluence.present;
    plan.scattersUnlit = scatters && !plan.fluence.present;
    if (plan.fluence.present && (lobes || plan.opaque))
        plan.lightDirection = scene.lightDirection();
    plan.lobes = plan.scatters && lobes && plan.lightDirection.present;
    plan.colour |= plan.scatters && !plan.fluence.grey;
}

void listSharpEffects(Plan& plan) {
    const auto add = [&plan](const std::string& name, bool on, const std::string& why) {
        plan.effects.push_back({name, on, why});
    };
    const medium::Objects& objects = plan.objects;
    const auto [refracts, why] = medium::whatRefracts(objects);
    add("refraction", refracts, why);
    add("curved_rays", plan.index.varies(),
        plan.index.varies() ? "an index varies between boundaries"
                            : "no index varies between boundaries");
    add("absorption", anyHas(objects, &Region::absorption), whoHas(objects, &Region::absorption));
    add("scattering", plan.scatters,
        plan.scattersUnlit ? "it only dims: no grid 'fluence', or 0 everywhere"
                           : whoHas(objects, &Region::scattering));
    add("phase_function", plan.lobes,
        !plan.scatters                         ? "nothing is scattered"
        : plan.lobes                           ? whoHas(objects, &Region::anisotropy)
        : anyHas(objects, &Region::anisotropy) ? "no grid 'light_direction', or 0 everywhere"
                                               : "nothing has anisotropy");
    add("emission", plan.emits, whoHas(objects, &Region::emission));
    std::string opaque = "nothing is opaque";
    for (const Region& region : objects.regions)
        if (region.opaque) opaque = "'" + region.name + "' is";
    add("opaque", plan.opaque, opaque);
}

} // namespace eikonal::view
