// What a light simulation of a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/plan.h"

#include "base/error.h"
#include "base/text.h"
#include "lightsim/lightsim.h"
#include "lightsim/plan_sharp.h"
#include "medium/surfaces.h"

#include <algorithm>
#include <cmath>

namespace eikonal::lightsim {

namespace {

bool isGrey(const glm::dvec3& rgb) {
    return rgb.x == rgb.y && rgb.y == rgb.z;
}

/// What a render of the file would read: light where it scatters or meets an opaque surface.
Output neededOutputs(const volume::Volume& volume, const Plan& plan) {
    if (!plan.scattering.present && !plan.opacity.present) return Output::none;
    const bool lobes = plan.scattering.present &&
                       medium::readCoefficient(volume, "anisotropy", volume.domain()).present;
    return lobes || plan.opacity.present ? Output::both : Output::fluence;
}

/// The largest optical depth of a voxel's diagonal in any channel.
double deepestVoxel(const Plan& plan) {
    if (!plan.attenuates) return 0;
    float most = 0;
    const auto voxels = static_cast<size_t>(plan.voxels());
    for (int c = 0; c < plan.tracedChannels(); ++c)
        for (size_t i = 0; i < voxels; ++i)
            most = std::max(most, plan.absorption.at(i, c) + plan.scattering.at(i, c));
    return std::sqrt(3.0) * plan.voxelSize * static_cast<double>(most);
}

std::string present(const std::string& grid, const medium::Coefficient& coefficient) {
    return coefficient.present ? "grid '" + grid + "'" : "no grid '" + grid + "', or 0 everywhere";
}

void listBlurredEffects(Plan& plan, const Params& params) {
    const auto add = [&plan](const std::string& name, bool on, const std::string& why) {
        plan.effects.push_back({name, on, why});
    };
    const bool runs = plan.outputs != Output::none;
    const std::string asked = params.automaticOutputs
                                  ? (plan.scattering.present ? "grid 'scattering'"
                                     : plan.opacity.present  ? "grid 'opacity'"
                                                             : "no grid scatters or receives light")
                                  : "--outputs";
    add("fluence", plan.wants(Output::fluence), asked);
    const bool direction = plan.wants(Output::direction);
    add("light_direction", direction,
        !params.automaticOutputs ? "--outputs"
        : !runs                  ? asked
        : direction              ? (plan.opacity.present ? "grid 'opacity'" : "grid 'anisotropy'")
                                 : "scattering is isotropic");
    add("refraction", runs && plan.bends,
        !runs        ? "nothing to simulate"
        : plan.bends ? "grid 'ior'"
                     : "the index is " + toText(plan.index.least) + " everywhere");
    add("absorption", runs && plan.absorption.present, present("absorption", plan.absorption));
    add("scattering", runs && plan.scattering.present, present("scattering", plan.scattering));
    add("colour", runs && plan.colour,
        plan.attenuates ? (plan.colour ? "coefficients differ by wavelength" : "the medium is grey")
                        : "nothing absorbs or scatters");
    add("opaque", runs && plan.opaque, present("opacity", plan.opacity));
}

void listEffects(Plan& plan, const Params& params, const volume::Volume& volume) {
    const bool runs = plan.outputs != Output::none;
    plan.effects.push_back({"sharp_boundaries", runs && plan.sharp,
                            plan.sharp ? "grid 'sdf'"
                            : params.tracing.boundary == optics::Boundary::blurred
                                ? "--boundary blurred"
                                : "no grid 'sdf'"});
    if (plan.sharp)
        listSharpEffects(plan, params);
    else
        listBlurredEffects(plan, params);
    if (volume.has("dispersion"))
        plan.effects.push_back({"dispersion", false, "photons are traced at 587.6 nm alone"});
    if (runs && plan.index.jumpAtFaces > 1e-3f)
        plan.warnings.push_back("the index jumps by " + toText(plan.index.jumpAtFaces) +
                                " at the domain's faces, which do not refract");
    if (runs && !params.proxy.empty() && plan.attenuates)
        plan.warnings.push_back("--proxy skips the medium between the domain's faces and the "
                                "proxy: it neither dims nor receives light there");
}

void planBlurred(Plan& plan, const volume::Volume& volume, const Params& params) {
    plan.scattering = medium::readCoefficient(volume, "scattering", volume.domain());
    plan.opacity = medium::readCoefficient(volume, "opacity", volume.domain());
    plan.outputs = params.automaticOutputs ? neededOutputs(volume, plan) : params.outputs;
    if (plan.outputs != Output::none) {
        plan.index = medium::readIndex(volume, volume.domain());
        plan.absorption = medium::readCoefficient(volume, "absorption", volume.domain());
    }
    plan.bends = plan.index.varies();
    plan.attenuates = plan.absorption.present || plan.scattering.present;
    plan.colour = !plan.absorption.grey || !plan.scattering.grey;
    plan.dense = deepestVoxel(plan) > 0.25;
    plan.opaque = plan.opacity.present &&
                  std::any_of(plan.opacity.grid.values.begin(), plan.opacity.grid.values.end(),
                              [](float opacity) { return opacity > 0.5f; });
}

} // namespace

Plan makePlan(const volume::Volume& volume, const Params& params) {
    Plan plan;
    plan.size = volume.domain().size();
    plan.voxelSize = volume.frame().voxelSize;
    plan.sharp =
        params.tracing.boundary == optics::Boundary::sharp ||
        (params.tracing.boundary == optics::Boundary::automatic && !volume.objects().empty());
    if (plan.sharp)
        planSharp(plan, volume, params);
    else
        planBlurred(plan, volume, params);
    for (const Light& light : params.lights) plan.colouredLight |= !isGrey(light.rgb);
    listEffects(plan, params, volume);
    return plan;
}

std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params) {
    std::vector<gpu::Need> needs;
    const std::int64_t voxels = plan.voxels();
    const int edge = std::max({plan.size.x, plan.size.y, plan.size.z});
    for (int plane = 0; plane < plan.planes(); ++plane)
        needs.push_back({"a plane of light (" + std::to_string(plan.size.x) + " x " +
                             std::to_string(plan.size.y) + " x " + std::to_string(plan.size.z) +
                             " voxels)",
                         voxels * 4, true, 0});
    // Twice while it is smoothed, when the planes are gone.
    const int floats = plan.fluenceChannels() + (plan.wants(Output::direction) ? 3 : 0);
    const int more = params.smoothing > 0 ? std::max(floats - plan.planes(), 0) : 0;
    needs.push_back({"the summed light", voxels * 4 * (floats + more), false, 0});
    if (plan.bends) needs.push_back(medium::fieldNeed(plan.size, params.tracing.sampling()));
    if (plan.sharp)
        for (const gpu::Need& need : medium::surfaceNeeds(plan.objects)) needs.push_back(need);
    if (plan.bends || (plan.attenuates && !plan.sharp))
        needs.push_back(
            {"the octree", voxels / 8 * (4 + 3 * 16) + voxels * 8, false, (edge + 1) / 2});
    if (plan.attenuates && !plan.sharp)
        needs.push_back({"the coefficients", voxels * (plan.colour ? 32 : 8), false, edge + 2});
    const std::int64_t pixels = std::min<std::int64_t>(params.photons, kBatchPixels);
    needs.push_back({"the photons", pixels * (80 + 2 * 4 + 16 + (plan.sharp ? 16 : 0)), true, 0});
    return needs;
}

} // namespace eikonal::lightsim
