// What each grid of a scene volume is: type, range of valid values, value where it is absent.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "volume/volume.h"

#include <optional>
#include <string>

namespace eikonal::volume {

struct GridRule {
    const char* name;
    GridType type;
    float least, most;        ///< range of valid values
    bool leastOpen, mostOpen; ///< the end itself is not valid
    const char* wanted;       ///< the range in words, for messages
};

/// The rule for a grid of the contract, or null for any other name. An object's own grid
/// (`ior.glass`, `sdf.glass`) has the rule of what stands before the dot.
const GridRule* ruleFor(const std::string& grid);

/// What is wrong with `value` under the rule ("is -1, expected >= 0"), or nothing.
std::optional<std::string> fault(const GridRule* rule, float value);

/// Whether all values keep to the rule.
bool areValid(const GridRule* rule, const float* values, size_t count);

/// The first value of the grid that breaks the rule, in words ("voxel (1, 2, 3) is NaN, expected
/// > 0"), or nothing. `origin` is the index of the grid's first voxel.
std::optional<std::string> findFault(const GridRule* rule, const DenseGrid& grid,
                                     const glm::ivec3& origin);
std::optional<std::string> findFault(const GridRule* rule, const BrickGrid& grid,
                                     const glm::ivec3& origin);

} // namespace eikonal::volume
