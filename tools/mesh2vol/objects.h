// The objects that mesh2vol's command line describes, as many as its meshes turn out to hold.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/input_file.h"
#include "mesh2vol/crystals.h"
#include "mesh2vol/options.h"
#include "mesh2vol/scene_files.h"

#include <filesystem>

namespace eikonal::mesh2vol {

/// An object before it has a mesh: where it comes from.
struct Source {
    size_t file = 0;       ///< of Options::meshes
    std::string part = {}; ///< what it is called there; empty: the file is one object
    std::optional<voxelize::Material> material = {}; ///< what the file says it is made of
    std::string materialText = {};                   ///< the same in words
};

/// Whether the options have matter for any object.
inline bool tellsAnyMatter(const Options& o) {
    return !o.given("--ior").empty() || !o.given("--material").empty() ||
           !o.given("--metal").empty();
}

/// The value of an object's option, or `fallback` where it was not given.
class ObjectValues {
public:
    ObjectValues(const Options& options, const voxelize::Place& place)
        : mOptions(options), mPlace(place) {}

    const voxelize::Place& place() const { return mPlace; }
    const std::optional<double>& unit() const { return mOptions.unit; }

    bool has(const std::string& option) const {
        const std::vector<std::string>& given = mOptions.given(option);
        return !given.empty() && !isNone(voxelize::forObject(option, given, mPlace));
    }
    std::string text(const std::string& option, const std::string& fallback) const {
        return has(option) ? voxelize::forObject(option, mOptions.given(option), mPlace) : fallback;
    }
    bool tellsAnyMatter() const { return mesh2vol::tellsAnyMatter(mOptions); }
    const optics::NamedMaterial* material() const {
        return materialOf("--material", text("--material", kNone));
    }
    const optics::NamedMetal* metal() const { return metalOf("--metal", text("--metal", kNone)); }
    void number(const std::string& option, double& value) const {
        const std::string found = text(option, toText(value));
        const auto number = parseNumber(found);
        if (!number) throw UsageError(option + ": found '" + found + "', expected a number");
        value = *number;
    }
    bool yes(const std::string& option) const {
        const std::string found = text(option, "no");
        if (found != "yes" && found != "no")
            throw UsageError(option + ": found '" + found + "', expected yes or no");
        return found == "yes";
    }
    void rgb(const std::string& option, glm::dvec3& value) const {
        if (has(option)) value = tool::parseVector(option, text(option, ""), true);
    }

private:
    const Options& mOptions;
    voxelize::Place mPlace;
};

inline int priorityOf(const ObjectValues& values) {
    double number = 0;
    values.number("--priority", number);
    const auto priority = static_cast<int>(std::clamp(number, -1e9, 1e9));
    if (priority != number)
        throw UsageError("--priority: found " + toText(number) + ", expected a whole number");
    return priority;
}

/// Throws UsageError of an object whose index is not known, or its dispersion known twice.
inline void checkTogether(const ObjectValues& values, bool fileTells) {
    const std::string object = " for object " + std::to_string(values.place().object + 1);
    const bool told = values.has("--ior") || values.has("--material") || values.has("--metal");
    if (!told && !fileTells && !values.tellsAnyMatter())
        throw UsageError("not given: --ior or --material or --metal (--help lists the options)");
    if (!told && !fileTells)
        throw UsageError("--ior: none" + object + ", expected one, or a --material or --metal");
    if (values.has("--abbe") && values.has("--dispersion"))
        throw UsageError("--abbe: given with --dispersion" + object + ", expected one of the two");
}

/// An object of what the options say and, where they leave it open, its file. A --material or
/// --metal takes the place of all that the file says; other options replace one value each.
inline voxelize::Object objectOf(const ObjectValues& values,
                                 const std::optional<voxelize::Material>& ofFile = {}) {
    voxelize::Object object;
    voxelize::Material& m = object.material;
    if (ofFile && !values.has("--material") && !values.has("--metal")) m = *ofFile;
    if (values.has("--opacity")) m.metal.reset(); // else it would not count
    if (const optics::NamedMaterial* material = values.material()) {
        m.ior = material->ior;
        m.dispersion = material->dispersion;
        m.absorption = absorptionOf(*material, values.unit());
    }
    values.number("--ior", m.ior);
    values.number("--dispersion", m.dispersion);
    if (values.has("--abbe")) {
        double abbe = 0;
        values.number("--abbe", abbe);
        m.dispersion = dispersionBy("--abbe", abbe, m.ior);
    }
    values.rgb("--absorption", m.absorption);
    values.rgb("--scattering", m.scattering);
    values.number("--anisotropy", m.anisotropy);
    values.rgb("--emission", m.emission);
    values.number("--opacity", m.opacity);
    values.rgb("--albedo", m.albedo);
    values.rgb("--reflectance", m.reflectance);
    values.number("--roughness", m.roughness);
    m.crystal = crystalOf(values, m);
    if (const optics::NamedMetal* metal = values.metal()) {
        m.metal = volume::Metal{metal->index, metal->extinction};
        m.opacity = 1;
    }
    object.priority = priorityOf(values);
    object.fillBelow = values.yes("--fill-below");
    return object;
}

/// What no object may be called by becomes "_".
inline std::string madeValid(std::string name) {
    for (char& c : name)
        if (!voxelize::isObjectName({c})) c = '_';
    return name;
}

/// The file's name without its ending. Streams have names that change from run to run: they are
/// "mesh", with their place among several meshes.
inline std::string nameOfFile(const Options& o, size_t file) {
    const std::string& path = o.meshes[file];
    if (!isStream(path)) return madeValid(std::filesystem::path(path).stem().string());
    return o.meshes.size() > 1 ? "mesh" + std::to_string(file + 1) : "mesh";
}

/// The name given to this object, or to its file or that file's own; then the part behind it.
inline std::string nameOf(const Options& o, const Source& source, const voxelize::Place& place) {
    const ObjectValues values(o, place);
    const std::string name = values.text("--name", nameOfFile(o, source.file));
    const bool isItsOwn = values.has("--name") && o.given("--name").size() == place.objects;
    return source.part.empty() || isItsOwn ? name : name + "." + madeValid(source.part);
}

/// Whether an option was given for each object rather than for all, or for each mesh.
inline bool tellsObjectsApart(const Options& o) {
    return std::any_of(o.perMesh.begin(), o.perMesh.end(), [&](const PerMesh& option) {
        return option.given.size() > std::max<size_t>(1, o.meshes.size());
    });
}

inline voxelize::Place placeOf(const Options& o, const std::vector<Source>& sources, size_t k) {
    return {k, sources.size(), sources[k].file, o.meshes.size()};
}

/// The scene's parameters, all but the objects' triangles, checked. Throws UsageError.
inline voxelize::Params paramsOf(const Options& o, const std::vector<Source>& sources) {
    voxelize::Params params = sceneOf(o);
    for (size_t k = 0; k < sources.size(); ++k) {
        const voxelize::Place place = placeOf(o, sources, k);
        checkTogether({o, place}, sources[k].material.has_value());
        params.objects.push_back(objectOf({o, place}, sources[k].material));
        params.objects.back().name = nameOf(o, sources[k], place);
    }
    for (const voxelize::Object& object : params.objects)
        if (!params.sharp &&
            (object.material.metal || object.material.roughness > 0 || object.material.crystal))
            throw UsageError(std::string(object.material.metal     ? "--metal"
                                         : object.material.crystal ? "--axis"
                                                                   : "--roughness") +
                             ": given with --boundary blurred, which knows no surfaces; expected "
                             "sharp ones");
    params.check();
    return params;
}

/// Throws UsageError of whatever is wrong however many objects the meshes hold.
inline void checkBeforeReading(const Options& o) {
    for (const std::string& path : o.meshes) {
        const bool named = optics::findMaterial(path) != nullptr;
        if ((named || parseNumbers(path)) && !std::filesystem::exists(path))
            throw UsageError(path + ": is a " + (named ? "material" : "number") +
                             ", not a mesh: an option takes one value, and is given once for all "
                             "or again for each (--ior 1.5 --ior 1.33)");
    }
    Options each = o;
    size_t most = o.meshes.size();
    for (const PerMesh& option : o.perMesh) most = std::max(most, option.given.size());
    for (PerMesh& option : each.perMesh)
        if (!option.given.empty()) option.given.resize(most, std::string(option.given.back()));
    voxelize::Params params = sceneOf(each);
    params.checkGround();
    if (params.sharp) voxelize::requireSharpCount(most + (params.ground ? 1 : 0));
    params.ground.reset();
    params.groundMargin.reset();
    params.sharp = false; // names are looked at when all are known
    for (size_t k = 0; k < most; ++k) {
        // Which value goes with which is known where no option is given for each object.
        if (most == o.meshes.size())
            checkTogether({each, {k, most, k, most}}, mayBringMaterials(o.meshes[k]));
        params.objects.push_back(objectOf({each, {k, most, k, most}}));
        params.objects.back().name =
            most == o.meshes.size() ? nameOfFile(o, k) : "object " + std::to_string(k + 1);
    }
    params.check();
}

} // namespace eikonal::mesh2vol
