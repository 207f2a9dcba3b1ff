// What a picture of a scene calls for, decided before anything is allocated.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"
#include "medium/field.h"
#include "medium/surfaces.h"
#include "view/bands.h"
#include "view/plan_sharp.h"
#include "view/view.h"

#include <algorithm>

namespace eikonal::view {

namespace {

std::string present(const std::string& grid, const medium::Coefficient& coefficient) {
    return coefficient.present ? "grid '" + grid + "'" : "no grid '" + grid + "', or 0 everywhere";
}

void listEffects(Plan& plan, const Scene& scene, const Params& params) {
    const auto add = [&plan](const std::string& name, bool on, const std::string& why) {
        plan.effects.push_back({name, on, why});
    };
    add("sharp_boundaries", plan.sharp,
        plan.sharp                                     ? "grid 'sdf'"
        : params.boundary == optics::Boundary::blurred ? "--boundary blurred"
                                                       : "no grid 'sdf'");
    if (plan.sharp) {
        listSharpEffects(plan);
    } else {
        add("refraction", plan.bends,
            plan.bends ? "grid 'ior'" : "the index is " + toText(plan.index.least) + " everywhere");
        add("absorption", plan.absorption.present, present("absorption", plan.absorption));
        add("scattering", plan.scatters,
            plan.scattering.present && !plan.fluence.present
                ? "grid 'scattering' only dims: no grid 'fluence', or 0 everywhere"
                : present("scattering", plan.scattering));
        add("phase_function", plan.lobes,
            !plan.scatters                ? "nothing is scattered"
            : !plan.anisotropy.present    ? "no grid 'anisotropy', or 0 everywhere"
            : plan.lightDirection.present ? "grid 'anisotropy'"
                                          : "no grid 'light_direction', or 0 everywhere");
        add("emission", plan.emits, present("emission", plan.emission));
        add("opaque", plan.opaque, present("opacity", plan.opacity));
    }
    add("colour", plan.colour,
        plan.colour ? "coefficients or light differ by wavelength" : "medium and light are grey");
    add("environment", plan.map || params.background != glm::dvec3(0),
        plan.map                             ? "--env"
        : params.background != glm::dvec3(0) ? "--background"
                                             : "neither --env nor --background");
    add("aovs", !params.aovs.empty(), params.aovs.empty() ? "no --aov" : "--aov");
    if (scene.has("dispersion")) add("dispersion", false, "rays are traced at 587.6 nm alone");
    if (plan.index.jumpAtFaces > 1e-3f)
        plan.warnings.push_back("the index jumps by " + toText(plan.index.jumpAtFaces) +
                                " at the domain's faces, which do not refract");
    const bool dimOnly = plan.sharp ? plan.scattersUnlit : plan.scattering.present;
    if (dimOnly && !plan.fluence.present)
        plan.warnings.push_back(scene.path() +
                                " scatters light but holds none: run lightsim first");
}

} // namespace

Plan makePlan(const Scene& scene, const Params& params, bool hasMap) {
    Plan plan;
    plan.size = scene.domain().size();
    plan.map = hasMap;
    plan.sharp = params.boundary == optics::Boundary::sharp ||
                 (params.boundary == optics::Boundary::automatic && scene.hasObjects());
    if (plan.sharp) {
        planSharp(plan, scene);
        listEffects(plan, scene, params);
        return plan;
    }
    plan.index = scene.index();
    plan.absorption = scene.coefficient("absorption");
    plan.scattering = scene.coefficient("scattering");
    plan.emission = scene.coefficient("emission");
    plan.opacity = scene.coefficient("opacity");
    plan.bends = plan.index.varies();
    plan.dims = plan.absorption.present || plan.scattering.present;
    plan.emits = plan.emission.present;
    plan.opaque = plan.opacity.present &&
                  std::any_of(plan.opacity.grid.values.begin(), plan.opacity.grid.values.end(),
                              [](float opacity) { return opacity > 0.5f; });
    // Light is read only where something sends it to the eye.
    if (plan.scattering.present || plan.opaque) plan.fluence = scene.fluence();
    plan.scatters = plan.scattering.present && plan.fluence.present;
    if (plan.scatters) plan.anisotropy = scene.coefficient("anisotropy");
    if (plan.fluence.present && (plan.anisotropy.present || plan.opaque))
        plan.lightDirection = scene.lightDirection();
    if (plan.opaque) plan.albedo = scene.coefficient("albedo");
    plan.lobes = plan.scatters && plan.anisotropy.present && plan.lightDirection.present;
    plan.colour = !plan.absorption.grey || !plan.scattering.grey || !plan.emission.grey ||
                  (plan.scatters && !plan.fluence.grey);
    listEffects(plan, scene, params);
    return plan;
}

std::vector<gpu::Need> needsOf(const Plan& plan, const Params& params) {
    const glm::ivec3 outer = plan.size + 2;
    const std::int64_t texels = std::int64_t{outer.x} * outer.y * outer.z;
    const int edge = std::max({outer.x, outer.y, outer.z});
    std::vector<gpu::Need> needs;
    const auto texture = [&](const char* what, std::int64_t bytes) {
        needs.push_back({what, texels * bytes, false, edge});
    };
    if (plan.index.varies()) needs.push_back(medium::fieldNeed(plan.size, params.sampling()));
    if (plan.sharp) {
        for (const gpu::Need& need : medium::surfaceNeeds(plan.objects)) needs.push_back(need);
        if (plan.scatters) texture("the light", 16);
    } else if (plan.dims || plan.emits)
        texture("the medium", plan.colour ? 16 : plan.scatters || plan.emits ? 8 : 4);
    if (!plan.sharp && plan.colour && (plan.scatters || plan.emits))
        texture("the scattered light", 16);
    if (plan.lobes || (plan.opaque && plan.fluence.present)) texture("the light's direction", 16);
    if (!plan.sharp && plan.lobes && plan.emits) texture("the emission", 16);
    if (plan.opaque) texture("the opaque surfaces", plan.fluence.present ? 32 : 16);
    const Camera& camera = params.camera;
    const std::int64_t band = std::int64_t{camera.width} * rowsPerBand(params);
    needs.push_back({"the picture", band * 16, true, 0});
    if (wantsPaths(plan, params)) needs.push_back({"the rays' paths", band * 64, true, 0});
    return needs;
}

} // namespace eikonal::view
