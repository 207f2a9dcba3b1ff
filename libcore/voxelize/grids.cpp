// The grids a scene's materials become, and which of them a scene calls for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxelize/grids.h"

#include "base/text.h"

namespace eikonal::voxelize {

std::string nameOf(Grid grid) {
    static constexpr const char* kNames[] = {"ior",        "dispersion", "absorption",
                                             "scattering", "anisotropy", "emission",
                                             "opacity",    "albedo",     "reflectance"};
    return kNames[static_cast<size_t>(grid)];
}

int componentsOf(Grid grid) {
    switch (grid) {
    case Grid::ior:
    case Grid::dispersion:
    case Grid::anisotropy:
    case Grid::opacity:
        return 1;
    case Grid::absorption:
    case Grid::scattering:
    case Grid::emission:
    case Grid::albedo:
    case Grid::reflectance:
        return 3;
    }
    return 0;
}

glm::dvec3 valueOf(const Material& material, Grid grid) {
    switch (grid) {
    case Grid::ior:
        return glm::dvec3(material.ior);
    case Grid::dispersion:
        return glm::dvec3(material.dispersion);
    case Grid::absorption:
        return material.absorption;
    case Grid::scattering:
        return material.scattering;
    case Grid::anisotropy:
        return glm::dvec3(material.anisotropy);
    case Grid::emission:
        return material.emission;
    case Grid::opacity:
        return glm::dvec3(material.opacity);
    case Grid::albedo:
        return material.albedo;
    case Grid::reflectance:
        return material.reflectance;
    }
    return {};
}

double weightOf(const Material& material, Grid grid) {
    const glm::dvec3& s = material.scattering;
    if (grid == Grid::anisotropy) return (s.x + s.y + s.z) / 3;
    if (grid == Grid::albedo) return material.opacity;
    return 1;
}

glm::dvec3 fallbackOf(const Params& params, Grid grid) {
    if (grid != Grid::albedo) return glm::dvec3(0);
    glm::dvec3 sum(0);
    double weights = 0;
    for (const Object& object : params.objects) {
        sum += weightOf(object.material, grid) * object.material.albedo;
        weights += weightOf(object.material, grid);
    }
    return weights > 0 ? sum / weights : sum;
}

glm::dvec3 absentValue(Grid grid) {
    return glm::dvec3(grid == Grid::reflectance || grid == Grid::ior ? 1 : 0);
}

glm::dvec3 backgroundOf(const Params& params, Grid grid) {
    return grid == Grid::ior ? glm::dvec3(params.medium.ior) : absentValue(grid);
}

GridNeed needOf(const Params& params, Grid grid) {
    if (grid == Grid::ior) return {true, "always written"};
    const auto differs = [&](const Material& material) {
        return weightOf(material, grid) > 0 &&
               valueOf(material, grid) != backgroundOf(params, grid);
    };
    if (differs(params.medium)) return {true, "the surrounding medium has it"};
    for (const Object& object : params.objects)
        if (differs(object.material)) return {true, "'" + object.name + "' has it"};
    const std::string whose = grid == Grid::anisotropy ? "nothing that scatters has "
                              : grid == Grid::albedo   ? "nothing opaque has "
                                                       : "nothing has ";
    return {false, whose + "other than " + toText(backgroundOf(params, grid).x)};
}

} // namespace eikonal::voxelize
