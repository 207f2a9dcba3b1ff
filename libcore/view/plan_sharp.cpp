// What a picture of objects with sharp boundaries calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/plan_sharp.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace eikonal::view {

namespace {

using medium::OneSided;
using medium::Region;

/// The one index grid that varies, of whichever region.
medium::Index varyingIndex(const medium::Objects& objects, const std::string& path) {
    medium::Index index;
    index.background = objects.regions.back().index.value.x;
    index.least = index.most = index.background;
    for (const Region& region : objects.regions) {
        if (!region.index.varies()) continue;
        if (index.varies())
            throw DataError(path + ": the index varies in '" + region.name +
                            "' and elsewhere, expected it to vary on one side of sharp boundaries "
                            "at most");
        const auto& values = region.index.grid.values;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        index.least = *least;
        index.most = *most;
        index.grid = region.index.grid;
    }
    return index;
}

void requireConstants(const medium::Objects& objects, const std::string& path) {
    const std::pair<const char*, OneSided Region::*> grids[] = {
        {"albedo", &Region::albedo}, {"reflectance", &Region::reflectance}};
    for (const Region& region : objects.regions)
        for (const auto& [grid, values] : grids)
            if ((region.*values).varies())
                throw DataError(path + ": grid '" + grid + "' of '" + region.name +
                                "' varies, expected one value on each side of sharp boundaries "
                                "(--boundary blurred takes any)");
}

/// Who has a value that is not 0, in words.
std::string whoHas(const Plan& plan, OneSided Region::*values) {
    for (const Region& region : plan.objects.regions)
        if (!(region.*values).isZero()) return "'" + region.name + "' has it";
    return "nothing has it";
}

bool anyHas(const Plan& plan, OneSided Region::*values) {
    const auto& regions = plan.objects.regions;
    return std::any_of(regions.begin(), regions.end(),
                       [&](const Region& region) { return !(region.*values).isZero(); });
}

} // namespace

void planSharp(Plan& plan, const Scene& scene) {
    plan.objects = scene.objects();
    const auto& regions = plan.objects.regions;
    requireConstants(plan.objects, scene.path());
    plan.index = varyingIndex(plan.objects, scene.path());
    for (const Region& region : regions) {
        plan.opaque |= region.opaque;
        plan.colour |= !region.absorption.grey() || !region.scattering.grey() ||
                       !region.emission.grey() || !region.reflectance.grey();
        plan.bends |= region.index.varies() || region.index.value != regions.back().index.value;
    }
    const bool scatters = anyHas(plan, &Region::scattering);
    const bool lobes = anyHas(plan, &Region::anisotropy);
    plan.dims = scatters || anyHas(plan, &Region::absorption);
    plan.emits = anyHas(plan, &Region::emission);
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
    std::string why = "the index is the same everywhere";
    for (const Region& region : plan.objects.regions)
        if (region.index.value != plan.objects.regions.back().index.value || region.index.varies())
            why = "'" + region.name + "' has an index of its own";
    add("refraction", plan.bends, why);
    add("curved_rays", plan.index.varies(),
        plan.index.varies() ? "an index varies between boundaries"
                            : "no index varies between boundaries");
    add("absorption", anyHas(plan, &Region::absorption), whoHas(plan, &Region::absorption));
    add("scattering", plan.scatters,
        plan.scattersUnlit ? "it only dims: no grid 'fluence', or 0 everywhere"
                           : whoHas(plan, &Region::scattering));
    add("phase_function", plan.lobes,
        !plan.scatters ? "nothing is scattered"
        : plan.lobes   ? whoHas(plan, &Region::anisotropy)
        : anyHas(plan, &Region::anisotropy) ? "no grid 'light_direction', or 0 everywhere"
                                            : "nothing has anisotropy");
    add("emission", plan.emits, whoHas(plan, &Region::emission));
    why = "nothing is opaque";
    for (const Region& region : plan.objects.regions)
        if (region.opaque) why = "'" + region.name + "' is";
    add("opaque", plan.opaque, why);
}

} // namespace eikonal::view
