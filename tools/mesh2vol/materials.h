// What mesh2vol's options make of a material's name and of an Abbe number.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "common/command_line.h"
#include "optics/materials.h"

#include <cctype>
#include <optional>

namespace eikonal::mesh2vol {

/// What stands for a value that is not given to one object of several.
inline const char* const kNone = "none";

inline bool isNone(std::string value) {
    for (char& c : value) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return value == kNone;
}

/// What `find` finds; null for none. Throws UsageError of a name that is not among those known.
template<typename Find>
auto foundByName(const std::string& option, const std::string& name, const Find& find,
                 const std::vector<std::string>& known) -> decltype(find(name)) {
    if (isNone(name)) return nullptr;
    if (const auto found = find(name)) return found;
    const std::string meant = tool::likest(name, known);
    throw UsageError(option + ": found '" + name + "'" +
                     (meant.empty() ? "" : " (did you mean " + meant + "?)") +
                     ", expected one of " + join(known, ", ") + ", or " + kNone);
}

inline const optics::NamedMaterial* materialOf(const std::string& option, const std::string& name) {
    return foundByName(option, name, optics::findMaterial, optics::materialNames());
}

inline const optics::NamedMetal* metalOf(const std::string& option, const std::string& name) {
    return foundByName(option, name, optics::findMetal, optics::metalNames());
}

/// [1/unit], of a unit of so many metres. Without one it is not known, and 0.
inline glm::dvec3 absorptionOf(const optics::NamedMaterial& material,
                               const std::optional<double>& unit) {
    return unit ? material.absorption * *unit : glm::dvec3(0);
}

/// Cauchy B [µm²] by an Abbe number. Throws UsageError of one that can't be meant.
inline double dispersionBy(const std::string& option, double abbe, double ior) {
    // From 1 on the index stays on its side of 1 all over the visible.
    if (!(abbe == 0 || (abbe >= 1 && abbe <= 1000)))
        throw UsageError(option + ": found " + toText(abbe) + ", expected 1 to 1000, or 0: none");
    return optics::dispersionOf(ior, abbe);
}

} // namespace eikonal::mesh2vol
