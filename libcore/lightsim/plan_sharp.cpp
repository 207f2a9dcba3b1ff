// What a light simulation of objects with sharp boundaries calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/plan_sharp.h"

#include "medium/regions.h"

#include <algorithm>
#include <cmath>

namespace eikonal::lightsim {

namespace {

using medium::anyHas;
using medium::Region;
using medium::whoHas;

/// What a render of the file would read: light where it scatters or meets an opaque surface.
Output neededOutputs(const medium::Objects& objects) {
    const bool opaque = objects.any([](const Region& region) { return region.opaque; });
    if (!opaque && !anyHas(objects, &Region::scattering)) return Output::none;
    return opaque || anyHas(objects, &Region::anisotropy) ? Output::both : Output::fluence;
}

float mostOf(const medium::OneSided& values, int c) {
    if (!values.varies()) return values.value[c];
    const size_t voxels = values.grid.voxels();
    float most = 0;
    for (size_t i = 0; i < voxels; ++i) most = std::max(most, values.at(i, c));
    return most;
}

/// The largest optical depth of a voxel's diagonal in any region and channel, or more.
double deepestVoxel(const Plan& plan) {
    float most = 0;
    for (const Region& region : plan.objects.regions)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, mostOf(region.absorption, c) + mostOf(region.scattering, c));
    return std::sqrt(3.0) * plan.voxelSize * static_cast<double>(most);
}

} // namespace

void planSharp(Plan& plan, const volume::Volume& volume, const Params& params) {
    if (volume.objects().empty()) volume.require("sdf");
    plan.objects = medium::readObjects(volume, volume.domain());
    const medium::Objects& objects = plan.objects;
    plan.outputs = params.automaticOutputs ? neededOutputs(objects) : params.outputs;
    if (plan.outputs == Output::none) return;
    medium::requireConstants(objects, volume.path(), {{"reflectance", &Region::reflectance}});
    plan.index = medium::varyingIndex(objects, volume.path());
    plan.bends = plan.index.varies();
    plan.warnings = medium::distanceWarnings(objects);
    plan.attenuates = anyHas(objects, &Region::absorption) || anyHas(objects, &Region::scattering);
    plan.colour = objects.any([](const Region& region) {
        return !region.absorption.grey() || !region.scattering.grey() || !region.reflectance.grey();
    });
    plan.dense = deepestVoxel(plan) > 0.25;
    plan.opaque = objects.any([](const Region& region) { return region.opaque; });
}

void listSharpEffects(Plan& plan, const Params& params) {
    const auto add = [&plan](const std::string& name, bool on, const std::string& why) {
        plan.effects.push_back({name, on, why});
    };
    const medium::Objects& objects = plan.objects;
    const bool runs = plan.outputs != Output::none;
    std::string opaque = "nothing is opaque";
    for (const Region& region : objects.regions)
        if (region.opaque) opaque = "'" + region.name + "' is";
    const bool anyOpaque = opaque != "nothing is opaque";
    const std::string asked = !params.automaticOutputs ? "--outputs"
                              : anyHas(objects, &Region::scattering)
                                  ? "scattering: " + whoHas(objects, &Region::scattering)
                              : anyOpaque ? "opaque: " + opaque
                                          : "nothing scatters or receives light";
    add("fluence", plan.wants(Output::fluence), asked);
    add("light_direction", plan.wants(Output::direction),
        !params.automaticOutputs || !runs ? asked
        : anyOpaque                       ? "opaque: " + opaque
                                          : "anisotropy: " + whoHas(objects, &Region::anisotropy));
    const auto [refracts, why] = medium::whatRefracts(objects);
    add("refraction", runs && refracts, runs ? why : "nothing to simulate");
    add("curved_rays", plan.bends,
        !runs        ? "nothing to simulate"
        : plan.bends ? "an index varies between boundaries"
                     : "no index varies between boundaries");
    add("absorption", runs && anyHas(objects, &Region::absorption),
        whoHas(objects, &Region::absorption));
    add("scattering", runs && anyHas(objects, &Region::scattering),
        whoHas(objects, &Region::scattering));
    add("colour", runs && plan.colour,
        plan.colour ? "coefficients or mirrors differ by wavelength"
                    : "media and mirrors are grey");
    add("opaque", runs && anyOpaque, opaque);
}

} // namespace eikonal::lightsim
