// Floors that light falls on, and how near a simulation comes to what is exact.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floors.h"

#include "judge/caustic.h"
#include "judge/water.h"
#include "support/glass_volume.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace bench {

using namespace eikonal;

namespace {

/// Distance to the waves, whose curvature's radius is more than twice a band's half width.
double distanceTo(const judge::Water& water, const glm::dvec3& x) {
    const glm::dvec2 at(x.x, x.z);
    glm::dvec2 foot = at;
    for (int i = 0; i < 12 && std::abs(x.y - water.height(at)) < 0.1; ++i)
        foot = at + (x.y - water.height(foot)) * water.slope(foot);
    const glm::dvec3 normal = water.normal(foot);
    return glm::dot(x - glm::dvec3(foot.x, water.height(foot), foot.y), normal);
}

/// Of the floor's upper side.
std::vector<double> texelsOf(const volume::FineGrid& grid, int low) {
    constexpr int kTexels = 2 * kUnit * kDetail;
    std::vector<double> found(static_cast<size_t>(kTexels) * kTexels);
    for (size_t i = 0; i < grid.voxels.size(); ++i) {
        const glm::ivec3 p = grid.voxels[i] - glm::ivec3(low, 0, low) * kDetail;
        // The floor lies between two layers, which tell the same.
        if (p.y != kFloor * kDetail || std::min(p.x, p.z) < 0 || std::max(p.x, p.z) >= kTexels)
            continue;
        found[static_cast<size_t>(p.z) * kTexels + static_cast<size_t>(p.x)] = grid.values[i].x;
    }
    return found;
}

} // namespace

Case ballOverFloor() {
    const judge::Glass glass{{judge::glassBall({80, 52, 80}, 32, 1.5),
                              judge::glassBox(glm::dvec3(-20), {180, kFloor, 180}, 1)}};
    sharp::Voxels voxels;
    voxels.size = {160, 88, 160};
    voxels.halfWidth = 4;
    Case made{"ball", sharp::volumeOf(glass, voxels),
              lightsim::parseLight("directional:-0.3,-1,-0.2"), 16};
    made.volume.putConstant("opacity.S1", glm::vec3(1));
    judge::irradianceUnder(judge::BallOverPlane{}, made.exact);
    return made;
}

Case waterOverFloor(bool box) {
    judge::Water water;
    if (box) water.boxLow = {-0.5, 0.2, -0.3}, water.boxHigh = {-0.1, 0.3, 0.1};
    const int half = 3 * kUnit / 2, size = 2 * (half + kPad);
    const auto voxelOf = [&](const glm::dvec3& x) {
        return (x - glm::dvec3(0, water.floor, 0)) * static_cast<double>(kUnit) +
               glm::dvec3(size / 2, kFloor, size / 2);
    };
    const judge::Solid sides = judge::glassBox({kPad, 0, kPad}, {size - kPad, 1e3, size - kPad}, 1);
    judge::Glass glass{{judge::glassBox(glm::dvec3(0), glm::dvec3(1), water.index),
                        judge::glassBox(glm::dvec3(-20), {size + 20, kFloor, size + 20}, 1)}};
    if (box)
        glass.solids.push_back(judge::glassBox(voxelOf(water.boxLow), voxelOf(water.boxHigh), 1));
    sharp::Voxels voxels;
    voxels.size = {size, 64, size};
    voxels.halfWidth = 4;
    voxels.distances.emplace_back([&](const glm::dvec3& p) {
        const glm::dvec3 x = (p - voxelOf(glm::dvec3(0))) / static_cast<double>(kUnit);
        return std::max(kUnit * distanceTo(water, x), sharp::distanceTo(sides, p));
    });
    Case made{box ? "water and a box" : "water", sharp::volumeOf(glass, voxels),
              lightsim::parseLight("directional:-0.25,-1,0.15"), size / 2 - kUnit};
    made.volume.putConstant("opacity.S1", glm::vec3(1));
    if (box) made.volume.putConstant("opacity.S2", glm::vec3(1));
    judge::irradianceUnder(water, made.exact);
    return made;
}

FloorError errorOf(const Case& scene, const volume::FineGrid& irradiance) {
    const std::vector<double> found = texelsOf(irradiance, scene.low);
    const std::vector<double>& exact = scene.exact.values;
    const double mean = scene.exact.mean();
    double squares = 0, sum = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        squares += (found[i] - exact[i]) * (found[i] - exact[i]) /
                   (exact[i] * exact[i] + 0.01 * mean * mean);
        sum += found[i];
    }
    const auto texels = static_cast<double>(exact.size());
    return {std::sqrt(squares / texels), sum / texels / mean - 1};
}

} // namespace bench
