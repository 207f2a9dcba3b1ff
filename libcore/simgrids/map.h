// How one grid of the contract is made of one grid of a simulation: parsed from an option's text.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace eikonal::simgrids {

/// What turns a value v into another, taken in double.
enum class Kind {
    linear,        ///< scale · v + offset
    gladstoneDale, ///< n = 1 + K v, v a density [kg/m³]
    air            ///< n of dry air at v [K] by optics::airRefractivity
};

struct Map {
    std::string to, from;
    Kind kind = Kind::linear;
    glm::dvec3 scale{1}, offset{0};
    double constant = 0; ///< Gladstone and Dale's K [m³/kg]
    double pressure = 0; ///< [Pa]

    /// The law in words: "5 x + 0.1".
    std::string text() const;
};

/// The grids of the contract that a map may lead to.
const std::vector<std::string>& targets();

/// `GRID:SCALE[:OFFSET]` of any grid, and of `ior` `GRID:gladstone-dale[:K]` and
/// `GRID:air[:PRESSURE]`, too. SCALE and OFFSET are R,G,B or one number where the contract wants
/// vectors. Throws UsageError naming the option `--TO-from`.
Map parseMap(const std::string& to, const std::string& text);

} // namespace eikonal::simgrids
