// What each grid of a scene volume is: type, range of valid values, value where it is absent.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/contract.h"

#include "base/text.h"

#include <array>
#include <cmath>
#include <limits>

namespace eikonal::volume {

namespace {

constexpr float kMost = std::numeric_limits<float>::max();

constexpr GridType kScalar = GridType::scalar;
constexpr GridType kVector = GridType::vector;

constexpr std::array<GridRule, 12> kRules{{
    {"ior", kScalar, 0, kMost, true, false, "> 0"},
    {"dispersion", kScalar, -kMost, kMost, false, false, "a finite number"},
    {"absorption", kVector, 0, kMost, false, false, ">= 0"},
    {"scattering", kVector, 0, kMost, false, false, ">= 0"},
    {"anisotropy", kScalar, -1, 1, true, true, "between -1 and 1"},
    {"emission", kVector, 0, kMost, false, false, ">= 0"},
    {"opacity", kScalar, 0, 1, false, false, "0 to 1"},
    {"albedo", kVector, 0, 1, false, false, "0 to 1"},
    {"reflectance", kVector, 0, kMost, false, false, ">= 0"},
    {"sdf", kScalar, -kMost, kMost, false, false, "a finite number"},
    {"fluence", kVector, 0, kMost, false, false, ">= 0"},
    {"light_direction", kVector, -kMost, kMost, false, false, "a finite number"},
}};

} // namespace

const GridRule* ruleFor(const std::string& grid) {
    const std::string name = grid.rfind("sdf.", 0) == 0 ? "sdf" : grid;
    for (const GridRule& rule : kRules)
        if (name == rule.name) return &rule;
    return nullptr;
}

std::optional<std::string> fault(const GridRule* rule, float value) {
    const bool finite = std::isfinite(value);
    if (finite && (!rule || ((rule->leastOpen ? value > rule->least : value >= rule->least) &&
                             (rule->mostOpen ? value < rule->most : value <= rule->most))))
        return std::nullopt;
    const std::string found = finite ? toText(value) : std::isnan(value) ? "NaN" : "infinite";
    return "is " + found + ", expected " + (rule ? rule->wanted : "a finite number");
}

} // namespace eikonal::volume
