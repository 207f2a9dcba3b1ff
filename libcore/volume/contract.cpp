// What each grid of a scene volume is: type, range of valid values, value where it is absent.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/contract.h"

#include "base/text.h"

#include <array>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

namespace eikonal::volume {

namespace {

constexpr float kMost = std::numeric_limits<float>::max();

constexpr GridType kScalar = GridType::scalar;
constexpr GridType kVector = GridType::vector;

constexpr std::array<GridRule, 16> kRules{{
    {"ior", kScalar, 0, kMost, true, false, "> 0"},
    {"dispersion", kScalar, -kMost, kMost, false, false, "a finite number"},
    {"absorption", kVector, 0, kMost, false, false, ">= 0"},
    {"scattering", kVector, 0, kMost, false, false, ">= 0"},
    {"anisotropy", kScalar, -1, 1, true, true, "between -1 and 1"},
    {"emission", kVector, 0, kMost, false, false, ">= 0"},
    {"opacity", kScalar, 0, 1, false, false, "0 to 1"},
    {"albedo", kVector, 0, 1, false, false, "0 to 1"},
    {"reflectance", kVector, 0, kMost, false, false, ">= 0"},
    {"axis", kVector, -kMost, kMost, false, false,
     "a finite number"}, // scene::settleCrystals() sees to more
    {"ior_extraordinary", kScalar, 1, kMost, false, false, "1 or more"},
    {"absorption_extraordinary", kVector, 0, kMost, false, false, ">= 0"},
    {"sdf", kScalar, -kMost, kMost, false, false, "a finite number"},
    {"fluence", kVector, -kMost, kMost, false, false, "a finite number"},
    {"irradiance", kVector, -kMost, kMost, false, false, "a finite number"},
    {"light_direction", kVector, -kMost, kMost, false, false, "a finite number"},
}};

/// Whether objects have such grids of their own; what lightsim writes is the whole scene's.
bool objectsHave(const GridRule& rule) {
    const std::string name = rule.name;
    return name != "fluence" && name != "light_direction" && name != "irradiance";
}

} // namespace

const GridRule* ruleFor(const std::string& grid) {
    // The first dot ends the contract's name; an object's own may have more of them.
    const size_t dot = grid.find('.');
    const std::string name = grid.substr(0, dot);
    for (const GridRule& rule : kRules)
        if (name == rule.name)
            return dot == std::string::npos || objectsHave(rule) ? &rule : nullptr;
    return nullptr;
}

std::string ownGrid(const std::string& grid, const std::string& object) {
    return grid + "." + object;
}

std::optional<std::string> fault(const GridRule* rule, float value) {
    const bool finite = std::isfinite(value);
    if (finite && (!rule || ((rule->leastOpen ? value > rule->least : value >= rule->least) &&
                             (rule->mostOpen ? value < rule->most : value <= rule->most))))
        return std::nullopt;
    const std::string found = finite ? toText(value) : std::isnan(value) ? "NaN" : "infinite";
    return "is " + found + ", expected " + (rule ? rule->wanted : "a finite number");
}

namespace {

std::string voxelText(const glm::ivec3& voxel) {
    return "(" + std::to_string(voxel.x) + ", " + std::to_string(voxel.y) + ", " +
           std::to_string(voxel.z) + ")";
}

glm::ivec3 voxelAt(const DenseGrid& grid, std::int64_t value) {
    const std::int64_t voxel = value / grid.components;
    return {static_cast<int>(voxel % grid.size.x),
            static_cast<int>(voxel / grid.size.x % grid.size.y),
            static_cast<int>(voxel / grid.size.x / grid.size.y)};
}

} // namespace

bool areValid(const GridRule* rule, const float* values, size_t count) {
    const float least = rule ? rule->least : -std::numeric_limits<float>::max();
    const float most = rule ? rule->most : std::numeric_limits<float>::max();
    // The plain range is tested branch-free first; open ends are looked at only on a hit.
    bool inside = true, onEnd = false;
    for (size_t i = 0; i < count; ++i) {
        inside &= values[i] >= least && values[i] <= most;
        onEnd |= values[i] == least || values[i] == most;
    }
    if (!inside || !onEnd || !rule) return inside;
    return (!rule->leastOpen && !rule->mostOpen) ||
           std::none_of(values, values + count, [&](float value) { return fault(rule, value); });
}

namespace {

/// The first value against the rule, as slice-parallel scan; -1 if there is none.
std::int64_t firstFault(const GridRule* rule, const DenseGrid& grid) {
    const size_t slice = static_cast<size_t>(grid.size.x) * grid.size.y * grid.components;
    std::vector<std::int64_t> found(static_cast<size_t>(grid.size.z), -1);
    tbb::parallel_for(0, grid.size.z, [&](int z) {
        const float* values = grid.values.data() + slice * static_cast<size_t>(z);
        if (areValid(rule, values, slice)) return;
        for (size_t i = 0; i < slice; ++i)
            if (fault(rule, values[i])) {
                found[static_cast<size_t>(z)] =
                    static_cast<std::int64_t>(slice) * z + static_cast<std::int64_t>(i);
                return;
            }
    });
    for (std::int64_t at : found)
        if (at >= 0) return at;
    return -1;
}

} // namespace

std::optional<std::string> findFault(const GridRule* rule, const DenseGrid& grid,
                                     const glm::ivec3& origin) {
    const std::int64_t at = firstFault(rule, grid);
    if (at < 0) return std::nullopt;
    return "voxel " + voxelText(voxelAt(grid, at) + origin) + " " +
           *fault(rule, grid.values[static_cast<size_t>(at)]);
}

} // namespace eikonal::volume
