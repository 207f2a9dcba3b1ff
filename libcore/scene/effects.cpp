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

/// Whose index depends on the wavelength, or why light is not traced by it.
Effect dispersion(const Scene& scene, const optics::Wavelengths& wavelengths) {
    Effect effect = coefficient(scene, "dispersion", &Region::dispersion);
    if (!effect.on && scene.disperses) { // of a crystal's n_e alone
        const Region* who = firstRegion(scene, [](const Region& region) {
            return region.crystal && region.crystal->dispersion != 0;
        });
        effect = {effect.name, true,
                  who ? "'" + who->name + "' has it" : "waves of a crystal interfere"};
    }
    if (!effect.on) return effect;
    if (scene.disperses) return {effect.name, true, effect.why + ": " + wavelengths.text()};
    return {effect.name, false,
            wavelengths.disperse() ? "nothing refracts"
                                   : "--wavelengths 1: all light goes as that of 587.6 nm"};
}

Effect refraction(const Scene& scene) {
    if (!scene.sharp)
        return {"refraction", scene.index.varies(),
                scene.index.varies() ? "grid 'ior'"
                                     : "the index is " + toText(scene.index.least) + " everywhere"};
    const Region* who = firstRegion(scene, [&](const Region& region) {
        return region.crystal || region.indexVaries() ||
               region.index.value != scene.medium().index.value ||
               (scene.disperses && region.dispersion.value != scene.medium().dispersion.value);
    });
    return {"refraction", who != nullptr,
            who ? "'" + who->name + "' has an index of its own"
                : "the index is the same everywhere"};
}

/// Of sharp boundaries alone.
Effect mirrors(const Scene& scene, const char* name, const Region* who) {
    return {name, who != nullptr,
            !scene.sharp ? "boundaries are blurred"
            : who        ? "'" + who->name + "' is"
                         : "nothing is"};
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

std::vector<Effect> effectsOf(const Scene& scene, const optics::Tracing& tracing) {
    std::vector<Effect> effects;
    effects.push_back({"sharp_boundaries", scene.sharp,
                       scene.sharp                                     ? "grid 'sdf'"
                       : tracing.boundary == optics::Boundary::blurred ? "--boundary blurred"
                                                                       : "no grid 'sdf'"});
    effects.push_back(refraction(scene));
    if (scene.sharp)
        effects.push_back({"curved_rays", scene.index.varies(),
                           scene.index.varies() ? "an index varies between boundaries"
                                                : "no index varies between boundaries"});
    Effect absorption = coefficient(scene, "absorption", &Region::absorption);
    if (!absorption.on && scene.anyHas(&Region::absorptionExtraordinary))
        absorption = coefficient(scene, "absorption", &Region::absorptionExtraordinary);
    effects.push_back(absorption);
    effects.push_back(coefficient(scene, "scattering", &Region::scattering));
    effects.push_back(coefficient(scene, "anisotropy", &Region::anisotropy));
    effects.push_back(coefficient(scene, "emission", &Region::emission));
    effects.push_back(opaque(scene));
    const Region* coated = scene.firstCoated();
    effects.push_back({"coat", coated != nullptr,
                       !scene.sharp ? "boundaries are blurred"
                       : coated     ? "'" + coated->name + "' is opaque, with an index of its own"
                                    : "nothing opaque has an index above what surrounds it"});
    effects.push_back(mirrors(
        scene, "metal", firstRegion(scene, [](const Region& r) { return r.metal.has_value(); })));
    effects.push_back(mirrors(scene, "roughness",
                              firstRegion(scene, [](const Region& r) { return r.roughness > 0; })));
    effects.push_back(mirrors(scene, "crystals", firstRegion(scene, [](const Region& r) {
                                  return r.crystal.has_value();
                              })));
    effects.push_back(dispersion(scene, tracing.wavelengths));
    return effects;
}

Effect effectNamed(const std::vector<Effect>& effects, const std::string& name) {
    for (const Effect& effect : effects)
        if (effect.name == name) return effect;
    return {name, false, ""};
}

namespace {

/// Of a level set that is no distance, or is cut off too near to be followed.
void warnOf(const Object& object, const std::string& name, double voxelSize,
            std::vector<std::string>& warnings) {
    const float kSteep = 1.2f;  // noise and creases stay below
    const float kNarrowest = 2; // splines look two voxels on
    const double inVoxels = object.slope * voxelSize;
    const auto rounded = [](double value) { return toText(std::round(value * 100) / 100); };
    if (object.slope > kSteep)
        warnings.push_back("the signed distance of '" + name + "' grows by " +
                           rounded(object.slope) +
                           " a voxel, expected 1: rays may leap over its boundary" +
                           (std::abs(inVoxels - 1) < 0.2 ? "; it seems to be in voxels, expected "
                                                           "units of the world"
                                                         : ""));
    if (object.band < kNarrowest)
        warnings.push_back("the signed distance of '" + name + "' is known to " +
                           rounded(object.band) +
                           " voxels from its boundary, expected 3: it is rough there");
}

/// Of an index whose differences are lost in how it is stored. A half has 11 bits, a float 24.
void warnOf(const Index& index, std::vector<std::string>& warnings) {
    if (!index.varies() || !index.rest.page.empty()) return;
    const double contrast = static_cast<double>(index.most) - index.least;
    const double rounding = std::ldexp(1.0, std::ilogb(index.most) - (index.inHalf ? 11 : 24));
    const double share = rounding / contrast;
    if (share < 0.01) return;
    warnings.push_back("the index varies by " + toText(contrast) + ", which " +
                       (index.inHalf ? "the 16 bits" : "32-bit floats") +
                       " that hold it round by " + toText(std::round(share * 1000) / 10) +
                       " %: rays bend by as much too much or too little" +
                       (index.inHalf ? "; store it in 32 bits" : ""));
}

} // namespace

std::vector<std::string> warningsOf(const Scene& scene) {
    std::vector<std::string> warnings;
    for (size_t k = 0; k < scene.objects.size(); ++k)
        warnOf(scene.objects[k], scene.regions[k].name, scene.voxelSize(), warnings);
    warnOf(scene.index, warnings);
    if (scene.index.jumpAtFaces > 1e-3f)
        warnings.push_back("the index jumps by " + toText(scene.index.jumpAtFaces) +
                           " at the domain's faces, which do not refract");
    return warnings;
}

std::vector<std::string> idleWarnings(const Files& files, const std::vector<Effect>& effects) {
    for (const char* name :
         {"refraction", "curved_rays", "absorption", "scattering", "emission", "opaque"})
        if (effectNamed(effects, name).on) return {};
    return {"nothing in " + files.path() +
            " bends, dims or emits light (found: " + files.foundNames() +
            "); other names are told by --grid-ior NAME, --grid-scattering NAME, --grid-sdf NAME "
            "and their like"};
}

std::string sizeText(const Scene& scene) {
    const glm::ivec3 size = scene.size();
    return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

} // namespace eikonal::scene
