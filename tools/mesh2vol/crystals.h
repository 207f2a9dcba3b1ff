// What mesh2vol's options make of a uniaxial crystal.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "common/command_line.h"
#include "optics/materials.h"
#include "voxelize/params.h"

#include <glm/geometric.hpp>

namespace eikonal::mesh2vol {

/// The crystal that an object is, if it is one; `m` has its plain values. `Values` is ObjectValues.
/// Throws UsageError of an axis without n_e or the other way round.
template<typename Values>
std::optional<volume::Crystal> crystalOf(const Values& values, const voxelize::Material& m) {
    const optics::NamedMaterial* named = values.material();
    const bool isNamed = named != nullptr && named->extraordinary && !values.has("--ior");
    const bool hasIndex = values.has("--ior-extraordinary") || isNamed;
    const std::string object = " for object " + std::to_string(values.place().object + 1);
    if (!values.has("--axis")) {
        for (const char* option :
             {"--ior-extraordinary", "--absorption-extraordinary", "--dispersion-extraordinary"})
            if (values.has(option))
                throw UsageError(std::string(option) + ": given without --axis" + object +
                                 ", expected both");
        return {};
    }
    glm::dvec3 axis(0);
    values.rgb("--axis", axis);
    if (axis == glm::dvec3(0)) return {};
    if (!volume::isAxis(axis))
        throw UsageError("--axis: found the length " + toText(glm::length(axis)) + object +
                         ", expected 1, or 0,0,0");
    if (!hasIndex)
        throw UsageError("--axis: given without --ior-extraordinary" + object +
                         ", expected both, or a --material that is a crystal");
    double index = isNamed ? named->extraordinary->ior : 0;
    double dispersion = isNamed && !values.has("--dispersion") && !values.has("--abbe")
                            ? named->extraordinary->dispersion
                            : m.dispersion;
    glm::dvec3 absorption = m.absorption;
    values.number("--ior-extraordinary", index);
    values.number("--dispersion-extraordinary", dispersion);
    values.rgb("--absorption-extraordinary", absorption);
    return volume::Crystal{static_cast<float>(index), static_cast<float>(dispersion),
                           glm::vec3(glm::normalize(axis)), glm::vec3(absorption)};
}

} // namespace eikonal::mesh2vol
