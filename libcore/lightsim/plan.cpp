// What a light simulation of a volume will do, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lightsim/plan.h"

#include "base/text.h"
#include "lightsim/photons.h"
#include "lightsim/voxels.h"
#include "scene/effects.h"
#include "scene/transport.h"
#include "scene/voxel_textures.h"

#include <algorithm>
#include <cmath>

namespace eikonal::lightsim {

namespace {

using scene::Region;

bool isGrey(const glm::dvec3& rgb) {
    return rgb.x == rgb.y && rgb.y == rgb.z;
}

bool receives(const scene::Scene& scene) {
    return scene.sharp ? scene.anyOpaque() : scene.anyHas(&Region::opacity);
}

/// What a render of the file would read: light where it scatters or falls on an opaque surface.
Output neededOutputs(const scene::Scene& scene) {
    if (!scene.showsLight()) return Output::none;
    const bool direction = receives(scene) || scene.anyHas(&Region::anisotropy);
    return direction ? Output::both : Output::fluence;
}

/// The largest optical depth of a voxel's diagonal in any region and traced channel, or more.
double deepestVoxel(const Plan& plan) {
    float most = 0;
    for (const Region& region : plan.scene.regions)
        for (int c = 0; c < plan.tracedChannels(); ++c)
            most = std::max(most, region.absorption.most(c) + region.scattering.most(c));
    return std::sqrt(3.0) * plan.scene.voxelSize() * static_cast<double>(most);
}

/// Why light is stored at all.
std::string whyStored(const Plan& plan, const Params& params, const std::vector<Effect>& all) {
    if (!params.automaticOutputs) return "--outputs";
    const Effect scattering = scene::effectNamed(all, "scattering");
    if (scattering.on) return plan.scene.sharp ? "scattering: " + scattering.why : scattering.why;
    if (!receives(plan.scene))
        return plan.scene.sharp ? "nothing scatters or receives light"
                                : "no grid scatters or receives light";
    const std::string why = scene::effectNamed(all, "opaque").why;
    return plan.scene.sharp ? "opaque: " + why : why;
}

void listEffects(Plan& plan, const Params& params) {
    const std::vector<Effect> all = scene::effectsOf(plan.scene, params.tracing.boundary);
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
    const std::string stored = whyStored(plan, params, all);
    add({"fluence", plan.wants(Output::fluence), stored});
    std::string direction = stored;
    if (params.automaticOutputs && runs) {
        const Effect opaque = named("opaque"), anisotropy = named("anisotropy");
        const std::string of = sharp ? (receives(plan.scene) ? "opaque: " : "anisotropy: ") : "";
        direction = of + (receives(plan.scene) ? opaque.why : anisotropy.why);
        if (!sharp && !plan.wants(Output::direction)) direction = "scattering is isotropic";
    }
    add({"light_direction", plan.wants(Output::direction), direction});
    add(nothing(named("refraction")));
    if (sharp) add(nothing(named("curved_rays")));
    add(named("absorption"));
    add(named("scattering"));
    add({"colour", runs && plan.colour,
         plan.colour       ? (sharp ? "coefficients or mirrors differ by wavelength"
                                    : "coefficients differ by wavelength")
         : sharp           ? "media and mirrors are grey"
         : plan.attenuates ? "the medium is grey"
                           : "nothing absorbs or scatters"});
    add(named("opaque"));
    if (plan.scene.disperses) add(named("dispersion"));
}

} // namespace

Plan makePlan(const volume::Volume& volume, const Params& params) {
    Plan plan;
    scene::Wanted wanted;
    wanted.boundary = params.tracing.boundary;
    wanted.onlyIfLightShows = params.automaticOutputs;
    plan.scene = scene::read(scene::Files(volume), wanted);
    const scene::Scene& scene = plan.scene;
    plan.outputs = params.automaticOutputs ? neededOutputs(scene) : params.outputs;
    plan.bends = scene.index.varies();
    plan.attenuates = scene.anyHas(&Region::absorption) || scene.anyHas(&Region::scattering);
    plan.colour = scene.anyColoured({&Region::absorption, &Region::scattering}) ||
                  (scene.sharp && scene.anyColoured({&Region::reflectance}));
    plan.dense = deepestVoxel(plan) > 0.25;
    plan.opaque = scene.anyOpaque();
    for (const Light& light : params.lights) plan.colouredLight |= !isGrey(light.rgb);
    listEffects(plan, params);
    if (!volume.holdsScene()) plan.warnings = scene::idleWarnings(scene::Files(volume), {});
    if (plan.outputs == Output::none) return plan;
    plan.receiving = receivingBricks(scene, params);
    for (const std::string& warning : scene::warningsOf(scene)) plan.warnings.push_back(warning);
    if (!params.proxy.empty() && plan.attenuates)
        plan.warnings.push_back("--proxy skips the medium between the domain's faces and the "
                                "proxy: it neither dims nor receives light there");
    return plan;
}

std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params) {
    const glm::ivec3 size = plan.scene.size();
    const std::int64_t voxels = plan.voxels();
    const int edge = std::max({size.x, size.y, size.z});
    std::vector<gpu::Need> needs = scene::transportNeeds(plan.scene, params.tracing);
    for (const gpu::Need& need : voxelNeeds(plan, params)) needs.push_back(need);
    if (plan.usesOctree()) needs.push_back({"the octree", voxels / 2, false, (edge + 1) / 2});
    if (plan.attenuates && !plan.scene.sharp)
        needs.push_back(
            scene::voxelNeed(plan.scene.layout, "the coefficients", plan.colour ? 32 : 8));
    const std::int64_t pixels = std::min<std::int64_t>(params.photons, kBatchPixels);
    const std::int64_t photon =
        kBytesPerPhoton + (scene::areMany(plan.scene.objects) ? kBytesPerSet : 0);
    needs.push_back({"the photons", pixels * photon, true, 0});
    return needs;
}

} // namespace eikonal::lightsim
