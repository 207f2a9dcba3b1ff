// What meshgen can make: a subcommand each.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/triangle_mesh.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace eikonal::meshgen {

struct Kind {
    CLI::App* command;
    std::function<mesh::TriangleMesh(std::uint32_t seed)> make;
    std::function<std::vector<std::string>()> inputs; ///< files that it reads
    std::function<bool()> isOpen;                     ///< whether a sheet was asked for
};

/// Adds all subcommands. What their options are read into lives as long as the functions.
std::vector<Kind> addKinds(CLI::App& app);

} // namespace eikonal::meshgen
