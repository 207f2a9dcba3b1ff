// Which effects a scene calls for, and who asks for them, in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/effects.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace eikonal::scene {

namespace {

/// The first region for which it holds, or null.
template<typename Holds> const Region* firstRegion(const Scene& scene, const Holds& holds) {
    const auto found = std::find_if(scene.regions.begin(), scene.regions.end(), holds);
    return found == scene.regions.end() ? nullptr : &*found;
}

Effect coefficient(const Scene& scene, const std::string& grid, RegionValues values) {
    const Region* who =
        firstRegion(scene, [&](const Region& region) { return !(region.*values).isZero(); });
    if (!scene.sharp)
        return {grid, who != nullptr,
                who ? "grid '" + grid + "'" : "no grid '" + grid + "', or 0 everywhere"};
    return {grid, who != nullptr, who ? "'" + who->name + "' has it" : "nothing has it"};
}

Effect refraction(const Scene& scene) {
    if (!scene.sharp)
        return {"refraction", scene.index.varies(),
                scene.index.varies() ? "grid 'ior'"
                                     : "the index is " + toText(scene.index.least) + " everywhere"};
    const Region* who = firstRegion(scene, [&](const Region& region) {
        return region.index.varies() || region.index.value != scene.medium().index.value;
    });
    return {"refraction", who != nullptr,
            who ? "'" + who->name + "' has an index of its own"
                : "the index is the same everywhere"};
}

Effect opaque(const Scene& scene) {
    if (!scene.sharp) {
        Effect effect = coefficient(scene, "opacity", &Region::opacity);
        return {"opaque", scene.anyOpaque(), effect.why};
    }
    std::string why = "nothing is opaque";
    for (const Region& region : scene.regions)
        if (region.opaque) why = "'" + region.name + "' is";
    return {"opaque", scene.anyOpaque(), why};
}

} // namespace

std::vector<Effect> effectsOf(const Scene& scene, optics::Boundary boundary) {
    std::vector<Effect> effects;
    effects.push_back({"sharp_boundaries", scene.sharp,
                       scene.sharp                             ? "grid 'sdf'"
                       : boundary == optics::Boundary::blurred ? "--boundary blurred"
                                                               : "no grid 'sdf'"});
    effects.push_back(refraction(scene));
    if (scene.sharp)
        effects.push_back({"curved_rays", scene.index.varies(),
                           scene.index.varies() ? "an index varies between boundaries"
                                                : "no index varies between boundaries"});
    effects.push_back(coefficient(scene, "absorption", &Region::absorption));
    effects.push_back(coefficient(scene, "scattering", &Region::scattering));
    effects.push_back(coefficient(scene, "anisotropy", &Region::anisotropy));
    effects.push_back(coefficient(scene, "emission", &Region::emission));
    effects.push_back(opaque(scene));
    if (scene.disperses)
        effects.push_back({"dispersion", false, "light is traced at 587.6 nm alone"});
    return effects;
}

Effect effectNamed(const std::vector<Effect>& effects, const std::string& name) {
    for (const Effect& effect : effects)
        if (effect.name == name) return effect;
    return {name, false, ""};
}

std::vector<std::string> warningsOf(const Scene& scene) {
    std::vector<std::string> warnings;
    const float kSteep = 1.2f; // noise and creases stay below
    for (size_t k = 0; k < scene.objects.size(); ++k)
        if (scene.objects[k].slope > kSteep)
            warnings.push_back("the signed distance of '" + scene.regions[k].name + "' grows by " +
                               toText(std::round(scene.objects[k].slope * 100) / 100) +
                               " a voxel, expected 1: rays may leap over its boundary");
    if (scene.index.jumpAtFaces > 1e-3f)
        warnings.push_back("the index jumps by " + toText(scene.index.jumpAtFaces) +
                           " at the domain's faces, which do not refract");
    if (scene.disperses)
        warnings.push_back("'dispersion' is not traced: all light goes as that of 587.6 nm does");
    return warnings;
}

std::string sizeText(const Scene& scene) {
    const glm::ivec3 size = scene.size();
    return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

} // namespace eikonal::scene
