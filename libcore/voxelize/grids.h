// The grids a scene's materials become, and which of them a scene calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "voxelize/params.h"

#include <array>
#include <string>

namespace eikonal::voxelize {

enum class Grid {
    ior,
    dispersion,
    absorption,
    scattering,
    anisotropy,
    emission,
    opacity,
    albedo,
    reflectance
};

constexpr std::array<Grid, 9> kGrids{Grid::ior,        Grid::dispersion, Grid::absorption,
                                     Grid::scattering, Grid::anisotropy, Grid::emission,
                                     Grid::opacity,    Grid::albedo,     Grid::reflectance};

/// The grid's name in the contract and, behind "--", on the command line.
std::string nameOf(Grid grid);
int componentsOf(Grid grid);

/// The material's value; a scalar stands in all three components.
glm::dvec3 valueOf(const Material& material, Grid grid);

/// How much the material's value counts where materials share a voxel, beside the share itself:
/// g by the light scattered, albedo by what is opaque, all else evenly.
double weightOf(const Material& material, Grid grid);

/// The value of voxels where nothing counts: for albedo the mean over the opaque objects, so that
/// opacity blurred beyond the boundary does not meet a black one there.
glm::dvec3 fallbackOf(const Params& params, Grid grid);

/// The value outside the domain.
glm::dvec3 backgroundOf(const Params& params, Grid grid);

/// The value where a grid, or an object's own, is absent.
glm::dvec3 absentValue(Grid grid);

/// Whether some material may put something else than the background into the grid, and why.
struct GridNeed {
    bool needed;
    std::string why;
};
GridNeed needOf(const Params& params, Grid grid);

} // namespace eikonal::voxelize
