// What mesh2vol tells of the materials that are named.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh2vol/objects.h"
#include "volume/volume.h"

namespace eikonal::mesh2vol {

/// "name: text" for --explain: who is of a named material, and what that comes to with what else
/// was given.
inline std::vector<std::pair<std::string, std::string>>
materialFacts(const Options& o, const std::vector<Source>& sources,
              const voxelize::Params& params) {
    std::vector<std::pair<std::string, std::string>> facts;
    const auto tell = [&](const std::string& of, const optics::NamedMaterial* named,
                          const voxelize::Material& m) {
        if (named == nullptr) return;
        std::string text =
            named->name + ", ior " + toText(m.ior) + ", dispersion " + toText(m.dispersion);
        if (m.absorption != glm::dvec3(0))
            text += ", absorption " + toText(m.absorption.x) + "," + toText(m.absorption.y) + "," +
                    toText(m.absorption.z);
        if (m.crystal)
            text += ", ior of e-rays " + toText(m.crystal->index) + ", dispersion " +
                    toText(m.crystal->dispersion);
        else if (named->extraordinary)
            text += ", as o-rays have it: no --axis";
        facts.emplace_back("material " + of, text);
    };
    for (size_t k = 0; k < sources.size(); ++k) {
        const ObjectValues values(o, placeOf(o, sources, k));
        if (sources[k].material && !values.has("--material") && !values.has("--metal"))
            facts.emplace_back("material " + params.objects[k].name, sources[k].materialText);
        tell(params.objects[k].name, values.material(), params.objects[k].material);
    }
    tell(volume::kMedium, materialOf("--medium-material", o.medium.material), params.medium);
    return facts;
}

/// Whether any named material's absorption counts, which --unit is for.
inline bool absorbsByName(const Options& o, const std::vector<Source>& sources) {
    const auto absorbs = [](const optics::NamedMaterial* named) {
        return named != nullptr && named->absorption != glm::dvec3(0);
    };
    for (size_t k = 0; k < sources.size(); ++k) {
        const ObjectValues values(o, placeOf(o, sources, k));
        if (absorbs(values.material()) && !values.has("--absorption")) return true;
    }
    return absorbs(materialOf("--medium-material", o.medium.material)) &&
           o.medium.absorption->count() == 0;
}

} // namespace eikonal::mesh2vol
